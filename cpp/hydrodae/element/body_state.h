#pragma once
/// Pose and motion of one body, and its loads in two kinds of axes.

#include <algorithm>

#include "hydrodae/math/rotation.h"

namespace hydrodae::element {

/// r, v in world axes, w in body axes, about the centre of gravity.
template <class S> struct BodyState {
  Vec3<S> r, v, w, v_dot, w_dot;
  Vec4<S> p;
  Mat3<S> R;
};

/// What Port::in_water sees of a body: r, R (by columns), v, w, v', w'.
inline constexpr int body_numbers = 24;

template <class S> void write(const BodyState<S>& b, S* out) {
  const auto put = [&](const auto& part) { out = std::copy_n(part.data(), part.size(), out); };
  put(b.r);
  put(b.R);
  put(b.v);
  put(b.w);
  put(b.v_dot);
  put(b.w_dot);
}

/// Without p.
template <class S> BodyState<S> read_body(const S* in) {
  BodyState<S> b;
  const auto take = [&](auto& part) {
    std::copy_n(in, part.size(), part.data());
    in += part.size();
  };
  take(b.r);
  take(b.R);
  take(b.v);
  take(b.w);
  take(b.v_dot);
  take(b.w_dot);
  return b;
}

/// World force and body-axes moment of a wrench given in earth axes.
template <class S> Vec6<S> to_tangent(const BodyState<S>& state, const Vec6<S>& wrench) {
  Vec6<S> load;
  load << wrench.template head<3>(), state.R.transpose() * wrench.template tail<3>();
  return load;
}

/// Force and moment in world axes of a load given as world force and body-axes moment.
inline Vector6 to_world(const BodyState<double>& state, const Vector6& tangent) {
  Vector6 load;
  load << tangent.head<3>(), state.R * tangent.tail<3>();
  return load;
}

} // namespace hydrodae::element
