#pragma once
/// The basic constraint rows and the free motions of joints: value, gradient and curvature, written
/// once. Gradients are with respect to the virtual displacements xi = (r_A, phi_A, r_B, phi_B), the
/// translations in world axes, the rotations in body axes; the same 12 numbers multiply the
/// velocities (v_A, w_A, v_B, w_B).

#include <memory>

#include "hydrodae/joint/path.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/math/rotation.h"

namespace hydrodae::joint {

template <class S> using Vec12 = Eigen::Matrix<S, 12, 1>;
using Vector12 = Vec12<double>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// A frame carried by a body (or by the ground, body -1, whose frame is the world).
struct Marker {
  int body = -1;
  Vector3 point = Vector3::Zero();    ///< from the centre of gravity, body axes [m]
  Matrix3 axes = Matrix3::Identity(); ///< columns: marker axes in body axes
  std::shared_ptr<const Path> path;   ///< of a path joint: the curve, points like `point`
};

/// What every row of a joint needs of the poses of its two bodies.
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

/// Numbers of a joint that its rows need.
struct Parameters {
  double length = 1.0; ///< L of `distance` [m]
  double pitch = 1.0;  ///< P of `screw` [m per turn]
};

/// The value of angle + 2 pi k nearest to `reference`.
template <class S> S nearest_turn(const S& angle, double reference) {
  return angle + S(2.0 * pi * std::round((reference - value_of(angle)) / (2.0 * pi)));
}

/// A scalar function of the two poses with its gradient.
template <class S> struct Row {
  S value;
  Vec12<S> gradient;
};

/// g = a . (B - A), a fixed in A:  G = [-R_A a, a x e, R_A a, s_B x N^T a]
template <class S> Row<S> span_row(const Marker& A, const Marker& B, int i, const Geometry<S>& g) {
  const Vec3<S> a = A.axes.col(i).cast<S>();
  const Vec3<S> a_W = g.R_A * a;
  Row<S> row;
  row.value = dot<S>(a, g.e - A.point.cast<S>());
  row.gradient << -a_W, cross<S>(a, g.e), a_W, cross<S>(B.point.cast<S>(), g.N.transpose() * a);
  return row;
}

/// g = a . b:  G = [0, a x N b, 0, b x N^T a]
template <class S>
Row<S> perp_row(const Marker& A, const Marker& B, int i, int j, const Geometry<S>& g) {
  const Vec3<S> a = A.axes.col(i).cast<S>(), b = B.axes.col(j).cast<S>();
  const Vec3<S> b_A = g.N * b;
  Row<S> row;
  row.value = dot<S>(a, b_A);
  row.gradient << Vec3<S>::Zero(), cross<S>(a, b_A), Vec3<S>::Zero(),
      cross<S>(b, g.N.transpose() * a);
  return row;
}

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

/// g = (d.d / L - L) / 2, d = B - A:  G = [-d_W, d_A x s_A, d_W, s_B x d_B] / L
template <class S>
Row<S> distance_row(const Marker& A, const Marker& B, double length, const Geometry<S>& g) {
  const Vec3<S> d = g.e - A.point.cast<S>();
  return {S(0.5) * (dot<S>(d, d) / S(length) - S(length)),
          apart_gradient<S>(A, B, g, d) / S(length)};
}

/// s = |B - A| [m]. Where the points coincide it has no gradient: zero here, see
/// `parting_gradient`.
template <class S> Row<S> stretch_row(const Marker& A, const Marker& B, const Geometry<S>& g) {
  using std::sqrt;
  const Vec3<S> d = g.e - A.point.cast<S>();
  const S square = dot<S>(d, d);
  if (!(value_of(square) != 0.0))
    return {S(0), Vec12<S>::Zero()};
  const S s = sqrt(square);
  return {s, apart_gradient<S>(A, B, g, d) / s};
}

/// Gradient of s where the points coincide and part by the velocities u (12 numbers): along their
/// motion, its limit on the way there; zero at rest.
template <class S>
Vec12<S> parting_gradient(const Marker& A, const Marker& B, const Geometry<S>& g,
                          const Vec12<S>& u) {
  using std::sqrt;
  Vec3<S> rate;
  for (int k = 0; k < 3; ++k)
    rate[k] = apart_gradient<S>(A, B, g, Vec3<S>(Vector3::Unit(k).template cast<S>()))
                  .cwiseProduct(u)
                  .sum();
  const S square = dot<S>(rate, rate);
  if (value_of(square) == 0.0)
    return Vec12<S>::Zero();
  return apart_gradient<S>(A, B, g, rate) / sqrt(square);
}

/// Gradient of a function of the place e of B's marker seen from A, whose gradient there is a:
///   [-R_A a, a x e, R_A a, s_B x N^T a]
template <class S>
Vec12<S> place_gradient(const Vec3<S>& a, const Marker& B, const Geometry<S>& g) {
  const Vec3<S> a_W = g.R_A * a;
  Vec12<S> gradient;
  gradient << -a_W, cross<S>(a, g.e), a_W, cross<S>(B.point.cast<S>(), g.N.transpose() * a);
  return gradient;
}

/// g = n_i . w of the curve that A carries.
template <class S>
Row<S> across_row(const Marker& A, const Marker& B, int i, const Geometry<S>& g) {
  const PointFunction<S> f = A.path->across<S>(i, g.e);
  return {f.value, place_gradient<S>(f.gradient, B, g)};
}

/// Arc length from the first point of the curve to its point nearest to B [m].
template <class S> Row<S> travel_row(const Marker& A, const Marker& B, const Geometry<S>& g) {
  const PointFunction<S> f = A.path->arc<S>(g.e);
  return {f.value, place_gradient<S>(f.gradient, B, g)};
}

/// The coordinate of a free motion: displacement a_i . (B - A); distance |B - A|; arc length; angle
/// of B's axis j = i + 1 in the plane normal to a_i, theta = atan2(a_k . b_j, a_j . b_j) with (i,
/// j, k) cyclic; or, about an axis of B, the angle of A's axis k seen from B, theta = atan2(a_k .
/// b_j, a_k . b_k) with (i, j, k) cyclic. Angles in (-pi, pi].
template <class S>
Row<S> motion_row(const FreeMotion& motion, const Marker& A, const Marker& B,
                  const Geometry<S>& g) {
  using std::atan2;
  if (motion.kind == FreeMotion::Kind::slides)
    return span_row<S>(A, B, motion.axis, g);
  if (motion.kind == FreeMotion::Kind::stretches)
    return stretch_row<S>(A, B, g);
  if (motion.kind == FreeMotion::Kind::travels)
    return travel_row<S>(A, B, g);
  const int j = (motion.axis + 1) % 3, k = (motion.axis + 2) % 3;
  const int m = motion.kind == FreeMotion::Kind::turns ? j : k;
  const Row<S> c = perp_row<S>(A, B, m, m, g), s = perp_row<S>(A, B, k, j, g);
  const S norm2 = c.value * c.value + s.value * s.value;
  return {atan2(s.value, c.value), (c.value * s.gradient - s.value * c.gradient) / norm2};
}

/// g = s - P theta / 2 pi with theta on the turn that the displacement s gives.
template <class S>
Row<S> screw_row(const Marker& A, const Marker& B, double pitch, const Geometry<S>& g) {
  const double advance = pitch / (2.0 * pi);
  Row<S> row = span_row<S>(A, B, Z, g);
  const Row<S> turn = motion_row<S>(turns(Z), A, B, g);
  const double reference = value_of(row.value) / advance;
  row.value -= S(advance) * nearest_turn<S>(turn.value, reference);
  row.gradient -= S(advance) * turn.gradient;
  return row;
}

template <class S>
Row<S> basic_row(const BasicRow& kind, const Marker& A, const Marker& B, const Parameters& p,
                 const Geometry<S>& g) {
  switch (kind.kind) {
  case BasicRow::Kind::span:
    return span_row<S>(A, B, kind.i, g);
  case BasicRow::Kind::perp:
    return perp_row<S>(A, B, kind.i, kind.j, g);
  case BasicRow::Kind::distance:
    return distance_row<S>(A, B, p.length, g);
  case BasicRow::Kind::across:
    return across_row<S>(A, B, kind.i, g);
  case BasicRow::Kind::screw:
    break;
  }
  return screw_row<S>(A, B, p.pitch, g);
}

/// Curvature T(m, n) = d gradient(m) / d xi(n) of the rows above (kernel scalar only).
Matrix12 span_curvature(const Marker& A, const Marker& B, int i, const Geometry<double>& g);
Matrix12 perp_curvature(const Marker& A, const Marker& B, int i, int j, const Geometry<double>& g);
Matrix12 distance_curvature(const Marker& A, const Marker& B, double length,
                            const Geometry<double>& g);
Matrix12 basic_curvature(const BasicRow& kind, const Marker& A, const Marker& B,
                         const Parameters& p, const Geometry<double>& g);
Matrix12 motion_curvature(const FreeMotion& motion, const Marker& A, const Marker& B,
                          const Geometry<double>& g);

} // namespace hydrodae::joint
