/// How long a step may be beside what the history carries.

#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/history.h"

namespace hydrodae::system {

std::string limit_steps(const System& s, model::SolverOptions& options) {
  constexpr double longest = 1.0; // w h: error of the interpolation 1/384
  double limit = INFINITY;
  std::string why;
  for (const DelayData& d : s.delays)
    if (d.time < limit) {
      limit = d.time;
      why = "the shortest delay";
    }
  const bool fixed = options.step > 0.0;
  const Convolution& c = s.hydro.convolution;
  if (!c.empty() && c.frequency > 0.0) {
    const double h =
        (fixed ? longest : std::min(longest, std::pow(384.0 * options.rtol, 0.25))) / c.frequency;
    if (h < limit) {
      limit = h;
      why = "what the history of the convolution carries: its error (w h)^4 / 384 at the root mean "
            "square frequency of the kernels, " +
            number_text(c.frequency) + " rad/s" + (fixed ? "" : ", is not to be above rtol");
    }
  }
  if (!std::isfinite(limit))
    return "";
  if (fixed && options.step > limit * (1.0 + 1e-12))
    throw ModelError("solver.step", "step = " + number_text(options.step) + " s is longer than " +
                                        number_text(limit) + " s, " + why);
  if (fixed)
    return "";
  // The methods may stretch a step by a tenth rather than leave a short one.
  limit *= 0.9;
  if (options.max_step > 0.0 && options.max_step <= limit)
    return "";
  options.max_step = limit;
  return "steps are at most " + number_text(limit) + " s, nine tenths of " + why;
}

} // namespace hydrodae::system
