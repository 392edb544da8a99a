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
  out.axes = h.axes;
  out.bodies = h.bodies;
  out.coordinates = h.coordinates;
  out.n_moving = h.n_moving;
  return out;
}

/// Radiation of `scene`, whose database is that of one pose; checked separately.
system::HydroData radiation_of(const model::Scene& scene, const system::HydroData& none,
                               system::System& s) {
  system::HydroData before = std::exchange(s.hydro, bare(none));
  add_radiation(scene, s);
  return std::exchange(s.hydro, std::move(before));
}

/// Block of one body: six rows, and the moving columns.
Matrix6 own_block(const system::HydroBody& hb, int number, const MatrixX& all) {
  Matrix6 out = Matrix6::Zero();
  for (int c = 0; c < 6; ++c)
    if (hb.moving[static_cast<std::size_t>(c)] >= 0)
      out.col(c) = all.block<6, 1>(6 * number, hb.moving[static_cast<std::size_t>(c)]);
  return out;
}

/// Appends the memory of one database; `weight` multiplies its loads, -1: none.
void append_memory(const system::HydroData& from, int weight, system::HydroData& h) {
  const int first = h.n_states;
  for (system::HydroData::Block block : from.blocks) {
    block.state += first;
    h.blocks.push_back(block);
  }
  for (system::HydroData::Input input : from.inputs) {
    input.state += first;
    h.inputs.push_back(input);
  }
  const auto join = [](MatrixX& to, const MatrixX& more) {
    const Index columns = to.cols();
    to.conservativeResize(more.rows(), columns + more.cols());
    to.rightCols(more.cols()) = more;
  };
  join(h.output, from.output);
  join(h.output_all, from.output_all);
  h.n_states += from.n_states;
  h.weight_of_state.resize(static_cast<std::size_t>(h.n_states), weight);
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
  s.hydro.added_mass = before.added_mass; // added mass of the other bodies
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
    for (int part = 0; part <= between; ++part) {
      const double pose = poses[k] + (poses[k + 1] - poses[k]) * part / between;
      table.axis.weights.values(pose, w.data(), slopes.data());
      const Matrix6 A = water::blend(table.added_mass, w.data());
      for (std::size_t m = 0; m < 6; ++m)
        for (std::size_t n = 0; n < 6; ++n)
          if (hb.moving[m] >= 0 && hb.moving[n] >= 0)
            s.hydro.added_mass(hb.moving[m], hb.moving[n]) =
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
  table.first_weight = s.hydro.n_weights;
  for (std::size_t k = 0; k < given.loaded.size(); ++k) {
    const model::Scene there = model::scene_at_pose(scene, given, k);
    const system::HydroData one = radiation_of(there, none, s);
    table.added_mass.push_back(own_block(hb, table.hydro_body, one.added_mass_all));
    if (one.damped)
      table.damping.push_back(own_block(hb, table.hydro_body, one.damping_all));
    if (given.blends_memory())
      append_memory(one, s.hydro.n_weights, s.hydro);
    ++s.hydro.n_weights;
    if (k == 0)
      s.hydro.uncovered.insert(s.hydro.uncovered.end(), one.uncovered.begin(), one.uncovered.end());
  }
  if (!given.blends_memory())
    append_memory(radiation_of(model::scene_at_rest(scene, given), none, s), -1, s.hydro);
  check_blends(given, table, none, s);
  s.hydro.bodies[number].table = static_cast<int>(s.hydro.tables.size());
  s.hydro.tables.push_back(std::move(table));
}

} // namespace

void add_pose_tables(const model::Scene& scene, system::System& s) {
  const system::HydroData none = bare(s.hydro);
  s.hydro = radiation_of(model::scene_without_tables(scene), none, s);
  s.hydro.weight_of_state.assign(static_cast<std::size_t>(s.hydro.n_states), -1);
  for (const model::PoseTable& table : scene.pose_tables)
    add_table(scene, table, none, s);
  s.hydro.link();
}

} // namespace hydrodae::build
