#pragma once
/// Part of the assembly (assembly.h) for added mass and radiation.

#include "hydrodae/system/assembly.h"
#include "hydrodae/system/mass.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::system {

using water::HydroLoadGradient;
using water::HydroMotionGradient;
using water::Matrix63;

/// Derivatives of the water load on body i by the motion of body j; `mass` adds the inertia.
template <class Sink>
void Assembly<Sink>::partner_columns(std::size_t i, std::size_t j, const Matrix6& L,
                                     const Matrix6& Q) {
  // mean axes: U' is linear in the accelerations
  const bool follow = s.hydro.axes != HydroAxes::mean;
  const HydroBody& moved = s.hydro.bodies[j];
  const HydroMotionGradient d = hydro_motion_gradient(s.hydro.axes, moved, state(moved.body));
  const HydroPair pair = hydro_pair(s, ws.state, i, j);
  const Matrix6 LA = L * pair.inertia;
  Matrix6 by_velocity = Matrix6::Zero();
  Matrix63 by_rotation = LA * d.a_phi;
  if (follow)
    by_velocity << LA * d.a_v, LA * d.a_w;
  if (follow || pair.damps) {
    Matrix6 by_U = Q * pair.momentum;
    if (pair.damps)
      by_U += L * pair.damping;
    by_velocity.leftCols<3>() += by_U * d.U_v;
    by_velocity.rightCols<3>() += by_U * d.U_w;
    by_rotation += by_U * d.U_phi;
  }
  const BodyData& b = s.bodies[s.hydro.bodies[i].body];
  for (int k = 0; k < b.n_active; ++k) {
    const int c = b.active[k];
    rotation_columns(b.u0 + k, moved.body, by_rotation.row(c));
    velocity_columns(b.u0 + k, moved.body, by_velocity.row(c));
  }
}

/// Derivatives of the water load on a body by the states of the radiation.
template <class Sink> void Assembly<Sink>::radiation_columns(std::size_t number, const Matrix6& L) {
  const BodyData& b = s.bodies[s.hydro.bodies[number].body];
  const water::WaterMotion<double> motion = water_motion<double>(s, ws.state, y + s.hydro.z0);
  s.hydro.visit([&](const auto& rung) {
    rung.for_each_state_load(motion, number, [&](Index z, const Vector6& column) {
      const Vector6 load = L * column;
      for (int k = 0; k < b.n_active; ++k)
        sink.by_y(b.u0 + k, s.hydro.z0 + z, load[b.active[k]]);
    });
  });
}

/// Derivatives of the load on a body with a pose table by its pose s:
///   d load = (L (A' U' + s' A'' U + dF/ds) + Q A' U - 1/2 (U.A'' U) g) ds + L A' U ds'
///            - g U.A' dU - 1/2 (U.A' U) dg,     ds = g.dx, ds' = g.d(v, w) + w.dg
template <class Sink>
void Assembly<Sink>::table_columns(std::size_t number, const HydroLoadGradient& load) {
  const HydroBody& hb = s.hydro.bodies[number];
  const water::PoseTable& table = s.hydro.added_mass.tables[static_cast<std::size_t>(hb.table)];
  const BodyState<double>& body = state(hb.body);
  const TableHere here = table_here(s, ws.state, hb);
  std::vector<double>& curvatures = ws.table_curvatures;
  table.axis.weights.curvatures(here.pose.value, curvatures.data());
  const Vector6 U = hydro_velocity<double>(s.hydro.axes, hb, body),
                U_dot = hydro_acceleration<double>(s.hydro.axes, hb, body), &g = here.pose.gradient;
  const Vector6 momentum = here.A_slope * U,
                bend =
                    water::moving_rows(hb, water::blend(table.added_mass, curvatures.data())) * U;
  Vector6 force = here.A_slope * U_dot + here.rate * bend;
  const water::WaterMotion<double> motion = water_motion<double>(s, ws.state, y + s.hydro.z0);
  s.hydro.visit([&](const auto& rung) { rung.add_by_pose(motion, number, force); });
  const Vector6 by_pose = load.L * force + load.Q * momentum - 0.5 * U.dot(bend) * g,
                by_rate = load.L * momentum;
  const Vector6 along = 0.5 * (here.A_slope + here.A_slope.transpose()) * U;
  const HydroMotionGradient d = hydro_motion_gradient(s.hydro.axes, hb, body);
  Matrix6 dg = Matrix6::Zero();
  dg.bottomRightCorner<3, 3>() = water::pose_gradient_by_rotation(table.axis.component, body.R);
  Vector6 U_by_phi = Vector6::Zero(), U_by_velocity;
  U_by_phi.tail<3>() = d.U_phi.transpose() * along;
  U_by_velocity << d.U_v.transpose() * along, d.U_w.transpose() * along;
  Vector6 rate_by_phi = Vector6::Zero();
  rate_by_phi.tail<3>() = dg.bottomRightCorner<3, 3>().transpose() * body.w;
  const Matrix6 by_displacement = by_pose * g.transpose() + by_rate * rate_by_phi.transpose() -
                                  g * U_by_phi.transpose() - 0.5 * U.dot(momentum) * dg,
                by_velocity = by_rate * g.transpose() - g * U_by_velocity.transpose();
  load_by_displacement(hb.body, hb.body, -by_displacement);
  load_by_velocity(hb.body, hb.body, -by_velocity);
}

