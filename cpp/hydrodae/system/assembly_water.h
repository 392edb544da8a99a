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
void Assembly<Sink>::hydro_pair(const HydroBody& i, const HydroBody& j, const Matrix6& L,
                                const Matrix6& Q) {
  // mean axes: U' is linear in the accelerations
  const bool follow = s.hydro.axes != HydroAxes::mean;
  const bool blends = &i == &j && i.table >= 0;
  const bool convolved = !s.hydro.convolution.empty() && ws.state.past;
  const HydroMotionGradient d = hydro_motion_gradient(s.hydro.axes, j, state(j.body));
  const Matrix6 LA = L * added_mass(s, ws.state, i, j);
  Matrix6 by_velocity = Matrix6::Zero();
  Matrix63 by_rotation = LA * d.a_phi;
  if (follow)
    by_velocity << LA * d.a_v, LA * d.a_w;
  if (follow || blends || convolved || s.hydro.damped) {
    Matrix6 by_U = Q * hydro_block(s.hydro.added_mass, i, j);
    if (blends) {
      const TableHere table = table_here(s, ws.state, i);
      by_U += Q * table.A + L * (table.rate * table.A_slope + table.damping);
    }
    if (s.hydro.damped)
      by_U += L * hydro_block(s.hydro.damping, i, j);
    if (convolved)
      by_U += L * hydro_block(ws.state.past->by_U, i, j);
    by_velocity.leftCols<3>() += by_U * d.U_v;
    by_velocity.rightCols<3>() += by_U * d.U_w;
    by_rotation += by_U * d.U_phi;
  }
  const BodyData& b = s.bodies[i.body];
  for (int k = 0; k < b.n_active; ++k) {
    const int c = b.active[k];
    rotation_columns(b.u0 + k, j.body, by_rotation.row(c));
    velocity_columns(b.u0 + k, j.body, by_velocity.row(c));
  }
}

template <class Sink>
void Assembly<Sink>::memory_columns(const HydroBody& i, const std::vector<int>& states,
                                    const Matrix6& L) {
  const BodyData& b = s.bodies[i.body];
  for (const int z : states) {
    Vector6 column = Vector6::Zero();
    for (int c = 0; c < 6; ++c)
      if (i.moving[c] >= 0)
        column[c] = s.hydro.output(i.moving[c], z);
    if (i.table >= 0)
      if (const int weight = s.hydro.weight_of_state[static_cast<std::size_t>(z)]; weight >= 0)
        column *= ws.state.weights[weight];
    const Vector6 load = L * column;
    for (int k = 0; k < b.n_active; ++k)
      sink.by_y(b.u0 + k, s.hydro.z0 + z, load[b.active[k]]);
  }
}

/// Derivatives of the load on a body with a pose table by its pose s:
///   d load = (L (A' U' + s' A'' U + B' U + C W' z) + Q A' U - 1/2 (U.A'' U) g) ds + L A' U ds'
///            - g U.A' dU - 1/2 (U.A' U) dg,     ds = g.dx, ds' = g.d(v, w) + w.dg
template <class Sink>
void Assembly<Sink>::table_columns(std::size_t number, const HydroLoadGradient& load) {
  const HydroBody& hb = s.hydro.bodies[number];
  const water::PoseTable& table = s.hydro.tables[static_cast<std::size_t>(hb.table)];
  const BodyState<double>& body = state(hb.body);
  const TableHere here = table_here(s, ws.state, hb);
  std::vector<double>& curvatures = ws.table_curvatures;
  table.axis.weights.curvatures(here.pose.value, curvatures.data());
  const double* slopes = ws.state.weight_slopes.data() + table.first_weight;
  const Vector6 U = hydro_velocity<double>(s.hydro.axes, hb, body),
                U_dot = hydro_acceleration<double>(s.hydro.axes, hb, body), &g = here.pose.gradient;
  const Vector6 momentum = here.A_slope * U,
                bend = moving_rows(hb, water::blend(table.added_mass, curvatures.data())) * U;
  Vector6 force = here.A_slope * U_dot + here.rate * bend +
                  moving_rows(hb, water::blend(table.damping, slopes)) * U;
  for (const int z : s.hydro.links[number].states) {
    const int weight = s.hydro.weight_of_state[static_cast<std::size_t>(z)];
    if (weight < 0)
      continue;
    for (int c = 0; c < 6; ++c)
      if (hb.moving[c] >= 0)
        force[c] +=
            s.hydro.output(hb.moving[c], z) * ws.state.weight_slopes[weight] * y[s.hydro.z0 + z];
  }
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

// Derivatives of load_i = L (A U' + C z) + Q A U by the poses in L and Q.
template <class Sink>
void Assembly<Sink>::hydro_body(std::size_t number, const Vector6& rate, const Vector6& momentum) {
  const HydroBody& i = s.hydro.bodies[number];
  const HydroData::Links& links = s.hydro.links[number];
  const HydroLoadGradient d = hydro_load_gradient(s.hydro.axes, i, state(i.body), rate, momentum);
  const BodyData& data = s.bodies[i.body];
  for (int k = 0; k < data.n_active; ++k) {
    rotation_columns(data.u0 + k, i.body, d.by_rotation.row(data.active[k]));
    velocity_columns(data.u0 + k, i.body, d.by_velocity.row(data.active[k]));
  }
  if (i.table >= 0)
    table_columns(number, d);
  for (const int j : links.partners)
    hydro_pair(i, s.hydro.bodies[static_cast<std::size_t>(j)], d.L, d.Q);
  if constexpr (memory)
    memory_columns(i, links.states, d.L);
}

template <class Sink> void Assembly<Sink>::memory_rows() {
  const HydroData& h = s.hydro;
  if (!memory) {
    for (int k = 0; k < h.n_states; ++k)
      sink.by_y(h.z0 + k, h.z0 + k, 1.0);
    return;
  }
  for (const HydroData::Block& b : h.blocks) {
    const Index k = h.z0 + b.state;
    sink.by_yp(k, k, 1.0);
    sink.by_y(k, k, -b.a);
    if (!b.pair)
      continue;
    sink.by_yp(k + 1, k + 1, 1.0);
    sink.by_y(k + 1, k + 1, -b.a);
    sink.by_y(k, k + 1, b.b);
    sink.by_y(k + 1, k, -b.b);
  }
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const int body = hb.body;
    const BodyData& b = s.bodies[body];
    const HydroMotionGradient d = hydro_motion_gradient(h.axes, hb, state(body));
    for (const int number : h.links[i].inputs) {
      const HydroData::Input& in = h.inputs[static_cast<std::size_t>(number)];
      const int c = h.coordinates[in.coordinate].component;
      const Index row = h.z0 + in.state;
      if (h.axes == HydroAxes::yaw || (c < 3) == (h.axes == HydroAxes::body))
        rotation_columns(row, body, -in.value * d.U_phi.row(c));
      for (int k = 0; k < b.n_active; ++k)
        if (const int a = b.active[k]; (a < 3) == (c < 3))
          sink.by_y(row, b.u0 + k, -in.value * (a < 3 ? d.U_v(c, a) : d.U_w(c, a - 3)));
    }
  }
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
  memory_rows();
}

} // namespace hydrodae::system
