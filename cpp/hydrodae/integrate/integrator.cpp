#include "hydrodae/integrate/integrator.h"

#include <map>

#include "hydrodae/core/error.h"
#include "hydrodae/integrate/collocation.h"
#include "hydrodae/integrate/explicit_rk.h"
#include "hydrodae/integrate/generalized_alpha.h"
#include "hydrodae/integrate/ida.h"

namespace hydrodae::integrate {

std::unique_ptr<Integrator> make_integrator(const system::Regime& system,
                                            const system::Pattern& pattern,
                                            const SolverOptions& options, double t0,
                                            const VectorX& y, const VectorX& yp) {
  static const std::map<std::string, decltype(&make_ida)> makers = {
      {"radau", make_radau}, {"explicit_rk", make_explicit_rk},
      {"ida", make_ida},     {"generalized_alpha", make_generalized_alpha},
      {"gauss", make_gauss}, {"lobatto_iiic", make_lobatto_iiic},
  };
  return makers.at(options.method)(system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::integrate