// Derivatives of load_i = L (A U' + F) + Q A U by the poses in L and Q.
template <class Sink>
void Assembly<Sink>::hydro_body(std::size_t number, const Vector6& rate, const Vector6& momentum) {
  const HydroBody& i = s.hydro.bodies[number];
  const HydroLoadGradient d = hydro_load_gradient(s.hydro.axes, i, state(i.body), rate, momentum);
  const BodyData& data = s.bodies[i.body];
  for (int k = 0; k < data.n_active; ++k) {
    rotation_columns(data.u0 + k, i.body, d.by_rotation.row(data.active[k]));
    velocity_columns(data.u0 + k, i.body, d.by_velocity.row(data.active[k]));
  }
  if (i.table >= 0)
    table_columns(number, d);
  for (const int j : s.hydro.partners[number])
    partner_columns(number, static_cast<std::size_t>(j), d.L, d.Q);
  if constexpr (memory)
    radiation_columns(number, d.L);
}

template <class Sink> void Assembly<Sink>::radiation_rows() {
  const HydroData& h = s.hydro;
  const Index n = h.n_states();
  if (!memory) {
    for (Index k = h.z0; k < h.z0 + n; ++k)
      sink.by_y(k, k, 1.0);
    return;
  }
  for (Index k = h.z0; k < h.z0 + n; ++k)
    sink.by_yp(k, k, 1.0);
  h.visit([&](const auto& rung) {
    rung.for_each_rate_by_state([&](Index row, Index column, double value) {
      sink.by_y(h.z0 + row, h.z0 + column, -value);
    });
    for (std::size_t i = 0; n > 0 && i < h.bodies.size(); ++i) {
      const HydroBody& hb = h.bodies[i];
      const BodyData& b = s.bodies[hb.body];
      const HydroMotionGradient d = hydro_motion_gradient(h.axes, hb, state(hb.body));
      rung.for_each_drive(i, [&](Index state, int c, double value) {
        const Index row = h.z0 + state;
        if (h.axes == HydroAxes::yaw || (c < 3) == (h.axes == HydroAxes::body))
          rotation_columns(row, hb.body, -value * d.U_phi.row(c));
        for (int k = 0; k < b.n_active; ++k)
          if (const int a = b.active[k]; (a < 3) == (c < 3))
            sink.by_y(row, b.u0 + k, -value * (a < 3 ? d.U_v(c, a) : d.U_w(c, a - 3)));
      });
    }
  });
}

template <class Sink> void Assembly<Sink>::add(const HydroData& h) {
  if (!whole) // `mass` adds the water's part of accelerations
    return;
  Workspace<double>& w = ws.state;
  hydro_loads<double>(s, w, y + h.z0);
  for (std::size_t number = 0; number < h.bodies.size(); ++number) {
    const HydroBody& i = h.bodies[number];
    if (!i.moves)
      continue;
    hydro_body(number, i.gather<double>(w.inertia_force), i.gather<double>(w.momentum));
  }
  radiation_rows();
}

} // namespace hydrodae::system
