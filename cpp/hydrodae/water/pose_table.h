#pragma once
/// Added mass and radiation of a body that depend on one coordinate s of its pose, from tables for
/// several poses.
///
///   A(s) = sum_m w_m(s) A_m,   B(s) likewise, and C(s) z if the memory is blended
///
/// The kinetic energy 1/2 U.A(s) U of the fluid takes from the body
///   d/dt (A(s) U) - 1/2 U.A'(s) U grad s
/// (Lagrange; Lamb, Hydrodynamics, art. 137). w_m: cardinal splines on the poses of the tables.

#include <vector>

#include "hydrodae/element/body_state.h"
#include "hydrodae/math/cardinal_splines.h"
#include "hydrodae/water/hydro_axes.h"

namespace hydrodae::water {

/// Coordinate of the pose with its gradient: ds = gradient . (dr, dphi), dr in world axes, the
/// virtual rotation dphi in body axes.
template <class S> struct PoseCoordinate {
  S value;
  Vec6<S> gradient;
  S rate(const element::BodyState<S>& b) const {
    return gradient.template head<3>().cwiseProduct(b.v).sum() +
           gradient.template tail<3>().cwiseProduct(b.w).sum();
  }
};

/// Gradient of roll, pitch or yaw (component 3, 4, 5) by the virtual rotation of the body, from the
/// vertical in body axes g = R^T e_z. Roll = atan2(g_y, g_z) and pitch = -asin(g_x) are independent
/// of yaw, the angle of the body's x axis seen from above.
template <class S> Vec3<S> turn_gradient(int component, const Vec3<S>& g) {
  using std::sqrt;
  const S square = g[1] * g[1] + g[2] * g[2];
  if (component == 3)
    return {S(1), -g[0] * g[1] / square, -g[0] * g[2] / square};
  if (component == 4) {
    const S n = sqrt(square);
    return {S(0), g[2] / n, -g[1] / n};
  }
  return {S(0), g[1] / square, g[2] / square};
}

/// Pose coordinate of a component: 0..2 displacement from `reference` along a world axis [m]; 3..5
/// roll, pitch, yaw [rad].
template <class S>
PoseCoordinate<S> pose_coordinate(int component, double reference, const element::BodyState<S>& b) {
  using std::atan2;
  using std::sqrt;
  PoseCoordinate<S> out;
  out.gradient.setZero();
  if (component < 3) {
    out.value = b.r[component] - S(reference);
    out.gradient[component] = S(1);
    return out;
  }
  const Vec3<S> g = b.R.row(2).transpose();
  out.gradient.template tail<3>() = turn_gradient<S>(component, g);
  if (component == 3)
    out.value = atan2(g[1], g[2]);
  else if (component == 4)
    out.value = atan2(-g[0], sqrt(g[1] * g[1] + g[2] * g[2]));
  else
    out.value = atan2(b.R(1, 0), b.R(0, 0));
  return out;
}

/// Derivative of the gradient by phi, with dg = [g] dphi; zero for a displacement.
inline Matrix3 pose_gradient_by_rotation(int component, const Matrix3& R) {
  Matrix3 out = Matrix3::Zero();
  if (component < 3)
    return out;
  const Vector3 g = R.row(2).transpose();
  const Matrix3 turn = skew<double>(g);
  for (int c = 0; c < 3; ++c) {
    const Vec3<Dual> turned(Dual(g[0], turn(0, c)), Dual(g[1], turn(1, c)), Dual(g[2], turn(2, c)));
    const Vec3<Dual> gradient = turn_gradient<Dual>(component, turned);
    for (int k = 0; k < 3; ++k)
      out(k, c) = gradient[k].b;
  }
  return out;
}

/// Weights of the tables of a body: functions of a coordinate of its pose.
struct PoseAxis {
  static constexpr std::size_t most = 100; ///< largest number of poses
  int component = 0;                       ///< component of the pose, 0..5
  double reference = 0.0;                  ///< reference of a displacement [m]
  CardinalSplines weights;                 ///< empty: one table for all poses

  template <class S> PoseCoordinate<S> at(const element::BodyState<S>& b) const {
    return pose_coordinate<S>(component, reference, b);
  }
};

/// Added mass of one body over its pose. Rows are all six loads; columns of fixed coordinates are
/// zero.
struct PoseTable {
  int hydro_body = 0;
  PoseAxis axis;
  std::vector<Matrix6> added_mass; ///< added mass at each pose
  int first_weight = 0;            ///< index in the weights of all tables
};

/// Matrix sum_m w_m M_m; zero without matrices.
inline Matrix6 blend(const std::vector<Matrix6>& tables, const double* weights) {
  Matrix6 out = Matrix6::Zero();
  for (const Matrix6& table : tables)
    out += *weights++ * table;
  return out;
}

/// Vector sum_m w_m M_m x.
template <class S>
Vec6<S> blend(const std::vector<Matrix6>& tables, const S* weights, const Vec6<S>& x) {
  Vec6<S> out = Vec6<S>::Zero();
  for (const Matrix6& table : tables) {
    const Vec6<S> part = table.template cast<S>() * x;
    out += *weights++ * part;
  }
  return out;
}

} // namespace hydrodae::water
