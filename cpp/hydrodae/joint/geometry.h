#pragma once
/// Two markers, and the geometry that joint rows need. The gradient of a row is with respect to the
/// virtual displacements xi = (r_A, phi_A, r_B, phi_B), translations in world axes, rotations in
/// body axes; the same 12 numbers multiply the velocities (v_A, w_A, v_B, w_B).

#include <memory>

#include "hydrodae/joint/path.h"
#include "hydrodae/math/rotation.h"

namespace hydrodae::joint {

enum Axis : int { X = 0, Y = 1, Z = 2 };

template <class S> using Vec12 = Eigen::Matrix<S, 12, 1>;
using Vector12 = Vec12<double>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

inline constexpr int rA = 0, pA = 3, rB = 6, pB = 9; ///< first entries of the four blocks of xi

/// A frame carried by a body (or by the ground, body -1, whose frame is the world).
struct Marker {
  int body = -1;
  Vector3 point = Vector3::Zero();    ///< position relative to the centre of gravity, body axes [m]
  Matrix3 axes = Matrix3::Identity(); ///< columns: marker axes in body axes
  std::shared_ptr<const Path> path;   ///< curve of a path joint, with points given like `point`
};

/// Geometry of a joint from the poses of its two bodies:
///   N = R_A^T R_B,   e = R_A^T (r_B + R_B s_B - r_A): the origin of B seen from body A [m]
template <class S> struct Geometry {
  Mat3<S> R_A, R_B, N;
  Vec3<S> e;
};

template <class S>
Geometry<S> geometry(const Marker& b, const Vec3<S>& r_A, const Mat3<S>& R_A, const Vec3<S>& r_B,
                     const Mat3<S>& R_B) {
  Geometry<S> g;
  g.R_A = R_A;
  g.R_B = R_B;
  g.N = R_A.transpose() * R_B;
  g.e = R_A.transpose() * (r_B - r_A) + g.N * b.point.cast<S>();
  return g;
}

/// Parameters of the rows of a joint.
struct Parameters {
  double length = 1.0; ///< L of `distance` [m]
  double pitch = 1.0;  ///< P of `screw` [m per turn]
};

/// Value of angle + 2 pi k nearest to `reference`.
template <class S> S nearest_turn(const S& angle, double reference) {
  return angle + S(2.0 * pi * std::round((reference - value_of(angle)) / (2.0 * pi)));
}

/// A scalar function of the two poses with its gradient.
template <class S> struct Row {
  S value;
  Vec12<S> gradient;
};

/// Gradient of a . (B - A) with a held in the world, given along the axes of body A:
///   [-a_W, a x s_A, a_W, s_B x a_B]
template <class S>
Vec12<S> apart_gradient(const Marker& A, const Marker& B, const Geometry<S>& g, const Vec3<S>& a) {
  const Vec3<S> a_W = g.R_A * a;
  Vec12<S> gradient;
  gradient << -a_W, cross<S>(a, A.point.cast<S>()), a_W,
      cross<S>(B.point.cast<S>(), g.N.transpose() * a);
  return gradient;
}

/// Gradient of a function of the place e of marker B relative to A, whose gradient by e is a:
///   [-R_A a, a x e, R_A a, s_B x N^T a]
template <class S>
Vec12<S> place_gradient(const Vec3<S>& a, const Marker& B, const Geometry<S>& g) {
  const Vec3<S> a_W = g.R_A * a;
  Vec12<S> gradient;
  gradient << -a_W, cross<S>(a, g.e), a_W, cross<S>(B.point.cast<S>(), g.N.transpose() * a);
  return gradient;
}

/// Curvature T(m, n) = d gradient(m) / d xi(n) of a . (B - A), a fixed in A.
Matrix12 along_curvature(const Vector3& a, const Marker& B, const Geometry<double>& g);

/// Curvature of a function of e with gradient a and second derivatives H there.
Matrix12 place_curvature(const Vector3& a, const Matrix3& H, const Marker& B,
                         const Geometry<double>& g);

/// Reaction on body B of a constraint that loads both bodies with `load` (12 numbers, a gradient
/// times its multiplier): force along the axes of marker A, moment about the origin of marker B
/// along the same axes.
///   f = A^T R_A^T load_r,   m = A^T N (load_phi - s_B x R_B^T load_r)
Vector6 reaction(const Vector12& load, const Marker& A, const Marker& B, const Geometry<double>& g);

} // namespace hydrodae::joint
