#pragma once
/// Pose and motion of one body; conversion of its loads between axes.

#include <algorithm>

#include "hydrodae/math/rotation.h"

namespace hydrodae::element {

/// State of a body at its centre of gravity: r, v in world axes, w in body axes.
template <class S> struct BodyState {
  Vec3<S> r, v, w, v_dot, w_dot;
  Vec4<S> p;
  Mat3<S> R;
};

/// Inputs of Port::in_water for one body: r, R (by columns), v, w, v', w'.
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

/// Body state from the inputs of a law in water, without p.
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

/// Load as world force and body-axes moment, from a wrench in earth axes.
template <class S> Vec6<S> to_tangent(const BodyState<S>& state, const Vec6<S>& wrench) {
  Vec6<S> load;
  load << wrench.template head<3>(), state.R.transpose() * wrench.template tail<3>();
  return load;
}

/// Load as force and moment in world axes, from world force and body-axes moment.
inline Vector6 to_world(const BodyState<double>& state, const Vector6& tangent) {
  Vector6 load;
  load << tangent.head<3>(), state.R * tangent.tail<3>();
  return load;
}

} // namespace hydrodae::element
