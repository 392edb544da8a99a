#include "hydrodae/solve/integrator.h"

#include "hydrodae/core/error.h"
#include "hydrodae/solve/collocation.h"
#include "hydrodae/solve/explicit_rk.h"
#include "hydrodae/solve/generalized_alpha.h"
#include "hydrodae/solve/ida.h"

namespace hydrodae::solve {

std::unique_ptr<Integrator> make_integrator(const system::System& system,
                                            const system::Pattern& pattern,
                                            const model::SolverOptions& options, const VectorX& y,
                                            const VectorX& yp) {
  if (options.method == "ida")
    return make_ida(system, pattern, options, y, yp);
  if (options.method == "explicit_rk")
    return make_explicit_rk(system, pattern, options, y, yp);
  if (options.method == "generalized_alpha")
    return make_generalized_alpha(system, pattern, options, y, yp);
  return make_collocation(system, pattern, options, y, yp);
}

} // namespace hydrodae::solve
