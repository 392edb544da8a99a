#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

const std::vector<std::string> irregular_keys = {"spreading", "components", "spacing",
                                                 "frequency_range", "seed"};

/// Keys that a type of wave must and may have, apart from name, type and heading_deg.
struct WaveKeys {
  std::vector<std::string> needed, optional;
};

WaveKeys keys_of(const std::string& type) {
  if (type == "regular")
    return {{"height", "period"}, {"phase_deg"}};
  if (type == "table")
    return {{"frequency", "density"}, irregular_keys};
  WaveKeys keys{{"significant_height", "peak_period"}, irregular_keys};
  if (type == "pierson_moskowitz")
    keys.needed.pop_back();
  if (type == "jonswap")
    keys.optional.emplace_back("gamma");
  if (type == "ochi_hubble")
    keys.optional.emplace_back("shape");
  return keys;
}

/// Was the key written in the case file (or on the command line)?
bool given(const Scene& scene, const sea::Wave& wave, const std::string& key) {
  return scene.positions.contains("wave." + wave.name + "." + key);
}

void check_keys(const Scene& scene, const sea::Wave& wave) {
  const Entry entry{"wave", wave.name};
  const WaveKeys keys = keys_of(wave.type);
  const bool has_height = wave.height.has_value(), has_period = wave.period.has_value();
  for (const std::string& key : keys.needed) {
    const bool there = key == "height"               ? has_height
                       : key == "period"             ? has_period
                       : key == "significant_height" ? wave.significant_height.has_value()
                       : key == "peak_period"        ? wave.peak_period.has_value()
                       : key == "frequency"          ? !wave.frequency.empty()
                                                     : !wave.density.empty();
    if (!there)
      refuse(entry, "", "a " + wave.type + " wave needs the key " + in_quotes(key));
  }
  std::vector<std::string> allowed = {"name", "type", "heading_deg"};
  allowed.insert(allowed.end(), keys.needed.begin(), keys.needed.end());
  allowed.insert(allowed.end(), keys.optional.begin(), keys.optional.end());
  for (const Field<sea::Wave>& field : sea::Wave::fields()) {
    const std::string key(field.key);
    if (given(scene, wave, key) && std::find(allowed.begin(), allowed.end(), key) == allowed.end())
      refuse(entry, key,
             "a " + wave.type + " wave has no " + in_quotes(key) + "; it has: " + joined(allowed));
  }
}

void check_wave(const Scene& scene, const sea::Wave& wave) {
  const Entry entry{"wave", wave.name};
  check_keys(scene, wave);
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
  if (!scene.waves.empty() && !scene.hydro && scene.morison.empty())
    throw ModelError("wave." + scene.waves.front().name,
                     "waves need a hydrodynamic database or Morison elements to act on: the table "
                     "[hydro] is missing");
  if (!scene.sea.current.isZero(0.0) && scene.morison.empty())
    throw ModelError("sea.current", "a current acts on [[morison]] elements, and there is none");
  if (scene.sea.ramp > 0.0 && scene.waves.empty())
    throw ModelError("sea.ramp", "there is no [[wave]] to ramp up");
}

} // namespace hydrodae::model
