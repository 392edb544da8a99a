#include "hydrodae/model/waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  const double allowed = wave.lost_variance.value_or(0.02);
  if (1.0 - r.kept > allowed)
    throw ModelError("wave." + wave.name + (wave.file ? ".file" : ".elevation"),
                     head + number_text(100.0 * (1.0 - r.kept)) +
                         " % of the variance of the record lies outside " + number_text(low) +
                         " to " + number_text(high) +
                         " rad/s, more than lost_variance = " + number_text(allowed) + " allows");
  if (note && !r.components.empty())
    *note = head + "mean " + number_text(r.mean) + " m of the record taken off, faded over " +
            number_text(wave.taper) + " s at both ends; " + std::to_string(r.components.size()) +
            " components from " + number_text(r.components.front().omega) + " to " +
            number_text(r.components.back().omega) + " rad/s hold " + number_text(100.0 * r.kept) +
            " % of its variance";
  return r.components;
}

/// An irregular wave, without what lies beyond the tables of the database.
std::vector<sea::Component> spectral(const Scene& scene, const sea::Wave& wave, const Water& water,
                                     std::string* note) {
  sea::Band covered;
  if (wave.type != "regular" && scene.database && scene.database->omega.size() > 0)
    covered = {scene.database->omega[0], scene.database->omega[scene.database->omega.size() - 1]};
  double lost = 0.0;
  std::vector<sea::Component> out =
      sea::components(wave, water.depth, water.gravity, note, covered, &lost);
  const double allowed = wave.lost_variance.value_or(0.1);
  const std::string table =
      "the database, " + number_text(covered.low) + " to " + number_text(covered.high) + " rad/s";
  const std::string part = number_text(std::round(1e4 * lost) / 1e2) + " % of the variance";
  if (lost > std::min(allowed, 0.99))
    throw ModelError("wave." + wave.name,
                     "wave " + in_quotes(wave.name) + ": " + part + " lies outside " + table +
                         ", more than lost_variance = " + number_text(allowed) +
                         " allows; a database of more frequencies, or another "
                         "'frequency_range' or 'lost_variance'");
  if (note && lost > 0.0)
    *note += "; " + part + " lies outside " + table + ", and is left out";
  return out;
}

} // namespace

std::vector<sea::Component> wave_components(const Scene& scene, const sea::Wave& wave,
                                            std::string* note) {
  const Water w = water(scene);
  return wave.type == "measured" ? measured(scene, wave, w, note) : spectral(scene, wave, w, note);
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
  double variance = 0.0, lengths = 0.0;
  for (const sea::Wave& wave : scene.waves)
    if (wave.type != "regular")
      for (const sea::Component& c : wave_components(scene, wave)) {
        variance += c.amplitude * c.amplitude;
        lengths += c.amplitude * c.amplitude / c.omega;
      }
  return variance > 0.0 ? 2.0 * std::numbers::pi * lengths / variance : 0.0;
}

} // namespace hydrodae::model
