#include "hydrodae/sea/new_wave.h"

#include <algorithm>
#include <functional>

#include "hydrodae/core/text.h"
#include "hydrodae/core/types.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::sea {
namespace {

Spectrum spectrum_of(const NewWave& wave) {
  if (wave.spectrum == "table")
    return spectrum_of_points(wave.frequency, wave.density);
  constexpr double any_height = 4.0; // m0 = 1 m2: the crest sets the amplitudes
  if (wave.spectrum == "ochi_hubble") {
    const double l = wave.shape.value_or(1.0);
    return spectrum_of_shape([l](double x) { return ochi_hubble_shape(x, l); }, 0.25 / l,
                             any_height, *wave.period);
  }
  const double gamma = wave.spectrum == "jonswap" ? wave.gamma.value_or(3.3) : 1.0;
  return spectrum_of_shape([gamma](double x) { return jonswap_shape(x, gamma); }, 0.25, any_height,
                           *wave.period);
}

} // namespace

std::optional<Fault> NewWave::fault() const {
  const bool table = spectrum == "table";
  if (!crest.given())
    return Fault{"", "a new_wave needs 'crest' = { height = ..., time = ..., place = [x, y] }"};
  if (table && (frequency.empty() || period))
    return Fault{period ? "peak_period" : "spectrum",
                 "spectrum = \"table\" needs 'frequency' and 'density', and no 'peak_period'"};
  if (!table && (!frequency.empty() || !density.empty()))
    return Fault{frequency.empty() ? "density" : "frequency",
                 "'frequency' and 'density' belong to spectrum = \"table\""};
  if (!table && !period)
    return Fault{"", "spectrum = " + in_quotes(spectrum) + " needs 'peak_period' [s]"};
  if (gamma && spectrum != "jonswap")
    return Fault{"gamma", "'gamma' belongs to spectrum = \"jonswap\""};
  if (shape && spectrum != "ochi_hubble")
    return Fault{"shape", "'shape' belongs to spectrum = \"ochi_hubble\""};
  if (table)
    if (const std::optional<Fault> wrong = table_fault(frequency, density))
      return wrong;
  if (period)
    if (const std::optional<Fault> wrong = period_fault("peak_period", *period))
      return wrong;
  if (const std::optional<Fault> wrong = crest_fault(crest))
    return wrong;
  return range_fault(frequency_range);
}

Sum NewWave::components(const Site& site) const {
  const Spectrum s = spectrum_of(*this);
  const Cut cut = energy_cut(s, frequency_range, site.covered);
  const double low = s.frequency_at(cut.low), high = s.frequency_at(cut.high);
  Sum sum;
  sum.range = range_text(site.covered);
  sum.lost = s.m0 > 0.0 ? cut.lost / s.m0 : 0.0;
  const double step = (high - low) / count;
  double whole = 0.0;
  for (int n = 0; n < count; ++n) {
    const double energy = s.energy_below(low + (n + 1) * step) - s.energy_below(low + n * step);
    if (!(energy > 0.0))
      continue;
    const double w = low + (n + 0.5) * step, k = wavenumber(w, site.depth, site.gravity);
    const double along = crest.x() * std::cos(heading) + crest.y() * std::sin(heading);
    const double phase = std::remainder(k * along - w * crest.time, 2.0 * pi);
    sum.components.push_back({w, k, heading, energy, phase});
    whole += energy;
  }
  for (Component& c : sum.components)
    c.amplitude *= crest.height / whole;
  sum.note = "wave " + in_quotes(name) + ": NewWave of " + std::to_string(sum.components.size()) +
             " components from " + number_text(low) + " to " + number_text(high) +
             " rad/s; it repeats after " + rounded_text(2.0 * pi / step, 4) + " s";
  if (sum.lost > 0.0)
    sum.note += "; " + sum.lost_text() + ", and is left out";
  return sum;
}

} // namespace hydrodae::sea
