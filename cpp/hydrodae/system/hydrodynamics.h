#pragma once
/// Added mass at infinite frequency, radiation memory and wave excitation as loads on the bodies.
///
/// In axes carried by the bodies, with U = (R^T v, w), P = A_inf U = (p, h) and y = C z, the fluid
/// takes from body i the force d/dt(R p) + R y and the moment d/dt(R h) + v x R p + R y (Kirchhoff;
/// Lamb, Hydrodynamics, art. 124), which conserves U.P/2 when y = 0. In mean axes, which
/// a constant yaw H turns, U = (H^T v, H^T R w) and the load is H (A_inf U' + y). The excitation
/// f(t) acts in the same axes: it is taken off y.
///
/// In axes H that turn with the yaw psi of the body, U = (H^T v, H^T R w) = (V, W), and the load is
/// H (p' + W_z x p) and H (h' + W_z x h) + s e_z.(V x p + W x h), with W_z = psi' e_z, psi' = s.w:
/// this too conserves U.P/2 when y = 0.

#include "hydrodae/system/history.h"

namespace hydrodae::system {

/// out = m x without temporaries; a plain loop for scalars that Eigen does not vectorise.
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

/// Yaw of a body: that of its x axis seen from above.
template <class S> struct Yaw {
  Mat3<S> H; ///< turns the yawed axes into those of the world
  Vec3<S> s; ///< d psi = s . d phi, body axes
};
template <class S> Yaw<S> yaw(const BodyState<S>& state) {
  using std::sqrt;
  const Mat3<S>& R = state.R;
  const S n = sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0)), c = R(0, 0) / n, d = R(1, 0) / n;
  Yaw<S> out;
  out.H << c, -d, S(0), d, c, S(0), S(0), S(0), S(1);
  out.s << S(0), R(2, 1) / (n * n), R(2, 2) / (n * n);
  return out;
}

/// e_z x a.
template <class S> Vec3<S> across_up(const Vec3<S>& a) { return {-a[1], a[0], S(0)}; }

/// H a of the force and moment a by the mean yaw H; `back`: H^T a.
template <class S> void turn_by_mean_yaw(const HydroBody& hb, bool back, Vec6<S>& a) {
  const S c(hb.cos_yaw), d(back ? -hb.sin_yaw : hb.sin_yaw);
  for (int k : {0, 3}) {
    const S x = a[k], y = a[k + 1];
    a[k] = c * x - d * y;
    a[k + 1] = d * x + c * y;
  }
}

/// Six velocities of a body in the hydrodynamic axes.
template <class S>
Vec6<S> hydro_velocity(HydroAxes axes, const HydroBody& hb, const BodyState<S>& state) {
  Vec6<S> U;
  if (axes == HydroAxes::body)
    U << state.R.transpose() * state.v, state.w;
  else if (axes == HydroAxes::yaw) {
    const Mat3<S> H_T = yaw<S>(state).H.transpose();
    U << H_T * state.v, H_T * (state.R * state.w);
  } else {
    U << state.v, state.R * state.w;
    if (hb.turned)
      turn_by_mean_yaw<S>(hb, true, U);
  }
  return U;
}

/// Their rates: (R^T v)' = R^T v' - w x R^T v.
template <class S>
Vec6<S> hydro_acceleration(HydroAxes axes, const HydroBody& hb, const BodyState<S>& state) {
  Vec6<S> a;
  if (axes == HydroAxes::body) {
    const Vec3<S> V = state.R.transpose() * state.v;
    a << state.R.transpose() * state.v_dot - cross<S>(state.w, V), state.w_dot;
  } else if (axes == HydroAxes::yaw) {
    const Yaw<S> psi = yaw<S>(state);
    const Mat3<S> H_T = psi.H.transpose();
    const S rate = psi.s.cwiseProduct(state.w).sum();
    const Vec3<S> V = H_T * state.v, W = H_T * (state.R * state.w);
    a << H_T * state.v_dot - rate * across_up<S>(V),
        H_T * (state.R * state.w_dot) - rate * across_up<S>(W);
  } else {
    a << state.v_dot, state.R * state.w_dot;
    if (hb.turned)
      turn_by_mean_yaw<S>(hb, true, a);
  }
  return a;
}

