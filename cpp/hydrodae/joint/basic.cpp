#include "hydrodae/joint/basic.h"

namespace hydrodae::joint {

namespace {
// Offsets of the four blocks of xi.
constexpr int rA = 0, pA = 3, rB = 6, pB = 9;
} // namespace

// With delta a_W = -R_A [a]x dphi_A,
//      delta e   = [e]x dphi_A + R_A^T (dr_B - dr_A) - N [s_B]x dphi_B,
//      delta (N^T a) = [N^T a]x dphi_B - N^T [a]x dphi_A.
static Matrix12 along_curvature(const Vector3& a, const Marker& B, const Geometry<double>& g) {
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

Matrix12 span_curvature(const Marker& A, const Marker& B, int i, const Geometry<double>& g) {
  return along_curvature(A.axes.col(i), B, g);
}

// f(e) with gradient a and second derivatives H: delta f = a . J xi, so T = J^T H J + (dJ)^T a with
// J = [-R_A^T, [e]x, R_A^T, -N [s_B]x]; the second part is that of a row along a fixed a.
static Matrix12 place_curvature(const Vector3& a, const Matrix3& H, const Marker& B,
                                const Geometry<double>& g) {
  Eigen::Matrix<double, 3, 12> J;
  J << -g.R_A.transpose(), skew<double>(g.e), g.R_A.transpose(), -g.N * skew<double>(B.point);
  return J.transpose() * H * J + along_curvature(a, B, g);
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

// With delta d_W = D xi, D = [-I, R_A [s_A]x, I, -R_B [s_B]x],
//      delta d_A = R_A^T D xi + [d_A]x dphi_A,   delta d_B = R_B^T D xi + [d_B]x dphi_B.
Matrix12 distance_curvature(const Marker& A, const Marker& B, double length,
                            const Geometry<double>& g) {
  const Vector3 d_A = g.e - A.point, d_B = g.N.transpose() * d_A;
  const Matrix3 sA = skew<double>(A.point), sB = skew<double>(B.point);
  Eigen::Matrix<double, 3, 12> D;
  D << -Matrix3::Identity(), g.R_A * sA, Matrix3::Identity(), -g.R_B * sB;
  Eigen::Matrix<double, 3, 12> D_A = g.R_A.transpose() * D, D_B = g.R_B.transpose() * D;
  D_A.middleCols<3>(pA) += skew<double>(d_A);
  D_B.middleCols<3>(pB) += skew<double>(d_B);
  Matrix12 t;
  t << -D, -sA * D_A, D, sB * D_B;
  return t / length;
}

Matrix12 basic_curvature(const BasicRow& kind, const Marker& A, const Marker& B,
                         const Parameters& p, const Geometry<double>& g) {
  switch (kind.kind) {
  case BasicRow::Kind::span:
    return span_curvature(A, B, kind.i, g);
  case BasicRow::Kind::perp:
    return perp_curvature(A, B, kind.i, kind.j, g);
  case BasicRow::Kind::distance:
    return distance_curvature(A, B, p.length, g);
  case BasicRow::Kind::across:
    return place_curvature(A.path->across<double>(kind.i, g.e).gradient,
                           A.path->across_hessian(kind.i, g.e), B, g);
  case BasicRow::Kind::screw:
    break;
  }
  return span_curvature(A, B, Z, g) - p.pitch / (2.0 * pi) * motion_curvature(turns(Z), A, B, g);
}

// theta = atan2(s, c): W = (c ds - s dc) / n2, n2 = c^2 + s^2, differentiated once more.
Matrix12 motion_curvature(const FreeMotion& motion, const Marker& A, const Marker& B,
                          const Geometry<double>& g) {
  if (motion.kind == FreeMotion::Kind::slides)
    return span_curvature(A, B, motion.axis, g);
  if (motion.kind == FreeMotion::Kind::travels)
    return place_curvature(A.path->arc<double>(g.e).gradient, A.path->arc_hessian(g.e), B, g);
  if (motion.kind == FreeMotion::Kind::stretches) {
    const Row<double> s = stretch_row<double>(A, B, g);
    if (s.value == 0.0)
      return Matrix12::Zero(); // no definite second derivative there
    return (distance_curvature(A, B, 1.0, g) - s.gradient * s.gradient.transpose()) / s.value;
  }
  const int j = (motion.axis + 1) % 3, k = (motion.axis + 2) % 3;
  const int m = motion.kind == FreeMotion::Kind::turns ? j : k;
  const Row<double> c = perp_row<double>(A, B, m, m, g), s = perp_row<double>(A, B, k, j, g);
  const double n2 = c.value * c.value + s.value * s.value;
  const Vector12 w = (c.value * s.gradient - s.value * c.gradient) / n2;
  const Vector12 n2_gradient = 2.0 * (c.value * c.gradient + s.value * s.gradient);
  return (s.gradient * c.gradient.transpose() - c.gradient * s.gradient.transpose() +
          c.value * perp_curvature(A, B, k, j, g) - s.value * perp_curvature(A, B, m, m, g) -
          w * n2_gradient.transpose()) /
         n2;
}

} // namespace hydrodae::joint
