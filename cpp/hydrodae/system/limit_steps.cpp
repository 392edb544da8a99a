/// Longest step that the history allows.

#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/history.h"

namespace hydrodae::system {

std::string limit_steps(const System& s, SolverOptions& options) {
  double limit = INFINITY;
  std::string why;
  for (const DelayData& d : s.delays)
    if (d.time < limit) {
      limit = d.time;
      why = "the shortest delay";
    }
  const bool fixed = options.step > 0.0;
  const auto& c = s.hydro.as<water::Convolution>();
  if (!c.empty() && c.frequency > 0.0) {
    if (const double h = 1.0 / c.frequency; h < limit) {
      limit = h;
      why = "what the history of the convolution carries: 1 / w of the root mean square frequency "
            "of the kernels, w = " +
            number_text(c.frequency) + " rad/s";
    }
  }
  if (!std::isfinite(limit))
    return "";
  if (fixed && options.step > limit * (1.0 + 1e-12))
    throw ModelError("solver.step", "step = " + number_text(options.step) + " s is longer than " +
                                        number_text(limit) + " s, " + why);
  if (fixed)
    return "";
  // Methods may lengthen a step by a tenth to avoid a short last one.
  limit *= 0.9;
  if (options.max_step > 0.0 && options.max_step <= limit)
    return "";
  options.max_step = limit;
  return "steps are at most " + number_text(limit) + " s, nine tenths of " + why;
}

} // namespace hydrodae::system
