/// Radiation of a scene, by the rung that it names.

#include <algorithm>

#include "hydrodae/build/check_radiation.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::build {

int label_index(const std::vector<std::string>& labels, const std::string& label) {
  const auto found = std::find(labels.begin(), labels.end(), label);
  return found == labels.end() ? -1 : static_cast<int>(found - labels.begin());
}

std::string hydro_label(const model::Scene& scene, const system::HydroBody& hb, int c) {
  return model::hydro_label(scene, scene.bodies[hb.body], static_cast<std::size_t>(c));
}

namespace {

/// Labels of all coordinates of the bodies (6 n_bodies,); empty where the database of `scene` does
/// not load them.
std::vector<std::string> wet_labels(const model::Scene& scene, const system::HydroData& h) {
  std::vector<std::string> out;
  for (const system::HydroBody& hb : h.bodies)
    for (int c = 0; c < 6; ++c) {
      const bool wet = scene.bodies[static_cast<std::size_t>(hb.body)].hydro.has_value();
      out.push_back(wet ? hydro_label(scene, hb, c) : std::string());
    }
  return out;
}

} // namespace

void add_radiation(const model::Scene& scene, system::System& s) {
  system::HydroData& h = s.hydro;
  const water::RadiationSource source{*scene.database, model::memory_fit(scene), h,
                                      wet_labels(scene, h)};
  model::visit_rung(scene.hydro->radiation, [&]<class Rung>(std::type_identity<Rung>) {
    const water::KeysOfRung<Rung>& keys = *scene.hydro;
    const std::vector<int> place =
        source.all_places(h.radiation.emplace<Rung>().read(source, keys, h.added_mass));
    for (std::size_t k = 0; k < place.size(); ++k)
      if (place[k] < 0 && !source.labels[k].empty())
        h.uncovered.push_back(source.labels[k]);
  });
  h.added_mass.moving = h.moving_rows(h.added_mass.all);
  h.link();
  check_radiation(scene, s);
}

} // namespace hydrodae::build
