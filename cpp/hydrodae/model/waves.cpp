#include "hydrodae/model/waves.h"

#include "hydrodae/core/text.h"
#include "hydrodae/sea/record.h"

namespace hydrodae::model {
namespace {

std::vector<sea::Component> measured(const Scene& scene, const sea::Wave& wave, const Water& water,
                                     std::string* note) {
  double low = 0.0, high = INFINITY;
  if (!wave.frequency_range.empty()) {
    low = wave.frequency_range[0];
    high = wave.frequency_range[1];
  } else if (scene.database && scene.database->omega.size() > 0) {
    low = scene.database->omega[0];
    high = scene.database->omega[scene.database->omega.size() - 1];
  }
  const sea::RecordComponents r =
      sea::record_components(wave, water.depth, water.gravity, low, high);
  const std::string head = "wave " + in_quotes(wave.name) + ": ";
  if (1.0 - r.kept > wave.lost_variance)
    throw ModelError("wave." + wave.name + (wave.file ? ".file" : ".elevation"),
                     head + number_text(100.0 * (1.0 - r.kept)) +
                         " % of the variance of the record lies outside " + number_text(low) +
                         " to " + number_text(high) + " rad/s, more than lost_variance = " +
                         number_text(wave.lost_variance) + " allows");
  if (note && !r.components.empty())
    *note = head + "mean " + number_text(r.mean) + " m of the record taken off, faded over " +
            number_text(wave.taper) + " s at both ends; " + std::to_string(r.components.size()) +
            " components from " + number_text(r.components.front().omega) + " to " +
            number_text(r.components.back().omega) + " rad/s hold " + number_text(100.0 * r.kept) +
            " % of its variance";
  return r.components;
}

} // namespace

std::vector<sea::Component> wave_components(const Scene& scene, const sea::Wave& wave,
                                            std::string* note) {
  const Water w = water(scene);
  return wave.type == "measured" ? measured(scene, wave, w, note)
                                 : sea::components(wave, w.depth, w.gravity, note);
}

std::vector<sea::Component> wave_components(const Scene& scene) {
  std::vector<sea::Component> all;
  for (const sea::Wave& wave : scene.waves) {
    const std::vector<sea::Component> own = wave_components(scene, wave);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

} // namespace hydrodae::model
