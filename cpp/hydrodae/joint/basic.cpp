#include "hydrodae/joint/basic.h"

namespace hydrodae::joint {

namespace {
// Offsets of the four blocks of xi.
constexpr int rA = 0, pA = 3, rB = 6, pB = 9;
} // namespace

// With delta a_W = -R_A [a]x dphi_A,
//      delta e   = [e]x dphi_A + R_A^T (dr_B - dr_A) - N [s_B]x dphi_B,
//      delta (N^T a) = [N^T a]x dphi_B - N^T [a]x dphi_A.
Matrix12 span_curvature(const Marker& A, const Marker& B, int i, const Geometry<double>& g) {
  const Vector3 a = A.axes.col(i);
  const Matrix3 ax = skew<double>(a), sx = skew<double>(B.point);
  const Matrix3 a_W = g.R_A * ax, a_e = ax * g.R_A.transpose();
  Matrix12 t = Matrix12::Zero();
  t.block<3, 3>(rA, pA) = a_W;
  t.block<3, 3>(rB, pA) = -a_W;
  t.block<3, 3>(pA, rA) = -a_e;
  t.block<3, 3>(pA, rB) = a_e;
  t.block<3, 3>(pA, pA) = ax * skew<double>(g.e);
  t.block<3, 3>(pA, pB) = -ax * g.N * sx;
  t.block<3, 3>(pB, pA) = -sx * g.N.transpose() * ax;
  t.block<3, 3>(pB, pB) = sx * skew<double>(g.N.transpose() * a);
  return t;
}

// With delta (N b) = [N b]x dphi_A - N [b]x dphi_B.
Matrix12 perp_curvature(const Marker& A, const Marker& B, int i, int j, const Geometry<double>& g) {
  const Vector3 a = A.axes.col(i), b = B.axes.col(j);
  const Matrix3 ax = skew<double>(a), bx = skew<double>(b);
  Matrix12 t = Matrix12::Zero();
  t.block<3, 3>(pA, pA) = ax * skew<double>(g.N * b);
  t.block<3, 3>(pA, pB) = -ax * g.N * bx;
  t.block<3, 3>(pB, pA) = -bx * g.N.transpose() * ax;
  t.block<3, 3>(pB, pB) = bx * skew<double>(g.N.transpose() * a);
  return t;
}

Matrix12 basic_curvature(const BasicRow& kind, const Marker& A, const Marker& B,
                         const Geometry<double>& g) {
  return kind.kind == BasicRow::Kind::span ? span_curvature(A, B, kind.i, g)
                                           : perp_curvature(A, B, kind.i, kind.j, g);
}

// theta = atan2(s, c): W = (c ds - s dc) / n2, n2 = c^2 + s^2, differentiated once more.
Matrix12 motion_curvature(const FreeMotion& motion, const Marker& A, const Marker& B,
                          const Geometry<double>& g) {
  if (motion.kind == FreeMotion::Kind::slides)
    return span_curvature(A, B, motion.axis, g);
  const int j = (motion.axis + 1) % 3, k = (motion.axis + 2) % 3;
  const Row<double> c = perp_row<double>(A, B, j, j, g), s = perp_row<double>(A, B, k, j, g);
  const double n2 = c.value * c.value + s.value * s.value;
  const Vector12 w = (c.value * s.gradient - s.value * c.gradient) / n2;
  const Vector12 n2_gradient = 2.0 * (c.value * c.gradient + s.value * s.gradient);
  return (s.gradient * c.gradient.transpose() - c.gradient * s.gradient.transpose() +
          c.value * perp_curvature(A, B, k, j, g) - s.value * perp_curvature(A, B, j, j, g) -
          w * n2_gradient.transpose()) /
         n2;
}

} // namespace hydrodae::joint
