/// Part of the observer: added mass and radiation.

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/measure/observer.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/hydrodynamics.h"

namespace hydrodae::measure {

using namespace system;

/// Throws for a body that has left the poses of its table.
[[noreturn]] void refuse_pose(double t, const System& s, const water::PoseTable& table,
                              double pose) {
  const std::string& body = s.bodies[static_cast<std::size_t>(s.hydro.of(table).body)].name;
  const bool turns = table.axis.component >= 3;
  const auto text = [&](double x) { return rounded_text(turns ? x * 180.0 / pi : x, 4); };
  throw SolverError(
      t,
      {Reason::range,
       "body " + in_quotes(body) + " is at a " +
           std::string(model::coordinate_names[static_cast<std::size_t>(table.axis.component)]) +
           " of " + text(pose) + (turns ? " deg" : " m") + "; its [[pose_table]] covers " +
           text(table.axis.weights.front()) + " to " + text(table.axis.weights.back()) + " alone",
       "bodies/" + body,
       {{turns ? "pose_deg" : "pose_m", turns ? pose * 180.0 / pi : pose}},
       "add databases for poses beyond its ends",
       ""});
}

/// Momentum A(s) U and d/dt (A(s) U) of bodies with tables, for all six coordinates of each.
void Observer::observe_tables(const HydroData& h) {
  constexpr double slack = 1e-9; ///< tolerance, as part of the table's range
  for (std::size_t k = 0; k < h.added_mass.tables.size(); ++k) {
    const water::PoseTable& table = h.added_mass.tables[k];
    const HydroBody& hb = h.of(table);
    const water::PoseCoordinate<double> pose = read_pose(s_, ws_, table);
    const double first = table.axis.weights.front(), last = table.axis.weights.back();
    if (std::max(first - pose.value, pose.value - last) > slack * (last - first))
      refuse_pose(ws_.time, s_, table, pose.value);
    const double* w = ws_.weights.data() + table.first_weight;
    const Vector6 U = hb.gather<double>(ws_.U);
    const Vector6 slope =
        water::blend<double>(table.added_mass, ws_.weight_slopes.data() + table.first_weight, U);
    const Index row = 6 * table.hydro_body;
    momentum_.segment<6>(row) += water::blend<double>(table.added_mass, w, U);
    rate_.segment<6>(row) +=
        water::blend<double>(table.added_mass, w, hb.gather<double>(ws_.U_dot)) +
        pose.rate(ws_.bodies[hb.body]) * slope;
    ws_.table_loads[k] = 0.5 * U.dot(slope) * pose.gradient;
  }
}

/// Loads of the coordinates that move alone: the others do no work.
void Observer::observe_loads(const HydroData& h, const double* y) {
  hydro_motion(s_, ws_);
  const water::WaterMotion<double> motion = water_motion<double>(s_, ws_, y + h.z0);
  const auto fill = [&](VectorX& rows, const auto& add) {
    moving_.setZero();
    add(moving_.data());
    rows.setZero();
    for (int u = 0; u < h.n_moving; ++u)
      rows[h.coordinates[u].row()] = moving_[u];
  };
  const water::AddedMass& mass = h.added_mass;
  fill(momentum_, [&](double* out) { mass.product.add_product(ws_.U.data(), out); });
  fill(rate_, [&](double* out) { mass.product.add_product(ws_.U_dot.data(), out); });
  fill(radiation_,
       [&](double* out) { h.visit([&](const auto& rung) { rung.add_loads(motion, out); }); });
  add_loads(h);
}

void Observer::observe(const HydroData& h, const double* y) {
  hydro_motion(s_, ws_);
  momentum_.setZero();
  rate_.setZero();
  h.added_mass.product_all.add_product(ws_.U.data(), momentum_.data());
  h.added_mass.product_all.add_product(ws_.U_dot.data(), rate_.data());
  radiation_.setZero();
  const water::WaterMotion<double> motion = water_motion<double>(s_, ws_, y + h.z0);
  h.visit([&](const auto& rung) { rung.add_all_loads(motion, radiation_.data()); });
  add_loads(h);
}

/// Loads on the bodies by momentum, its rate, and radiation, (6 n,) in hydrodynamic axes.
void Observer::add_loads(const HydroData& h) {
  observe_tables(h);
  for (int u = 0; u < h.n_moving; ++u) {
    const HydroData::Coordinate& k = h.coordinates[u];
    out_.kinetic_added_mass += 0.5 * ws_.U[u] * momentum_[k.row()];
  }
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const BodyState<double>& state = ws_.bodies[hb.body];
    const auto row = 6 * static_cast<Eigen::Index>(i);
    Vector6 added =
        hydro_load<double>(h.axes, hb, state, rate_.segment<6>(row), momentum_.segment<6>(row));
    if (hb.table >= 0)
      added -= ws_.table_loads[static_cast<std::size_t>(hb.table)];
    add_load(-to_world(state, added));
    if (!h.radiates())
      continue;
    const Vector6 radiation =
        hydro_load<double>(h.axes, hb, state, radiation_.segment<6>(row), Vector6::Zero());
    add_load(-to_world(state, radiation));
  }
}

} // namespace hydrodae::measure
