#include "hydrodae/system/trouble.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "hydrodae/core/text.h"
#include "hydrodae/line/trouble.h"

namespace hydrodae::system {

namespace {

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

} // namespace

std::string unknown_load(const Regime& s, const Workspace<double>& ws) {
  for (std::size_t i = 0; i < s.elements.size(); ++i) {
    const element::Elements& laws = *s.elements[i].laws;
    const auto n_in = static_cast<std::size_t>(laws.shape.n_in()),
               n_out = static_cast<std::size_t>(laws.shape.n_out());
    for (std::size_t law = 0; law < laws.size(); ++law) {
      const double* in = ws.elements[i].in.data() + law * n_in;
      if (!all_finite({in, n_in}) || all_finite({ws.elements[i].out.data() + law * n_out, n_out}))
        continue;
      const bool nowhere =
          element::is_along(laws.shape.port) && *in == 0.0 && ws.elements[i].rows[law].isZero(0.0);
      std::string why = nowhere ? "its points are at one place, where its force has no direction"
                                : line::trouble(laws.type, {in, n_in});
      if (why.empty())
        why = laws.trouble(law, in);
      return std::string(laws.type) + " " + in_quotes(laws.names[law]) + ": " +
             (why.empty() ? "its load is no number" : why);
    }
  }
  return {};
}

} // namespace hydrodae::system
