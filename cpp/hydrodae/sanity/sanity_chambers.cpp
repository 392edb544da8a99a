/// Findings on chambers of air: volumes that are too small for the water below them.

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/sanity/sanity.h"

namespace hydrodae::sanity {

/// Ratio of the stiffness of the air, n p_a S^2/V0, to that of the water, rho g S, above which the
/// volume is probably to the scale of the model. It is n p_a/(rho g h) with h = V0/S: 3 for 5 m of
/// air at sea, and 20 for 0.7 m, which waves at sea would fill. In a model with the air over the
/// square of the scale it is that of the device; over the cube it is as many times larger as the
/// scale.
static constexpr double stiff_air = 20.0;

std::vector<Finding> look_at_chambers(const model::Scene& scene) {
  std::vector<Finding> out;
  const double outside = scene.environment.air_pressure.value_or(air::Atmosphere().pressure);
  for (const air::Chamber& chamber : scene.chambers) {
    double area = 0.0, water = 0.0;
    for (const air::Piston& piston : scene.pistons)
      if (const auto below = model::water_of_piston(scene, piston);
          below && piston.chamber == chamber.name) {
        area += piston.area;
        water += below->stiffness;
      }
    const bool joined =
        std::any_of(scene.outlets.begin(), scene.outlets.end(), [&](const air::AnyOutlet& outlet) {
          return outlet->to && (outlet->chamber == chamber.name || *outlet->to == chamber.name);
        });
    if (joined || area == 0.0)
      continue; // a tank has air, too
    const double ratio = chamber.exponent * outside * area * area / chamber.volume / water;
    if (ratio > stiff_air)
      out.push_back(
          {false, "chamber " + in_quotes(chamber.name) + ": its air is " + rounded_text(ratio, 3) +
                      " times as stiff as the water below it, as of a model whose air is "
                      "to scale by the cube; a model at 1 : e needs the air of the device "
                      "over e^2, because the pressure of the atmosphere has no scale"});
  }
  return out;
}

} // namespace hydrodae::sanity
