/// Meshes in the water: hydrostatics and Froude-Krylov loads of the wetted surface.

#include <cmath>

#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hull/floating.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/model/waves.h"
#include "hydrodae/water/hull_list.h"

namespace hydrodae::build {

namespace {

constexpr double same_volume = 0.01; ///< of the database: more is noted

hull::Water water_of_hulls(const model::Scene& scene) {
  const model::Water water = model::water(scene);
  const std::string& name = scene.sea.stretching;
  const hull::Stretching stretching = name == "wheeler"        ? hull::Stretching::wheeler
                                      : name == "extrapolated" ? hull::Stretching::extrapolated
                                                               : hull::Stretching::vertical;
  return {water.density, water.gravity, water.depth, stretching, scene.sea.bernoulli};
}

std::vector<hull::Wave> waves_of_hulls(const model::Scene& scene) {
  std::vector<hull::Wave> out;
  for (const sea::Component& c : model::wave_components(scene))
    if (c.amplitude != 0.0)
      out.push_back({c.omega, c.wavenumber, c.heading, c.amplitude, c.phase});
  return out;
}

/// What the mesh displaces in the reference pose, beside the database.
void note_volume(const model::Scene& scene, const model::Body& body, const hull::Water& water,
                 system::System& s) {
  const hull::WaveField still(water);
  hull::Workspace work(*body.hull, still);
  const hull::Floating f =
      hull::floating(*body.hull, still, {body.center_of_gravity, Matrix3::Identity()}, work);
  std::string text = "body " + in_quotes(body.name) + ": the mesh displaces " +
                     rounded_text(f.volume, 5) + " m3 in the reference pose";
  const hydro::DatabaseBody* entry =
      body.hydro && scene.database ? hydro::find_body(*scene.database, *body.hydro) : nullptr;
  if (entry && entry->hydrostatics) {
    const double volume = entry->hydrostatics->displaced_volume;
    text += ", the body of the database " + rounded_text(volume, 5) + " m3";
    if (std::abs(f.volume - volume) > same_volume * volume)
      text = "looks wrong: " + text;
  }
  s.notes.push_back(text);
}

} // namespace

void add_hulls(const model::Scene& scene, bool with_waves, system::System& s) {
  const hull::Water water = water_of_hulls(scene);
  for (const bool in_waves : {false, true}) {
    std::shared_ptr<water::HullList> list;
    system::ElementList entry;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const model::Body& body = scene.bodies[i];
      if (!body.hull || (body.froude_krylov == "mesh") != in_waves)
        continue;
      if (!list)
        list = std::make_shared<water::HullList>(
            water, in_waves && with_waves ? waves_of_hulls(scene) : std::vector<hull::Wave>(),
            scene.sea.ramp);
      list->add(body.name, body.hull, body.center_of_gravity, s.bodies[i].n_active > 0);
      note_volume(scene, body, water, s);
      system::PortData port;
      port.component = list->type;
      port.body = static_cast<int>(i);
      entry.ports.push_back(port);
    }
    if (!list)
      continue;
    entry.laws = std::move(list);
    s.elements.push_back(std::move(entry));
  }
}

} // namespace hydrodae::build
