/// Added mass and radiation that depend on the poses of bodies.

#include <utility>

#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::build {

namespace {

/// Hydrodynamic data before any database is read.
system::HydroData bare(const system::HydroData& h) {
  system::HydroData out;
  static_cast<water::WetBodies&>(out) = h;
  return out;
}

/// Radiation of `scene`, whose database is that of one pose; checked separately.
system::HydroData radiation_of(const model::Scene& scene, const system::HydroData& none,
                               system::System& s) {
  system::HydroData before = std::exchange(s.hydro, bare(none));
  add_radiation(scene, s);
  return std::exchange(s.hydro, std::move(before));
}

/// Checks the blended added mass at many poses: a cubic between two tables has at most two
/// extremes, which 8 steps find within a few percent.
void check_blends(const model::PoseTable& given, const water::PoseTable& table,
                  const system::HydroData& none, system::System& s) {
  constexpr int between = 8; ///< poses from one table to the next
  const system::HydroBody& hb = none.bodies[static_cast<std::size_t>(table.hydro_body)];
  std::vector<double> w(table.axis.weights.size()), slopes(w.size());
  const std::vector<double>& poses = given.poses();
  system::HydroData before = std::exchange(s.hydro, bare(none));
  s.hydro.added_mass.moving = before.added_mass.moving; // added mass of the other bodies
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
    for (int part = 0; part <= between; ++part) {
      const double pose = poses[k] + (poses[k + 1] - poses[k]) * part / between;
      table.axis.weights.values(pose, w.data(), slopes.data());
      const Matrix6 A = water::blend(table.added_mass, w.data());
      for (std::size_t m = 0; m < 6; ++m)
        for (std::size_t n = 0; n < 6; ++n)
          if (hb.moving[m] >= 0 && hb.moving[n] >= 0)
            s.hydro.added_mass.moving(hb.moving[m], hb.moving[n]) =
                A(static_cast<Index>(m), static_cast<Index>(n));
      try {
        check_mass(s);
      } catch (const ModelError& error) {
        throw ModelError("pose_table." + given.name + ".databases",
                         "at a " + given.coordinate + " of " +
                             number_text(given.turns() ? pose * 180.0 / pi : pose) +
                             (given.turns() ? " deg: " : " m: ") + error.what());
      }
    }
  s.hydro = std::move(before);
}

void add_table(const model::Scene& scene, const model::PoseTable& given,
               const system::HydroData& none, system::System& s) {
  water::PoseTable table;
  for (std::size_t i = 0; i < none.bodies.size(); ++i)
    if (s.bodies[static_cast<std::size_t>(none.bodies[i].body)].name == given.body)
      table.hydro_body = static_cast<int>(i);
  const auto number = static_cast<std::size_t>(table.hydro_body);
  const system::HydroBody& hb = none.bodies[number];
  table.axis.component = given.component();
  if (table.axis.component < 3)
    table.axis.reference =
        s.bodies[static_cast<std::size_t>(hb.body)].reference[table.axis.component];
  table.axis.weights = CardinalSplines(given.poses());
  water::AddedMass& added = s.hydro.added_mass;
  table.first_weight = added.n_weights;
  // Calls `f` with the rung of the whole scene, and that of `one`.
  const auto with_rungs = [&](const system::HydroData& one, const auto& f) {
    std::visit([&]<class Rung>(Rung& rung) { f(rung, std::get<Rung>(one.radiation)); },
               s.hydro.radiation);
  };
  for (std::size_t k = 0; k < given.loaded.size(); ++k) {
    const system::HydroData one = radiation_of(model::scene_at_pose(scene, given, k), none, s);
    table.added_mass.push_back(water::own_block(hb, table.hydro_body, one.added_mass.all));
    with_rungs(one, [&](auto& rung, const auto& there) {
      rung.add_pose(there, none, table.hydro_body, added.n_weights, given.blends_memory());
    });
    ++added.n_weights;
    if (k == 0)
      s.hydro.uncovered.insert(s.hydro.uncovered.end(), one.uncovered.begin(), one.uncovered.end());
  }
  if (!given.blends_memory())
    with_rungs(radiation_of(model::scene_at_rest(scene, given), none, s),
               [](auto& rung, const auto& there) { rung.add_rest(there); });
  check_blends(given, table, none, s);
  s.hydro.bodies[number].table = static_cast<int>(added.tables.size());
  added.tables.push_back(std::move(table));
}

} // namespace

void add_pose_tables(const model::Scene& scene, system::System& s) {
  const system::HydroData none = bare(s.hydro);
  s.hydro = radiation_of(model::scene_without_tables(scene), none, s);
  for (const model::PoseTable& table : scene.pose_tables)
    add_table(scene, table, none, s);
  s.hydro.link();
}

} // namespace hydrodae::build
