#include "hydrodae/sea/component_file.h"

#include "hydrodae/core/text.h"
#include "hydrodae/core/types.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::sea {

double ComponentFile::significant_height() const {
  double square = 0.0;
  for (const double a : amplitude)
    square += a * a;
  return 4.0 * std::sqrt(0.5 * square);
}

std::optional<Fault> ComponentFile::fault() const {
  if (!file && omega.empty())
    return Fault{"", "a wave of components needs 'file', or 'omega', 'amplitude' and 'phase'"};
  const std::size_t n = omega.size();
  if (amplitude.size() != n || phase.size() != n || (!headings.empty() && headings.size() != n))
    return Fault{"omega", "'omega', 'amplitude', 'phase' and 'headings_deg' must be lists of equal "
                          "length"};
  for (const double w : omega)
    if (const std::optional<Fault> wrong = period_fault(file ? "file" : "omega", 2.0 * pi / w))
      return wrong;
  return range_fault(frequency_range);
}

Sum ComponentFile::components(const Site& site) const {
  const bool own = !frequency_range.empty();
  constexpr double slack = 1e-9; // of the ends of the range
  const double low = own ? frequency_range[0] : site.covered.low,
               high = own ? frequency_range[1] : site.covered.high;
  Sum out;
  double whole = 0.0, kept = 0.0;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double energy = 0.5 * amplitude[i] * amplitude[i];
    whole += energy;
    if (omega[i] < low * (1.0 - slack) || omega[i] > high * (1.0 + slack))
      continue;
    kept += energy;
    out.components.push_back({omega[i], wavenumber(omega[i], site.depth, site.gravity),
                              headings.empty() ? heading : headings[i], amplitude[i], phase[i]});
  }
  out.lost = whole > 0.0 ? std::max(1.0 - kept / whole, 0.0) : 0.0;
  if (out.components.size() == omega.size())
    out.lost = 0.0; // rounding
  out.range = number_text(low) + " to " + number_text(high) + " rad/s";
  out.note = "wave " + in_quotes(name) + ": " + std::to_string(out.components.size()) + " of " +
             std::to_string(omega.size()) + " components";
  if (out.lost > 0.0)
    out.note += "; " + out.lost_text() + ", and is left out";
  return out;
}

} // namespace hydrodae::sea
