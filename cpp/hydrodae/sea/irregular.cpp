/// Irregular waves drawn from their spectrum.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/sea/dispersion.h"
#include "hydrodae/sea/random.h"
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {
namespace {

constexpr double cut_below = 1e-3, cut_above = 5e-3; ///< parts of the energy outside the range

/// Angles from the mean heading at equal steps of the integral of cos^2s(theta/2) over +-90 deg.
class Directions {
public:
  explicit Directions(double s) {
    for (std::size_t i = 0; i <= cells; ++i)
      cumulative_[i] =
          i == 0 ? 0.0
                 : cumulative_[i - 1] + 0.5 * (density(s, angle(i - 1)) + density(s, angle(i)));
  }

  /// Inverse of the cumulative distribution, u in [0, 1).
  double operator()(double u) const {
    const double wanted = u * cumulative_.back();
    std::size_t i = 0;
    while (i + 1 < cells && cumulative_[i + 1] < wanted)
      ++i;
    const double step = cumulative_[i + 1] - cumulative_[i];
    const double x = step > 0.0 ? (wanted - cumulative_[i]) / step : 0.5;
    return angle(i) + x * (angle(i + 1) - angle(i));
  }

private:
  static constexpr std::size_t cells = 2000;
  static double angle(std::size_t i) {
    return pi * (static_cast<double>(i) / static_cast<double>(cells) - 0.5);
  }
  static double density(double s, double theta) { return std::pow(std::cos(0.5 * theta), 2.0 * s); }
  std::vector<double> cumulative_ = std::vector<double>(cells + 1);
};

/// Energies below the lowest and the highest frequency of the components [m2].
struct Cut {
  double low = 0.0, high = 0.0;
};

Cut usual_cut(const Irregular& wave, const Spectrum& s) {
  if (!wave.frequency_range.empty())
    return {s.energy_below(wave.frequency_range[0]), s.energy_below(wave.frequency_range[1])};
  if (s.ends)
    return {s.energy_below(s.omega.front()), s.cumulative.back()};
  return {cut_below * s.m0, (1.0 - cut_above) * s.m0};
}

/// Applies a cut; a range that was not given is limited to the covered frequencies.
Cut cut_to(const Irregular& wave, Cut cut, const Spectrum& s, const Band& covered) {
  if (!wave.frequency_range.empty())
    return cut;
  if (covered.low > s.omega.front())
    cut.low = std::max(cut.low, s.energy_below(covered.low));
  if (covered.high < s.omega.back())
    cut.high = std::min(cut.high, s.energy_below(covered.high));
  cut.high = std::max(cut.low, cut.high);
  return cut;
}

} // namespace

std::string Sum::lost_text() const {
  return number_text(std::round(1e4 * lost) / 1e2) + " % of the variance lies outside " + range;
}

Sum Irregular::drawn(const Spectrum& s, const Site& site) const {
  Sum sum;
  sum.range = "the database, " + number_text(site.covered.low) + " to " +
              number_text(site.covered.high) + " rad/s";
  if (!(s.m0 > 0.0))
    return sum;
  const Cut usual = usual_cut(*this, s), cut = cut_to(*this, usual, s, site.covered);
  const double low = cut.low, high = cut.high;
  sum.lost = (usual.high - usual.low - (high - low)) / s.m0;
  const double w_low = s.frequency_at(low), w_high = s.frequency_at(high);
  Random random(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < count; ++i) {
    const double a = static_cast<double>(i) / count;
    const double b = static_cast<double>(i + 1) / count;
    const double u = random.uniform(), phase = 2.0 * pi * random.uniform();
    double energy = (high - low) / count, w = 0.0;
    if (spacing == "energy") {
      w = s.frequency_at(low + (high - low) * (a + u * (b - a)));
    } else {
      w = w_low + (w_high - w_low) * (a + u * (b - a));
      energy = s.energy_below(w_low + (w_high - w_low) * b) -
               s.energy_below(w_low + (w_high - w_low) * a);
    }
    if (frequency_range.empty()) // up to rounding it is there already
      w = std::clamp(w, site.covered.low, std::max(site.covered.low, site.covered.high));
    if (energy > 0.0)
      sum.components.push_back(
          {w, wavenumber(w, site.depth, site.gravity), heading, std::sqrt(2.0 * energy), phase});
  }
  if (spreading) {
    const Directions directions(*spreading);
    double u = random.uniform();
    for (Component& c : sum.components) {
      c.heading += directions(u);
      u += 0.5 * (std::sqrt(5.0) - 1.0);
      u -= std::floor(u);
    }
  }
  sum.note = "wave " + in_quotes(name) + ": " + std::to_string(sum.components.size()) +
             " components from " + number_text(w_low) + " to " + number_text(w_high) +
             " rad/s hold " + number_text(100.0 * (high - low) / s.m0) + " % of the energy";
  if (sum.lost > 0.0)
    sum.note += "; " + sum.lost_text() + ", and is left out";
  return sum;
}

std::optional<Fault> period_fault(const char* key, double period) {
  if (period < shortest_period)
    return Fault{key, "waves shorter than " + number_text(shortest_period) +
                          " s are no gravity waves, got " + number_text(period) + " s"};
  return {};
}

double ramp(double t, double duration) {
  if (duration <= 0.0 || t >= duration)
    return 1.0;
  if (t <= 0.0)
    return 0.0;
  const double x = t / duration;
  return x * x * x * x * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x)));
}

} // namespace hydrodae::sea
