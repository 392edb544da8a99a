#include "hydrodae/joint/basic.h"

namespace hydrodae::joint {

// With delta a_W = -R_A [a]x dphi_A,
//      delta e   = [e]x dphi_A + R_A^T (dr_B - dr_A) - N [s_B]x dphi_B,
//      delta (N^T a) = [N^T a]x dphi_B - N^T [a]x dphi_A.
Matrix12 along_curvature(const Vector3& a, const Marker& B, const Geometry<double>& g) {
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

// f(e) with gradient a and second derivatives H: delta f = a . J xi, so T = J^T H J + (dJ)^T a with
// J = [-R_A^T, [e]x, R_A^T, -N [s_B]x]; the second part is that of a row along a fixed a.
Matrix12 place_curvature(const Vector3& a, const Matrix3& H, const Marker& B,
                         const Geometry<double>& g) {
  Eigen::Matrix<double, 3, 12> J;
  J << -g.R_A.transpose(), skew<double>(g.e), g.R_A.transpose(), -g.N * skew<double>(B.point);
  return J.transpose() * H * J + along_curvature(a, B, g);
}

Vector6 reaction(const Vector12& load, const Marker& A, const Marker& B,
                 const Geometry<double>& g) {
  const Vector3 force = load.segment<3>(rB);
  const Vector3 moment = load.segment<3>(pB) - B.point.cross(g.R_B.transpose() * force);
  Vector6 out;
  out << A.axes.transpose() * (g.R_A.transpose() * force), A.axes.transpose() * (g.N * moment);
  return out;
}

Matrix12 TurnAngle::curvature(const Marker& A, const Marker& B, const Geometry<double>& g) const {
  const Row<double> cosine = c.at<double>(A, B, {}, g), sine = s.at<double>(A, B, {}, g);
  const double n2 = cosine.value * cosine.value + sine.value * sine.value;
  const Vector12 w = (cosine.value * sine.gradient - sine.value * cosine.gradient) / n2;
  const Vector12 n2_gradient = 2.0 * (cosine.value * cosine.gradient + sine.value * sine.gradient);
  return (sine.gradient * cosine.gradient.transpose() -
          cosine.gradient * sine.gradient.transpose() + cosine.value * s.curvature(A, B, {}, g) -
          sine.value * c.curvature(A, B, {}, g) - w * n2_gradient.transpose()) /
         n2;
}

Matrix12 basic_curvature(const BasicRow& row, const Marker& A, const Marker& B, const Parameters& p,
                         const Geometry<double>& g) {
  return std::visit([&](const auto& kind) { return kind.curvature(A, B, p, g); }, row);
}

Matrix12 motion_curvature(const FreeMotion& motion, const Marker& A, const Marker& B,
                          const Geometry<double>& g) {
  if (motion.kind == FreeMotion::Kind::slides)
    return SpanRow{motion.axis}.curvature(A, B, {}, g);
  if (motion.kind == FreeMotion::Kind::travels)
    return place_curvature(A.path->arc<double>(g.e).gradient, A.path->arc_hessian(g.e), B, g);
  if (motion.kind == FreeMotion::Kind::stretches) {
    const Row<double> s = stretch_row<double>(A, B, g);
    if (s.value == 0.0)
      return Matrix12::Zero(); // no definite second derivative there
    return (distance().curvature(A, B, Parameters{1.0}, g) - s.gradient * s.gradient.transpose()) /
           s.value;
  }
  return turn_angle(motion).curvature(A, B, g);
}

} // namespace hydrodae::joint
