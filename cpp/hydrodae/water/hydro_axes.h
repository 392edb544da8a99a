#pragma once
/// Axes of added mass, radiation and excitation of a body, and the loads in them.
///
/// In axes carried by the bodies U = (R^T v, w), and the fluid has the momentum P = A_inf U = (p,
/// h). The fluid takes from a body the force d/dt(R p) + R y and the moment d/dt(R h) + v x R p + R
/// y (Kirchhoff; Lamb, Hydrodynamics, art. 124). U.P/2 is conserved if the additional load y is
/// zero. In mean axes, turned by a constant yaw H, U = (H^T v, H^T R w), and the load is H (A_inf
/// U' + y).
///
/// In axes H that turn with the yaw psi of the body, U = (H^T v, H^T R w) = (V, W). The load is H
/// (p' + W_z x p) and H (h' + W_z x h) + s e_z.(V x p + W x h), with W_z = psi' e_z, psi' = s.w.
/// U.P/2 is conserved here, too, if y = 0.

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "hydrodae/element/body_state.h"

namespace hydrodae::water {

/// Axes of added mass, radiation and excitation: carried by each body; earth axes turned by the
/// mean yaw of each body; or axes that turn only with the body's yaw.
enum class HydroAxes { body, mean, yaw };

/// Word of these axes in a case, with its meaning.
struct AxesWord {
  HydroAxes axes;
  std::string_view word, doc;
};
inline constexpr std::array<AxesWord, 3> axes_words = {{
    {HydroAxes::mean, "mean",
     "earth axes turned by the yaw of each body at the start or in the equilibrium"},
    {HydroAxes::yaw, "yaw", "axes that follow its yaw"},
    {HydroAxes::body, "body", "axes that it carries, for large rotations in still water"},
}};

/// Hydrodynamic body: places of its six coordinates in the full and in the moving vectors, and its
/// mean yaw, that of the start or equilibrium pose.
struct HydroBody {
  int body = 0;
  int carrier = 0; ///< index of the hydrodynamic body that deforms, for a mode; else its own
  double yaw = 0.0, cos_yaw = 1.0, sin_yaw = 0.0; ///< [rad], [-], [-]
  bool turned = false;                            ///< yaw != 0
  std::array<int, 6> moving{}; ///< index in U of each of the six coordinates; -1: fixed
  bool moves = false;
  int table = -1; ///< index in AddedMass::tables; -1: added mass does not depend on the pose
  int n_moving() const {
    return 6 - static_cast<int>(std::count(moving.begin(), moving.end(), -1));
  }
  /// Six components of a body from the moving ones of all bodies; fixed ones are zero.
  template <class S> Vec6<S> gather(const S* moving_of_all) const {
    Vec6<S> out = Vec6<S>::Zero();
    for (int c = 0; c < 6; ++c)
      if (const int u = moving[static_cast<std::size_t>(c)]; u >= 0)
        out[c] = moving_of_all[u];
    return out;
  }
  template <class S> Vec6<S> gather(const VecX<S>& moving_of_all) const {
    return gather<S>(moving_of_all.data());
  }
  int first_moving() const {
    return *std::find_if(moving.begin(), moving.end(), [](int u) { return u >= 0; });
  }
};

/// Yaw of a body: angle of its x axis seen from above.
template <class S> struct Yaw {
  Mat3<S> H; ///< rotation from the yawed axes to the world
  Vec3<S> s; ///< d psi = s . d phi, body axes
};
template <class S> Yaw<S> yaw(const element::BodyState<S>& state) {
  using std::sqrt;
  const Mat3<S>& R = state.R;
  const S n = sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0)), c = R(0, 0) / n, d = R(1, 0) / n;
  Yaw<S> out;
  out.H << c, -d, S(0), d, c, S(0), S(0), S(0), S(1);
  out.s << S(0), R(2, 1) / (n * n), R(2, 2) / (n * n);
  return out;
}

/// Cross product e_z x a.
template <class S> Vec3<S> across_up(const Vec3<S>& a) { return {-a[1], a[0], S(0)}; }

/// Rotates the force and moment a by the mean yaw: H a; `back`: H^T a.
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
Vec6<S> hydro_velocity(HydroAxes axes, const HydroBody& hb, const element::BodyState<S>& state) {
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

/// Accelerations of a body in the hydrodynamic axes: (R^T v)' = R^T v' - w x R^T v.
template <class S>
Vec6<S> hydro_acceleration(HydroAxes axes, const HydroBody& hb,
                           const element::BodyState<S>& state) {
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

/// Load that the fluid takes from one body (world force, body-axes moment), from its six components
/// of A_inf U' + C z (`rate`) and of A_inf U (`momentum`).
template <class S>
Vec6<S> hydro_load(HydroAxes axes, const HydroBody& hb, const element::BodyState<S>& state,
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

} // namespace hydrodae::water
