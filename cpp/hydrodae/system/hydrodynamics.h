#pragma once
/// Added mass at infinite frequency and radiation memory as loads on the bodies, along the axes of
/// water/hydro_axes.h: A_inf U' + C z, with the momentum A_inf U.

#include "hydrodae/system/history.h"
#include "hydrodae/water/hydro_axes.h"

namespace hydrodae::system {

/// Product out = m x without temporaries; a plain loop for scalars that Eigen does not vectorise.
template <class S> void multiply(const MatrixX& m, const S* x, VecX<S>& out) {
  if constexpr (std::is_same_v<S, double>) {
    out.noalias() = m * Eigen::Map<const VectorX>(x, m.cols());
  } else {
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      S sum(0);
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        sum += S(m(i, j)) * x[j];
      out[i] = sum;
    }
  }
}

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

/// Memory integral int K U over completed steps, plus the parts of U(t), U'(t) in the piece up to
/// t.
template <class S> void add_convolution(const HydroData& h, Workspace<S>& ws) {
  if (h.convolution.empty() || !ws.past)
    return;
  multiply<S>(ws.past->by_U_dot, ws.U_dot.data(), ws.memory);
  ws.inertia_force += ws.memory;
  multiply<S>(ws.past->by_U, ws.U.data(), ws.memory);
  ws.inertia_force += ws.memory;
  for (int u = 0; u < h.n_moving; ++u)
    ws.inertia_force[u] += S(ws.past->memory[u]);
}

/// Weights of a table at the pose of its body; returns the pose.
template <class S>
water::PoseCoordinate<S> read_pose(const Regime& s, Workspace<S>& ws,
                                   const water::PoseTable& table) {
  const HydroBody& hb = s.hydro.bodies[static_cast<std::size_t>(table.hydro_body)];
  const water::PoseCoordinate<S> pose = table.axis.at(ws.bodies[hb.body]);
  table.axis.weights.values(pose.value, ws.weights.data() + table.first_weight,
                            ws.weight_slopes.data() + table.first_weight);
  return pose;
}

/// Loads of pose tables: A(s) U into `ws.momentum`, A(s) U' + s' A'(s) U + B(s) U into
/// `ws.inertia_force`.
template <class S> void add_tables(const Regime& s, Workspace<S>& ws) {
  for (std::size_t k = 0; k < s.hydro.tables.size(); ++k) {
    const water::PoseTable& table = s.hydro.tables[k];
    const HydroBody& hb = s.hydro.bodies[static_cast<std::size_t>(table.hydro_body)];
    const water::PoseCoordinate<S> pose = read_pose(s, ws, table);
    const S* w = ws.weights.data() + table.first_weight;
    const Vec6<S> U = hb.gather<S>(ws.U);
    const Vec6<S> momentum = water::blend<S>(table.added_mass, w, U);
    const Vec6<S> slope =
        water::blend<S>(table.added_mass, ws.weight_slopes.data() + table.first_weight, U);
    const S rate = pose.rate(ws.bodies[hb.body]);
    const Vec6<S> force = water::blend<S>(table.added_mass, w, hb.gather<S>(ws.U_dot)) +
                          rate * slope + water::blend<S>(table.damping, w, U);
    for (int c = 0; c < 6; ++c) {
      if (hb.moving[c] < 0)
        continue;
      ws.momentum[hb.moving[c]] += momentum[c];
      ws.inertia_force[hb.moving[c]] += force[c];
    }
    ws.table_loads[k] = S(0.5) * U.cwiseProduct(slope).sum() * pose.gradient;
  }
}

/// Memory states times the weights of their tables.
template <class S> const S* weighted_states(const HydroData& h, Workspace<S>& ws, const S* z) {
  if (h.tables.empty())
    return z;
  for (int k = 0; k < h.n_states; ++k) {
    const int weight = h.weight_of_state[static_cast<std::size_t>(k)];
    ws.weighted[k] = weight < 0 ? z[k] : ws.weights[weight] * z[k];
  }
  return ws.weighted.data();
}

/// Force A_inf U' + C z + B U into `ws.inertia_force`, momentum A_inf U into `ws.momentum`. Mean
/// axes do not need the momentum: it is zero.
template <class S> void hydro_loads(const Regime& s, Workspace<S>& ws, const S* z) {
  const HydroData& h = s.hydro;
  const HydroData::Products& products = h.products;
  hydro_motion(s, ws);
  ws.momentum.setZero();
  ws.inertia_force.setZero();
  if (h.axes != HydroAxes::mean)
    products.added_mass.add_product(ws.U.data(), ws.momentum.data());
  products.added_mass.add_product(ws.U_dot.data(), ws.inertia_force.data());
  add_tables<S>(s, ws);
  add_convolution<S>(h, ws);
  products.output.add_product(weighted_states<S>(h, ws, z), ws.inertia_force.data());
  products.damping.add_product(ws.U.data(), ws.inertia_force.data());
}

/// Subtracts the fluid's loads from `ws.loads` and writes the memory rows
/// z' - A_r z - B_r U = 0. Only coordinates that move are visited.
template <class S>
void add_loads(const Regime& s, const HydroData& h, Workspace<S>& ws, const S* y, const S* yp,
               S* residual) {
  const S* z = y + h.z0;
  hydro_loads<S>(s, ws, z);
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
  const S* z_dot = yp + h.z0;
  S* r = residual + h.z0;
  for (const HydroData::Block& b : h.blocks) {
    const int k = b.state;
    if (b.pair) {
      r[k] = z_dot[k] - S(b.a) * z[k] + S(b.b) * z[k + 1];
      r[k + 1] = z_dot[k + 1] - S(b.a) * z[k + 1] - S(b.b) * z[k];
    } else {
      r[k] = z_dot[k] - S(b.a) * z[k];
    }
  }
  h.products.input.add_product(ws.U.data(), r, -1.0);
}

} // namespace hydrodae::system
