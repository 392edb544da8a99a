#pragma once
/// Of the assembly (assembly.h): added mass and radiation.

#include "hydrodae/system/assembly.h"
#include "hydrodae/system/hydrodynamics.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::system {

using water::HydroLoadGradient;
using water::HydroMotionGradient;
using water::Matrix63;

/// The block of a matrix (n_moving, n_moving) between two hydrodynamic bodies, zero where a
/// coordinate does not move.
inline Matrix6 hydro_block(const MatrixX& matrix, const HydroBody& i, const HydroBody& j) {
  Matrix6 block = Matrix6::Zero();
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n)
      if (i.moving[m] >= 0 && j.moving[n] >= 0)
        block(m, n) = matrix(i.moving[m], j.moving[n]);
  return block;
}

template <class Sink>
void Assembly<Sink>::hydro_pair(const HydroBody& i, const HydroBody& j, const Matrix6& L,
                                const Matrix6& Q) {
  const Matrix6 A = hydro_block(s.hydro.added_mass, i, j);
  Matrix6 LA = L * A, QA = Q * A; // what multiplies dU' and dU
  if (s.hydro.damped)
    QA += L * hydro_block(s.hydro.damping, i, j);
  if (!s.hydro.convolution.empty() && ws.state.past) {
    LA += L * hydro_block(ws.state.past->by_U_dot, i, j);
    QA += L * hydro_block(ws.state.past->by_U, i, j);
  }
  const HydroMotionGradient d = hydro_motion_gradient(s.hydro.axes, j, state(j.body));
  Matrix6 by_velocity;
  by_velocity << LA * d.a_v + QA * d.U_v, LA * d.a_w + QA * d.U_w;
  const Matrix6 by_acceleration = LA * d.a_acc;
  const Matrix63 by_rotation = LA * d.a_phi + QA * d.U_phi;
  const BodyData& b = s.bodies[i.body];
  for (int k = 0; k < b.n_active; ++k) {
    const Index row = b.u0 + k;
    const int c = b.active[k];
    rotation_columns(row, j.body, by_rotation.row(c));
    velocity_columns(row, j.body, by_velocity.row(c));
    acceleration_columns(row, j.body, by_acceleration.row(c));
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
    const Vector6 load = L * column;
    for (int k = 0; k < b.n_active; ++k)
      sink.by_y(b.u0 + k, s.hydro.z0 + z, load[b.active[k]]);
  }
}

// load_i = L (A U' + C z) + Q A U with the poses inside L and Q differentiated as well.
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

/// L A L^T of each pair, all that the accelerations feel of the water at once. L turns forces and
/// moments, each by a matrix of its own; that of forces is the identity in mean axes.
template <class Sink> void Assembly<Sink>::hydro_masses() {
  const std::vector<HydroBody>& bodies = s.hydro.bodies;
  const auto turns_forces = [this](const HydroBody& hb) {
    return s.hydro.axes != HydroAxes::mean || hb.turned;
  };
  for (std::size_t number = 0; number < bodies.size(); ++number)
    if (const HydroBody& hb = bodies[number]; hb.moves)
      ws.hydro_axes[number] = hydro_axes(s.hydro.axes, hb, state(hb.body));
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const HydroBody& i = bodies[number];
    if (!i.moves)
      continue;
    const Matrix6& L_i = ws.hydro_axes[number];
    for (const int partner : s.hydro.links[number].partners) {
      const auto other = static_cast<std::size_t>(partner);
      const HydroBody& j = bodies[other];
      const Matrix6& L_j = ws.hydro_axes[other];
      Matrix6 mass = hydro_block(s.hydro.added_mass, i, j);
      if (!s.hydro.convolution.empty() && ws.state.past)
        mass += hydro_block(ws.state.past->by_U_dot, i, j);
      mass.rightCols<3>() *= L_j.bottomRightCorner<3, 3>().transpose();
      if (turns_forces(j))
        mass.leftCols<3>() *= L_j.topLeftCorner<3, 3>().transpose();
      mass.bottomRows<3>().applyOnTheLeft(L_i.bottomRightCorner<3, 3>());
      if (turns_forces(i))
        mass.topRows<3>().applyOnTheLeft(L_i.topLeftCorner<3, 3>());
      const BodyData& b = s.bodies[i.body];
      for (int k = 0; k < b.n_active; ++k)
        acceleration_columns(b.u0 + k, j.body, mass.row(b.active[k]));
    }
  }
}

template <class Sink> void Assembly<Sink>::add(const HydroData& h) {
  if (!whole)
    return hydro_masses();
  Workspace<double>& w = ws.state;
  hydro_loads<double>(s, w, y + h.z0);
  for (std::size_t number = 0; number < h.bodies.size(); ++number) {
    const HydroBody& i = h.bodies[number];
    if (!i.moves)
      continue;
    Vector6 rate = Vector6::Zero(), momentum = Vector6::Zero();
    for (int c = 0; c < 6; ++c) {
      if (i.moving[c] < 0)
        continue;
      rate[c] = w.inertia_force[i.moving[c]];
      momentum[c] = w.momentum[i.moving[c]];
    }
    hydro_body(number, rate, momentum);
  }
  memory_rows();
}

} // namespace hydrodae::system
