#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/type_keys.h"
#include "hydrodae/sea/record.h"

namespace hydrodae::model {
namespace {

constexpr double shortest_period = 1e-3; // [s]

/// Was the key written in the case file (or on the command line)?
bool given(const Scene& scene, const sea::Wave& wave, const std::string& key) {
  return scene.positions.contains("wave." + wave.name + "." + key);
}

void check_keys(const Scene& scene, const sea::Wave& wave) {
  const Entry entry{"wave", wave.name};
  const bool has_height = wave.height.has_value(), has_period = wave.period.has_value();
  const std::vector<std::string> allowed = keys_of_type("wave", wave.type);
  for (const Field<sea::Wave>& field : sea::Wave::fields()) {
    const std::string key(field.key);
    if (given(scene, wave, key) && std::find(allowed.begin(), allowed.end(), key) == allowed.end())
      refuse(entry, key,
             "a " + wave.type + " wave has no " + in_quotes(key) + "; it has: " + joined(allowed));
  }
  for (const std::string& key : needed_keys("wave", wave.type)) {
    const bool there = key == "height"               ? has_height
                       : key == "period"             ? has_period
                       : key == "significant_height" ? wave.significant_height.has_value()
                       : key == "peak_period"        ? wave.peak_period.has_value()
                       : key == "frequency"          ? !wave.frequency.empty()
                                                     : !wave.density.empty();
    if (!there)
      refuse(entry, "", "a " + wave.type + " wave needs the key " + in_quotes(key));
  }
}

/// The record of a measured wave: equal steps, and as long as the run.
void check_record(const Scene& scene, const sea::Wave& wave) {
  const Entry entry{"wave", wave.name};
  if (wave.file && (given(scene, wave, "time") || given(scene, wave, "elevation")))
    refuse(entry, "file", "give either 'file', or 'time' and 'elevation'");
  const std::string key = wave.file ? "file" : "time";
  if (!wave.file && wave.time.empty() && wave.elevation.empty())
    refuse(entry, "", "a measured wave needs 'file', or 'time' and 'elevation'");
  const std::size_t n = wave.time.size();
  if (n != wave.elevation.size() || n < 8)
    refuse(entry, key, "time and elevation must be of equal length, 8 samples or more");
  if (!wave.point.empty() && wave.point.size() != 2)
    refuse(entry, "point", "expected [x, y] of the place of the measurement [m]");
  const double step = sea::record_step(wave), length = wave.time.back() - wave.time.front();
  for (std::size_t j = 1; j < n; ++j)
    if (!(std::abs(wave.time[j] - wave.time[j - 1] - step) <= 0.01 * step))
      refuse(entry, key,
             "the record must have equal steps of time, " + number_text(step) +
                 " s on the average; from " + number_text(wave.time[j - 1]) + " s to " +
                 number_text(wave.time[j]) + " s it has " +
                 number_text(wave.time[j] - wave.time[j - 1]) + " s");
  if (wave.start + scene.solver.end_time > length * (1.0 + 1e-12))
    refuse(entry, key,
           "the record is " + number_text(length) + " s long; the run needs it from " +
               number_text(wave.start) + " s to " +
               number_text(wave.start + scene.solver.end_time) + " s (solver.end_time)");
  if (2.0 * wave.taper > length)
    refuse(entry, "taper", "the record is shorter than its two ends that fade");
}

void check_wave(const Scene& scene, const sea::Wave& wave) {
  const Entry entry{"wave", wave.name};
  check_keys(scene, wave);
  for (const auto& [key, period] :
       {std::pair{"period", wave.period}, std::pair{"peak_period", wave.peak_period}})
    if (period && *period < shortest_period)
      refuse(entry, key,
             "waves shorter than " + number_text(shortest_period) + " s are none of gravity, got " +
                 number_text(*period) + " s");
  if (wave.type == "measured")
    check_record(scene, wave);
  if (wave.type == "table") {
    if (wave.frequency.size() != wave.density.size() || wave.frequency.size() < 2)
      refuse(entry, "density", "frequency and density must be two lists of equal length >= 2");
    if (!std::is_sorted(wave.frequency.begin(), wave.frequency.end(), std::less_equal<>()))
      refuse(entry, "frequency", "the frequencies must ascend");
  }
  const std::vector<double>& range = wave.frequency_range;
  if (!range.empty() && (range.size() != 2 || !(range[0] < range[1])))
    refuse(entry, "frequency_range", "expected the lowest and the highest frequency [rad/s]");
}

} // namespace

void check_sea(const Scene& scene) {
  for (const sea::Wave& wave : scene.waves)
    check_wave(scene, wave);
  const bool slender =
      !scene.morison.empty() || !std::get<std::vector<line::Line>>(scene.forces).empty();
  const bool meshed = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                  [](const Body& body) { return body.froude_krylov == "mesh"; });
  if (!scene.waves.empty() && !scene.hydro && !slender && !meshed)
    throw ModelError("wave." + scene.waves.front().name,
                     "waves need a hydrodynamic database, Morison elements, lines or a body with "
                     "froude_krylov = \"mesh\" to act on: the table [hydro] is missing");
  if (!meshed && (scene.sea.bernoulli || scene.sea.stretching != "vertical"))
    throw ModelError(scene.sea.bernoulli ? "sea.bernoulli" : "sea.stretching",
                     "this acts on bodies with froude_krylov = \"mesh\", and there are none");
  if (scene.sea.phase == "moving" && (scene.waves.empty() || !scene.hydro))
    throw ModelError("sea.phase", "phase = \"moving\" is about waves on bodies of the hydrodynamic "
                                  "database, and there are none");
  if (!scene.sea.current.isZero(0.0) && !slender)
    throw ModelError("sea.current", "a current acts on [[morison]] elements, and there is none");
  if (scene.sea.ramp > 0.0 && scene.waves.empty())
    throw ModelError("sea.ramp", "there is no [[wave]] to ramp up");
}

} // namespace hydrodae::model
