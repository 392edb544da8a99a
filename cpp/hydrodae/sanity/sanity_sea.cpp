/// Height of the waves against their length and the depth.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/sanity/sanity.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::sanity {

namespace {

/// Largest steepness Hs / (g Tp^2 / 2 pi) of seas: 1/15 up to 8 s, 1/25 from 15 s, a straight line
/// between (DNV-RP-C205, section 3.5.5).
double steepest_sea(double peak_period) {
  return std::lerp(1.0 / 15.0, 1.0 / 25.0, std::clamp((peak_period - 8.0) / 7.0, 0.0, 1.0));
}

/// Breaking height over length of a regular wave: 0.142 tanh(k h) (Miche 1944).
constexpr double breaking = 0.142;
/// Breaking limit of a significant height, as part of the depth
constexpr double breaking_over_depth = 0.6;
constexpr double linear = 0.05; ///< height over length above which linear theory is stretched

void judge_regular(const sea::Regular& wave, const model::Water& water, std::vector<Finding>& out) {
  const double H = wave.height,
               k = sea::wavenumber(2.0 * pi / wave.period, water.depth, water.gravity);
  const double length = 2.0 * pi / k, limit = breaking * std::tanh(k * water.depth);
  if (!(H > linear * length))
    return;
  const std::string text = "wave " + in_quotes(wave.name) + ": height " + rounded_text(H, 3) +
                           " m is " + rounded_text(H / length, 3) + " of its length of " +
                           rounded_text(length, 3) + " m; ";
  if (H > limit * length)
    out.push_back({true, text + "waves break at " + rounded_text(limit, 3)});
  else
    out.push_back(
        {false, text + "linear theory is meant for less than " + rounded_text(linear, 3)});
}

void judge_irregular(const std::string& name, double height, double period,
                     const model::Water& water, std::vector<Finding>& out) {
  if (!(height > 0.0))
    return;
  const double steepness = height / (water.gravity * period * period / (2.0 * pi));
  if (steepness > steepest_sea(period))
    out.push_back({true, "wave " + in_quotes(name) + ": significant height " +
                             rounded_text(height, 3) + " m at a peak period of " +
                             rounded_text(period, 3) + " s is a steepness of " +
                             rounded_text(steepness, 3) + "; seas of that period reach " +
                             rounded_text(steepest_sea(period), 3) + " (DNV-RP-C205)"});
}

/// A crest breaks where the steepness A k of its mean wave number, weighted by the energies that
/// the crest is made of, is more than that of a regular wave at Miche's limit: H k / 2 = pi 0.142
/// tanh kd.
void judge_crest(const sea::Wave& wave, const model::Scene& scene, std::vector<Finding>& out) {
  const model::Water water = model::water(scene);
  const sea::Site site{water.depth, water.gravity, {}};
  wave.visit([&](const auto& one) {
    if constexpr (requires { one.crest; }) {
      if (!one.crest.given())
        return;
      auto free = one; // its components without the crest have the energies of the spectrum
      if constexpr (requires { one.significant_height(); })
        free.crest = {};
      double energy = 0.0, sum = 0.0;
      for (const sea::Component& c : free.components(site).components) {
        // of NewWave the amplitudes are the energies
        const double part = free.crest.given() ? c.amplitude : c.amplitude * c.amplitude;
        energy += part;
        sum += part * c.wavenumber;
      }
      const double k = energy > 0.0 ? sum / energy : 0.0, steepness = one.crest.height * k;
      const double limit = pi * breaking * std::tanh(k * water.depth);
      if (steepness > limit)
        out.push_back({true, "wave " + in_quotes(one.name) + ": the crest of " +
                                 rounded_text(one.crest.height, 3) + " m has a steepness of " +
                                 rounded_text(steepness, 3) + "; waves break at " +
                                 rounded_text(limit, 3)});
    }
  });
}

} // namespace

std::vector<Finding> look_at_sea(const model::Scene& scene) {
  std::vector<Finding> out;
  const model::Water water = model::water(scene);
  if (!(water.gravity > 0.0))
    return out;
  double squares = 0.0; // sum of squares of the significant heights
  for (const sea::Wave& wave : scene.waves) {
    if (const auto* regular = wave.as<sea::Regular>())
      judge_regular(*regular, water, out);
    judge_crest(wave, scene, out);
    wave.visit([&](const auto& one) {
      if constexpr (requires { one.significant_height(); }) {
        const double height = one.significant_height();
        squares += height * height;
        if constexpr (requires { one.peak_period(water.gravity); })
          judge_irregular(one.name, height, one.peak_period(water.gravity), water, out);
      }
    });
  }
  if (std::sqrt(squares) > breaking_over_depth * water.depth)
    out.push_back({true, "the significant height of the sea, " +
                             rounded_text(std::sqrt(squares), 3) + " m, is more than " +
                             rounded_text(breaking_over_depth, 3) + " of the depth of " +
                             rounded_text(water.depth, 3) + " m: the waves break"});
  return out;
}

} // namespace hydrodae::sanity
