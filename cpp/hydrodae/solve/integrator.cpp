#include "hydrodae/solve/integrator.h"

#include "hydrodae/core/error.h"
#include "hydrodae/solve/collocation.h"
#include "hydrodae/solve/explicit_rk.h"
#include "hydrodae/solve/generalized_alpha.h"
#include "hydrodae/solve/ida.h"

namespace hydrodae::solve {

std::unique_ptr<Integrator> make_integrator(const system::Regime& system,
                                            const system::Pattern& pattern,
                                            const model::SolverOptions& options, double t0,
                                            const VectorX& y, const VectorX& yp) {
  if (options.method == "ida")
    return make_ida(system, pattern, options, t0, y, yp);
  if (options.method == "explicit_rk")
    return make_explicit_rk(system, pattern, options, t0, y, yp);
  if (options.method == "generalized_alpha")
    return make_generalized_alpha(system, pattern, options, t0, y, yp);
  return make_collocation(system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::solve
