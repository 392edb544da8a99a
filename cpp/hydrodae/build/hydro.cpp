/// Which coordinates of the bodies move in the water; hydrostatics, radiation, and mass of the two.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/check_radiation.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/definite.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/mass.h"

namespace hydrodae::build {

namespace {

/// Numbers the entries of U by coordinates of bodies.
void number_coordinates(const model::Scene& scene, system::System& s) {
  system::HydroData& h = s.hydro;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!scene.bodies[i].hydro)
      continue;
    system::HydroBody hb;
    hb.body = static_cast<int>(i);
    hb.carrier = static_cast<int>(h.bodies.size());
    if (const auto& part = scene.bodies[i].part)
      for (std::size_t k = 0; k < h.bodies.size(); ++k)
        if (s.bodies[static_cast<std::size_t>(h.bodies[k].body)].name == part->body)
          hb.carrier = static_cast<int>(k);
    hb.moving.fill(-1);
    const std::array<bool, 6> moving = model::moving_axes(scene.bodies[i]);
    for (int c = 0; c < 6; ++c) {
      if (!moving[c])
        continue;
      hb.moving[c] = h.n_moving++;
      hb.moves = true;
      h.coordinates.push_back({static_cast<int>(h.bodies.size()), c});
    }
    h.bodies.push_back(hb);
  }
}

} // namespace

/// Places of the lower triangle, by columns: of the same body, or coupled by added mass.
static std::vector<Definite::Place> coupled_places(const system::HydroData& h) {
  std::vector<Definite::Place> out;
  for (Index v = 0; v < h.n_moving; ++v)
    for (Index u = v; u < h.n_moving; ++u)
      if (h.added_mass.moving(u, v) != 0.0 || h.added_mass.moving(v, u) != 0.0 ||
          h.coordinates[static_cast<std::size_t>(u)].hydro_body ==
              h.coordinates[static_cast<std::size_t>(v)].hydro_body)
        out.push_back({u, v});
  return out;
}

// Refuses a mass matrix that is not positive definite. Units differ, so it is scaled to a unit
// diagonal.
void check_mass(const system::System& s) {
  const system::HydroData& h = s.hydro;
  const auto own = [&](Index u, Index v) { // mass of the bodies without the water
    const system::HydroData::Coordinate &a = h.coordinates[static_cast<std::size_t>(u)],
                                        &b = h.coordinates[static_cast<std::size_t>(v)];
    if (a.hydro_body != b.hydro_body)
      return 0.0;
    return system::rigid_mass(s.bodies[h.bodies[a.hydro_body].body])(a.component, b.component);
  };
  const auto mass = [&](Index u, Index v) {
    return own(u, v) + 0.5 * (h.added_mass.moving(u, v) + h.added_mass.moving(v, u));
  };
  VectorX size(h.n_moving); // mass^-1/2
  for (Index u = 0; u < h.n_moving; ++u) {
    const system::HydroData::Coordinate& c = h.coordinates[static_cast<std::size_t>(u)];
    const double both = mass(u, u);
    if (!(both > 0.0))
      throw ModelError(
          "hydro.database",
          "mass and added mass of body '" + s.bodies[h.bodies[c.hydro_body].body].name + "' in " +
              std::string(model::coordinate_names[static_cast<std::size_t>(c.component)]) +
              " are " + number_text(both) + " together, and must be positive");
    size[u] = 1.0 / std::sqrt(both);
  }
  const std::vector<Definite::Place> places = coupled_places(h);
  std::vector<double> scaled;
  for (const Definite::Place& at : places)
    scaled.push_back(size[at.row] * mass(at.row, at.column) * size[at.column]);
  if (!Definite(h.n_moving, places).test(scaled.data(), nullptr))
    throw ModelError("hydro.database", "mass and added mass of the moving coordinates are not "
                                       "positive definite together: a push somewhere moves the "
                                       "bodies towards the hand");
}

void add_hydro(const model::Scene& scene, system::System& s) {
  if (!scene.hydro || !scene.database)
    return;
  system::HydroData& h = s.hydro;
  h.axes = scene.hydro->axes_kind();
  number_coordinates(scene, s);
  set_hydrostatics(scene, s);
  if (h.n_moving == 0) {
    h.link();
    return;
  }
  if (!scene.pose_tables.empty())
    return add_pose_tables(scene, s);
  add_radiation(scene, s);
  check_mass(s);
}

} // namespace hydrodae::build
