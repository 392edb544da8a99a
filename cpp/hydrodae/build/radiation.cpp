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

void add_shared_mass(const model::Scene& scene, system::HydroData& h) {
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const model::Body& body = scene.bodies[static_cast<std::size_t>(h.bodies[i].body)];
    const MatrixX M = body.part ? MatrixX() : model::shared_mass(scene, body.name);
    if (M.isZero(0.0))
      continue;
    std::vector<std::pair<Index, int>> at; // row among all coordinates, and column in U
    for (std::size_t k = i; k < h.bodies.size(); ++k)
      for (std::size_t c = 0; c < (k == i ? 6 : 1); ++c)
        if (static_cast<std::size_t>(h.bodies[k].carrier) == i)
          at.emplace_back(static_cast<Index>(6 * k + c), h.bodies[k].moving[c]);
    for (std::size_t m = 0; m < at.size(); ++m)
      for (std::size_t n = 0; n < at.size(); ++n)
        if (at[n].second >= 0)
          h.added_mass.all(at[m].first, at[n].second) +=
              M(static_cast<Index>(m), static_cast<Index>(n));
  }
  h.added_mass.moving = h.moving_rows(h.added_mass.all);
}

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
  add_shared_mass(scene, h);
  h.link();
  check_radiation(scene, s);
}

} // namespace hydrodae::build
