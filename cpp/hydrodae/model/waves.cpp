#include "hydrodae/model/waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydrodae/core/text.h"

namespace hydrodae::model {

std::vector<sea::Component> wave_components(const Scene& scene, const sea::Wave& wave,
                                            std::string* note) {
  const Water w = water(scene);
  sea::Site site{w.depth, w.gravity, {}};
  if (scene.database && scene.database->omega.size() > 0)
    site.covered = {scene.database->omega[0],
                    scene.database->omega[scene.database->omega.size() - 1]};
  sea::Sum sum = wave.visit([&](const auto& one) { return one.components(site); });
  const double usual = wave.visit([](const auto& one) { return one.usual_loss; });
  const double allowed = wave->lost_variance.value_or(usual);
  if (sum.lost > std::min(allowed, 0.99))
    throw ModelError("wave." + wave->name + ".lost_variance",
                     "wave " + in_quotes(wave->name) + ": " + sum.lost_text() +
                         ", more than lost_variance = " + number_text(allowed) +
                         " allows; a database of more frequencies, or another "
                         "'frequency_range' or 'lost_variance'");
  if (note)
    *note = sum.note;
  return std::move(sum.components);
}

std::vector<sea::Component> wave_components(const Scene& scene) {
  std::vector<sea::Component> all;
  for (const sea::Wave& wave : scene.waves) {
    const std::vector<sea::Component> own = wave_components(scene, wave);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

double irregular_period(const Scene& scene) {
  const auto is_placed = [](const sea::Wave& wave) {
    const auto* irregular = wave.as<sea::Irregular>();
    return wave.as<sea::NewWave>() || wave.as<sea::ComponentFile>() ||
           (irregular && irregular->crest.given());
  };
  if (std::any_of(scene.waves.begin(), scene.waves.end(), is_placed))
    return 0.0;
  double variance = 0.0, lengths = 0.0;
  for (const sea::Wave& wave : scene.waves)
    if (!wave.as<sea::Regular>())
      for (const sea::Component& c : wave_components(scene, wave)) {
        variance += c.amplitude * c.amplitude;
        lengths += c.amplitude * c.amplitude / c.omega;
      }
  return variance > 0.0 ? 2.0 * std::numbers::pi * lengths / variance : 0.0;
}

} // namespace hydrodae::model
