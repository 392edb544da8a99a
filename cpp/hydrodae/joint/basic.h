#pragma once
/// The basic constraint rows and the free motions of joints: value, gradient and curvature, written
/// once. Gradients are with respect to the virtual displacements xi = (r_A, phi_A, r_B, phi_B), the
/// translations in world axes, the rotations in body axes; the same 12 numbers multiply the
/// velocities (v_A, w_A, v_B, w_B).

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

template <class S>
Row<S> basic_row(const BasicRow& kind, const Marker& A, const Marker& B, const Geometry<S>& g) {
  return kind.kind == BasicRow::Kind::span ? span_row<S>(A, B, kind.i, g)
                                           : perp_row<S>(A, B, kind.i, kind.j, g);
}

/// The coordinate of a free motion: displacement a_i . (B - A), or angle of B's axis j = i + 1 in
/// the plane normal to a_i, theta = atan2(a_k . b_j, a_j . b_j) with (i, j, k) cyclic, in (-pi,
/// pi].
template <class S>
Row<S> motion_row(const FreeMotion& motion, const Marker& A, const Marker& B,
                  const Geometry<S>& g) {
  using std::atan2;
  if (motion.kind == FreeMotion::Kind::slides)
    return span_row<S>(A, B, motion.axis, g);
  const int j = (motion.axis + 1) % 3, k = (motion.axis + 2) % 3;
  const Row<S> c = perp_row<S>(A, B, j, j, g), s = perp_row<S>(A, B, k, j, g);
  const S norm2 = c.value * c.value + s.value * s.value;
  return {atan2(s.value, c.value), (c.value * s.gradient - s.value * c.gradient) / norm2};
}

/// Curvature T(m, n) = d gradient(m) / d xi(n) of the rows above (kernel scalar only).
Matrix12 span_curvature(const Marker& A, const Marker& B, int i, const Geometry<double>& g);
Matrix12 perp_curvature(const Marker& A, const Marker& B, int i, int j, const Geometry<double>& g);
Matrix12 basic_curvature(const BasicRow& kind, const Marker& A, const Marker& B,
                         const Geometry<double>& g);
Matrix12 motion_curvature(const FreeMotion& motion, const Marker& A, const Marker& B,
                          const Geometry<double>& g);

} // namespace hydrodae::joint
