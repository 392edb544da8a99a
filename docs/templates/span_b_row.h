#pragma once
/// A row along an axis of body B: the origin of marker A stays in a plane that body B carries.

#include <string>

#include "hydrodae/joint/geometry.h"

namespace hydrodae::joint {

/// b_i . (B - A) = 0 [m], with d = R_B^T (r_B - r_A - R_A s_A).
///   G = [-R_B b, N b x s_A, R_B b, b x d]
struct SpanBRow {
  int i = X; ///< axis of marker B
  static constexpr bool is_angle = false, needs_turns = true;

  std::string name() const { return std::string("gap along ") + "xyz"[i] + " of body B"; }

  template <class S>
  Row<S> at(const Marker& A, const Marker& B, const Parameters&, const Geometry<S>& g) const {
    const Vec3<S> b = B.axes.col(i).cast<S>(), s_A = A.point.cast<S>(), s_B = B.point.cast<S>();
    const Vec3<S> b_W = g.R_B * b, parting = g.N.transpose() * (g.e - s_A);
    Row<S> row;
    row.value = dot<S>(b, parting);
    row.gradient << -b_W, cross<S>(g.N * b, s_A), b_W, cross<S>(b, parting - s_B);
    return row;
  }
  /// With delta (N b) = [N b]x dphi_A - N [b]x dphi_B,
  ///      delta d = R_B^T (dr_B - dr_A) + N^T [s_A]x dphi_A + [d]x dphi_B.
  Matrix12 curvature(const Marker& A, const Marker& B, const Parameters&,
                     const Geometry<double>& g) const {
    const Vector3 b = B.axes.col(i), d = g.N.transpose() * (g.e - A.point) - B.point;
    const Matrix3 bx = skew<double>(b), sA = skew<double>(A.point);
    Matrix12 t = Matrix12::Zero();
    t.block<3, 3>(rA, pB) = g.R_B * bx;
    t.block<3, 3>(rB, pB) = -g.R_B * bx;
    t.block<3, 3>(pA, pA) = -sA * skew<double>(g.N * b);
    t.block<3, 3>(pA, pB) = sA * g.N * bx;
    t.block<3, 3>(pB, rA) = -bx * g.R_B.transpose();
    t.block<3, 3>(pB, rB) = bx * g.R_B.transpose();
    t.block<3, 3>(pB, pA) = bx * g.N.transpose() * sA;
    t.block<3, 3>(pB, pB) = bx * skew<double>(d);
    return t;
  }
  bool operator==(const SpanBRow&) const = default;
};
constexpr SpanBRow span_b(Axis i) { return {i}; }

} // namespace hydrodae::joint
