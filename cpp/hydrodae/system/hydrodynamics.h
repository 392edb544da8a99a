#pragma once
/// Added mass and radiation as loads on the bodies: the force A U' + F along the axes of
/// water/hydro_axes.h, and the momentum A U. F is that of the rung of radiation.

#include "hydrodae/system/history.h"
#include "hydrodae/water/hydro_axes.h"

namespace hydrodae::system {

/// Velocities U and accelerations U' of all coordinates that move.
template <class S> void hydro_motion(const Regime& s, Workspace<S>& ws) {
  for (const HydroBody& hb : s.hydro.bodies) {
    if (!hb.moves)
      continue;
    const BodyState<S>& state = ws.bodies[hb.body];
    const Vec6<S> U = hydro_velocity<S>(s.hydro.axes, hb, state);
    const Vec6<S> U_dot = hydro_acceleration<S>(s.hydro.axes, hb, state);
    for (int c = 0; c < 6; ++c) {
      if (hb.moving[c] < 0)
        continue;
      ws.U[hb.moving[c]] = U[c];
      ws.U_dot[hb.moving[c]] = U_dot[c];
    }
  }
}

/// Motion that the rung of radiation reads; `z`: its states.
template <class S>
water::WaterMotion<S> water_motion(const Regime& s, Workspace<S>& ws, const S* z) {
  return {s.hydro, ws.U.data(),      ws.U_dot.data(), z, ws.weights.data(), ws.weight_slopes.data(),
          ws.past, ws.scratch.data()};
}

/// Weights of a table at the pose of its body; returns the pose.
template <class S>
water::PoseCoordinate<S> read_pose(const Regime& s, Workspace<S>& ws,
                                   const water::PoseTable& table) {
  const water::PoseCoordinate<S> pose = table.axis.at(ws.bodies[s.hydro.of(table).body]);
  table.axis.weights.values(pose.value, ws.weights.data() + table.first_weight,
                            ws.weight_slopes.data() + table.first_weight);
  return pose;
}

/// Added mass of pose tables: A(s) U into `ws.momentum`, A(s) U' + s' A'(s) U into
/// `ws.inertia_force`.
template <class S> void add_tables(const Regime& s, Workspace<S>& ws) {
  const std::vector<water::PoseTable>& tables = s.hydro.added_mass.tables;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const water::PoseTable& table = tables[k];
    const HydroBody& hb = s.hydro.of(table);
    const water::PoseCoordinate<S> pose = read_pose(s, ws, table);
    const S* w = ws.weights.data() + table.first_weight;
    const Vec6<S> U = hb.gather<S>(ws.U);
    const Vec6<S> slope =
        water::blend<S>(table.added_mass, ws.weight_slopes.data() + table.first_weight, U);
    const S rate = pose.rate(ws.bodies[hb.body]);
    const Vec6<S> force =
        water::blend<S>(table.added_mass, w, hb.gather<S>(ws.U_dot)) + rate * slope;
    water::scatter<S>(hb, water::blend<S>(table.added_mass, w, U), ws.momentum.data());
    water::scatter<S>(hb, force, ws.inertia_force.data());
    ws.table_loads[k] = S(0.5) * U.cwiseProduct(slope).sum() * pose.gradient;
  }
}

/// Force A U' + F into `ws.inertia_force`, momentum A U into `ws.momentum`. Mean axes do not need
/// the momentum: it is zero. Returns the motion that F depends on.
template <class S>
water::WaterMotion<S> hydro_loads(const Regime& s, Workspace<S>& ws, const S* z) {
  const HydroData& h = s.hydro;
  hydro_motion(s, ws);
  ws.momentum.setZero();
  ws.inertia_force.setZero();
  if (h.axes != HydroAxes::mean)
    h.added_mass.product.add_product(ws.U.data(), ws.momentum.data());
  h.added_mass.product.add_product(ws.U_dot.data(), ws.inertia_force.data());
  add_tables<S>(s, ws);
  const water::WaterMotion<S> motion = water_motion<S>(s, ws, z);
  h.visit([&](const auto& rung) { rung.add_loads(motion, ws.inertia_force.data()); });
  return motion;
}

/// Subtracts the fluid's loads from `ws.loads` and writes the rows z' - h = 0 of the radiation.
/// Only coordinates that move are visited.
template <class S>
void add_loads(const Regime& s, const HydroData& h, Workspace<S>& ws, const S* y, const S* yp,
               S* residual) {
  const water::WaterMotion<S> motion = hydro_loads<S>(s, ws, y + h.z0);
  Vec6<S> momentum = Vec6<S>::Zero();
  for (const HydroBody& hb : h.bodies) {
    if (!hb.moves)
      continue;
    if (h.axes != HydroAxes::mean)
      momentum = hb.gather<S>(ws.momentum);
    ws.loads[hb.body] -=
        hydro_load<S>(h.axes, hb, ws.bodies[hb.body], hb.gather<S>(ws.inertia_force), momentum);
    if (hb.table >= 0)
      ws.loads[hb.body] += ws.table_loads[static_cast<std::size_t>(hb.table)];
  }
  h.visit([&](const auto& rung) {
    std::copy_n(yp + h.z0, rung.n_states(), residual + h.z0);
    rung.add_rates(motion, -1.0, residual + h.z0);
  });
}

} // namespace hydrodae::system
