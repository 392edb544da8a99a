#include "hydrodae/build/bound_waves.h"

#include <cmath>
#include <memory>

#include "hydrodae/core/text.h"
#include "hydrodae/line/line.h"
#include "hydrodae/sea/second_order.h"

namespace hydrodae::build {
namespace {

/// The quadratic form of the elevation then takes 64 MB and two million pairs.
constexpr std::size_t most_components = 2000;

/// Significant height of the sea [m]: of a regular wave sqrt(2) H, the same variance; of a NewWave
/// the height of its crest, as the largest crest of a sea is about its significant height.
double height_of(const model::Scene& scene) {
  double squares = 0.0;
  for (const sea::Wave& wave : scene.waves)
    wave.visit([&](const auto& one) {
      double height = 0.0;
      if constexpr (requires { one.significant_height(); })
        height = one.significant_height();
      else if constexpr (requires { one.crest; })
        height = one.crest.height;
      else
        height = std::sqrt(2.0) * one.height;
      squares += height * height;
    });
  return std::sqrt(squares);
}

std::string percent_of(double part) { return rounded_text(100.0 * part, 3) + " %"; }

} // namespace

void add_bound_waves(const model::Scene& scene, Sea& sea) {
  const model::Water water = model::water(scene);
  const double limit =
      scene.sea.second_order_limit.value_or(std::sqrt(2.0 * water.gravity / height_of(scene)));
  std::vector<sea::Component> below;
  for (const sea::Component& c : sea.all)
    if (c.omega <= limit && c.amplitude != 0.0)
      below.push_back(c);
  if (below.size() > most_components)
    throw ModelError("sea.order", "order = 2 takes at most " + std::to_string(most_components) +
                                      " components, and there are " + std::to_string(below.size()) +
                                      "; set 'components' of the waves or 'second_order_limit'");
  sea.note = "waves of second order: " + std::to_string(below.size()) + " of " +
             std::to_string(sea.all.size()) + " components, up to " + rounded_text(limit, 4) +
             " rad/s (second_order_limit), make bound waves; the excitation of bodies by the "
             "database and by meshes is of first order";
  if (!scene.gauges.empty())
    sea.second = std::make_shared<sea::SecondOrder>(below, water.depth, water.gravity);
  if (scene.morison.empty() && model::forces_of<line::Line>(scene).empty())
    return;
  const sea::BoundWaves bound = sea::bound_waves(
      below, water.depth, water.gravity, static_cast<std::size_t>(scene.sea.second_order_terms));
  sea.field.terms.append(bound.terms);
  sea.note +=
      "; Morison elements and lines feel the " +
      std::to_string(std::min(bound.all, static_cast<std::size_t>(scene.sea.second_order_terms))) +
      " largest of " + std::to_string(bound.all) +
      " bound waves (second_order_terms): " + percent_of(bound.elevation) +
      " of the rms of their elevation and " + percent_of(bound.speed) +
      " of that of their velocity at the surface";
}

} // namespace hydrodae::build