/// U and U' of all coordinates that move.
template <class S> void hydro_motion(const System& s, Workspace<S>& ws) {
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

/// What the fluid takes from one body (world force, body-axes moment), given its six components of
/// A_inf U' + C z (`rate`) and of A_inf U (`momentum`).
template <class S>
Vec6<S> hydro_load(HydroAxes axes, const HydroBody& hb, const BodyState<S>& state,
                   const Vec6<S>& rate, const Vec6<S>& momentum) {
  Vec6<S> load;
  if (axes == HydroAxes::body) {
    const Vec3<S> p = momentum.template head<3>(), h = momentum.template tail<3>();
    const Vec3<S> V = state.R.transpose() * state.v;
    const Vec3<S> force = rate.template head<3>() + cross<S>(state.w, p);
    load << state.R * force, rate.template tail<3>() + cross<S>(state.w, h) + cross<S>(V, p);
  } else if (axes == HydroAxes::yaw) {
    const Yaw<S> psi = yaw<S>(state);
    const Vec3<S> p = momentum.template head<3>(), h = momentum.template tail<3>();
    const Vec3<S> V = psi.H.transpose() * state.v, W = psi.H.transpose() * (state.R * state.w);
    const S turn = psi.s.cwiseProduct(state.w).sum();
    const S munk = cross<S>(V, p)[2] + cross<S>(W, h)[2];
    const Vec3<S> force = rate.template head<3>() + turn * across_up<S>(p);
    const Vec3<S> moment = rate.template tail<3>() + turn * across_up<S>(h);
    load << psi.H * force, state.R.transpose() * (psi.H * moment) + munk * psi.s;
  } else {
    load = rate;
    if (hb.turned)
      turn_by_mean_yaw<S>(hb, false, load);
    const Vec3<S> moment = load.template tail<3>();
    load.template tail<3>() = state.R.transpose() * moment;
  }
  return load;
}

/// int K U over the steps completed, and what U(t), U'(t) add by the piece that ends at t.
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

/// A_inf U' + C z + B U - f_ex(t) into `ws.inertia_force`, A_inf U into `ws.momentum`.
template <class S> void hydro_loads(const System& s, Workspace<S>& ws, double t, const S* z) {
  const HydroData& h = s.hydro;
  hydro_motion(s, ws);
  multiply<S>(h.added_mass, ws.U.data(), ws.momentum);
  multiply<S>(h.added_mass, ws.U_dot.data(), ws.inertia_force);
  add_convolution<S>(h, ws);
  if (h.n_states > 0) {
    multiply<S>(h.output, z, ws.U_dot); // U' is no longer needed
    ws.inertia_force += ws.U_dot;
  }
  if (h.damped) {
    multiply<S>(h.damping, ws.U.data(), ws.U_dot);
    ws.inertia_force += ws.U_dot;
  }
  if (!h.excitation.empty()) {
    h.excitation(t, ws.excitation);
    for (int u = 0; u < h.n_moving; ++u)
      ws.inertia_force[u] -= S(ws.excitation[u]);
  }
  if (!h.drifting.empty())
    for (const HydroBody& hb : h.bodies) {
      if (!hb.moves)
        continue;
      const Vec3<S> moved = ws.bodies[hb.body].r - s.bodies[hb.body].reference.template cast<S>();
      h.drifting(t, moved[0], moved[1], hb.first_moving(), hb.n_moving(), ws.U_dot.data());
      for (int k = 0; k < hb.n_moving(); ++k)
        ws.inertia_force[hb.first_moving() + k] -= ws.U_dot[k];
    }
}

/// Subtracts the fluid's loads from `ws.loads` and writes the memory rows
/// z' - A_r z - B_r U = 0. Only coordinates that move are visited.
template <class S>
void add_hydrodynamics(const System& s, Workspace<S>& ws, double t, const S* y, const S* yp,
                       S* residual) {
  const HydroData& h = s.hydro;
  if (h.n_moving == 0)
    return;
  const S* z = y + h.z0;
  hydro_loads<S>(s, ws, t, z);
  for (const HydroBody& hb : h.bodies) {
    if (!hb.moves)
      continue;
    Vec6<S> rate = Vec6<S>::Zero(), momentum = Vec6<S>::Zero();
    for (int c = 0; c < 6; ++c) {
      if (hb.moving[c] < 0)
        continue;
      rate[c] = ws.inertia_force[hb.moving[c]];
      momentum[c] = ws.momentum[hb.moving[c]];
    }
    ws.loads[hb.body] -= hydro_load<S>(h.axes, hb, ws.bodies[hb.body], rate, momentum);
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
  for (const HydroData::Input& in : h.inputs)
    r[in.state] -= S(in.value) * ws.U[in.coordinate];
}

} // namespace hydrodae::system
