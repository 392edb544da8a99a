#pragma once
/// The kinds of basic joint rows, one struct each, and their list `AllRowKinds`.
///
/// The marker on body A has the axes a_x, a_y, a_z and the origin A; that on body B has b_x, b_y,
/// b_z and B. Every kind has these members, and nothing else of the kernel names a kind for them:
///
///   at(A, B, p, g)        value and gradient, for numbers and dual numbers
///   curvature(A, B, p, g) T(m, n) = d gradient(m) / d xi(n), numbers only
///   name()                text of messages and channels: "gap along x"
///   is_angle              unit of the value: rad (or none) if true, otherwise m
///   needs_turns           the row holds a rotation, so that a body without rotation cannot have it
///
/// Rows `span` and `perp` give the standard joints (Haug, Computer Aided Kinematics and Dynamics of
/// Mechanical Systems, 1989, ch. 9: "dot-2" and "dot-1" constraints). Both markers coincide in the
/// reference pose, except along `distance`.

#include <array>
#include <string>
#include <variant>

#include "hydrodae/joint/geometry.h"

namespace hydrodae::joint {

inline constexpr std::array<char, 3> axis_letters = {'x', 'y', 'z'};

/// a_i . (B - A) = 0 [m]: the origins do not part along a_i.
///   G = [-R_A a, a x e, R_A a, s_B x N^T a]
struct SpanRow {
  int i = X; ///< axis of marker A
  static constexpr bool is_angle = false, needs_turns = false;

  std::string name() const { return std::string("gap along ") + axis_letters[i]; }

  template <class S>
  Row<S> at(const Marker& A, const Marker& B, const Parameters&, const Geometry<S>& g) const {
    const Vec3<S> a = A.axes.col(i).cast<S>();
    return {dot<S>(a, g.e - A.point.cast<S>()), place_gradient<S>(a, B, g)};
  }
  Matrix12 curvature(const Marker& A, const Marker& B, const Parameters&,
                     const Geometry<double>& g) const {
    return along_curvature(A.axes.col(i), B, g);
  }
  bool operator==(const SpanRow&) const = default;
};
constexpr SpanRow span(Axis i) { return {i}; }

/// a_i . b_j = 0 [-]: two axes stay perpendicular. The row also vanishes when a body is flipped by
/// 180 degrees; the branch is checked at the start of a run.
///   G = [0, a x N b, 0, b x N^T a]
struct PerpRow {
  int i = X; ///< axis of marker A
  int j = Y; ///< axis of marker B
  static constexpr bool is_angle = true, needs_turns = true;

  std::string name() const {
    return std::string("axes ") + axis_letters[i] + "-" + axis_letters[j];
  }

  template <class S>
  Row<S> at(const Marker& A, const Marker& B, const Parameters&, const Geometry<S>& g) const {
    const Vec3<S> a = A.axes.col(i).cast<S>(), b = B.axes.col(j).cast<S>();
    const Vec3<S> b_A = g.N * b;
    Row<S> row;
    row.value = dot<S>(a, b_A);
    row.gradient << Vec3<S>::Zero(), cross<S>(a, b_A), Vec3<S>::Zero(),
        cross<S>(b, g.N.transpose() * a);
    return row;
  }
  /// With delta (N b) = [N b]x dphi_A - N [b]x dphi_B.
  Matrix12 curvature(const Marker& A, const Marker& B, const Parameters&,
                     const Geometry<double>& g) const {
    const Vector3 a = A.axes.col(i), b = B.axes.col(j);
    const Matrix3 ax = skew<double>(a), bx = skew<double>(b);
    Matrix12 t = Matrix12::Zero();
    t.block<3, 3>(pA, pA) = ax * skew<double>(g.N * b);
    t.block<3, 3>(pA, pB) = -ax * g.N * bx;
    t.block<3, 3>(pB, pA) = -bx * g.N.transpose() * ax;
    t.block<3, 3>(pB, pB) = bx * skew<double>(g.N.transpose() * a);
    return t;
  }
  bool operator==(const PerpRow&) const = default;
};
constexpr PerpRow perp(Axis i, Axis j) { return {i, j}; }

/// Angle of body B against body A, theta = atan2(s, c) in (-pi, pi], s and c: products of two axes.
struct TurnAngle {
  PerpRow c, s;

  template <class S> Row<S> at(const Marker& A, const Marker& B, const Geometry<S>& g) const {
    using std::atan2;
    const Row<S> cosine = c.at<S>(A, B, {}, g), sine = s.at<S>(A, B, {}, g);
    const S norm2 = cosine.value * cosine.value + sine.value * sine.value;
    return {atan2(sine.value, cosine.value),
            (cosine.value * sine.gradient - sine.value * cosine.gradient) / norm2};
  }
  /// Second derivatives: the gradient (c ds - s dc) / n2, n2 = c^2 + s^2, differentiated once more.
  Matrix12 curvature(const Marker& A, const Marker& B, const Geometry<double>& g) const;
};

/// Angle about axis i of marker A: angle of b_j in the plane normal to a_i, atan2(a_k . b_j, a_j .
/// b_j) with (i, j, k) cyclic.
constexpr TurnAngle turn_about_a(int i) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return {{j, j}, {k, j}};
}

/// Angle about axis i of marker B: angle of a_k seen from B, atan2(a_k . b_j, a_k . b_k) with (i,
/// j, k) cyclic.
constexpr TurnAngle turn_about_b(int i) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return {{k, k}, {k, j}};
}

/// d.d / 2L - L / 2 = 0 [m], d = B - A: the origins keep the distance L.
///   G = [-d_W, d_A x s_A, d_W, s_B x d_B] / L
struct DistanceRow {
  static constexpr bool is_angle = false, needs_turns = false;

  std::string name() const { return "distance"; }

  template <class S>
  Row<S> at(const Marker& A, const Marker& B, const Parameters& p, const Geometry<S>& g) const {
    const Vec3<S> d = g.e - A.point.cast<S>();
    return {S(0.5) * (dot<S>(d, d) / S(p.length) - S(p.length)),
            apart_gradient<S>(A, B, g, d) / S(p.length)};
  }
  /// With delta d_W = D xi, D = [-I, R_A [s_A]x, I, -R_B [s_B]x],
  ///      delta d_A = R_A^T D xi + [d_A]x dphi_A,   delta d_B = R_B^T D xi + [d_B]x dphi_B.
  Matrix12 curvature(const Marker& A, const Marker& B, const Parameters& p,
                     const Geometry<double>& g) const {
    const Vector3 d_A = g.e - A.point, d_B = g.N.transpose() * d_A;
    const Matrix3 sA = skew<double>(A.point), sB = skew<double>(B.point);
    Eigen::Matrix<double, 3, 12> D;
    D << -Matrix3::Identity(), g.R_A * sA, Matrix3::Identity(), -g.R_B * sB;
    Eigen::Matrix<double, 3, 12> D_A = g.R_A.transpose() * D, D_B = g.R_B.transpose() * D;
    D_A.middleCols<3>(pA) += skew<double>(d_A);
    D_B.middleCols<3>(pB) += skew<double>(d_B);
    Matrix12 t;
    t << -D, -sA * D_A, D, sB * D_B;
    return t / p.length;
  }
  bool operator==(const DistanceRow&) const = default;
};
constexpr DistanceRow distance() { return {}; }

/// n_i . (B - C) = 0 [m], C: nearest point of a curve that A carries (see path.h).
struct AcrossRow {
  int i = 0; ///< vector across the curve (0, 1)
  static constexpr bool is_angle = false, needs_turns = false;

  std::string name() const { return i == 0 ? "gap across the path" : "second gap across the path"; }

  template <class S>
  Row<S> at(const Marker& A, const Marker& B, const Parameters&, const Geometry<S>& g) const {
    const PointFunction<S> f = A.path->across<S>(i, g.e);
    return {f.value, place_gradient<S>(f.gradient, B, g)};
  }
  Matrix12 curvature(const Marker& A, const Marker& B, const Parameters&,
                     const Geometry<double>& g) const {
    return place_curvature(A.path->across<double>(i, g.e).gradient, A.path->across_hessian(i, g.e),
                           B, g);
  }
  bool operator==(const AcrossRow&) const = default;
};
constexpr AcrossRow across(int i) { return {i}; }

/// Screw s - P theta / 2 pi = 0 [m]: displacement s and rotation theta along and about a_z; P:
/// advance per turn. s selects the turn of theta.
struct ScrewRow {
  static constexpr bool is_angle = false, needs_turns = true;
  static constexpr TurnAngle turn = turn_about_a(Z);

  std::string name() const { return "screw"; }

  template <class S>
  Row<S> at(const Marker& A, const Marker& B, const Parameters& p, const Geometry<S>& g) const {
    const double advance = p.pitch / (2.0 * pi);
    Row<S> row = span(Z).at<S>(A, B, p, g);
    const Row<S> angle = turn.at<S>(A, B, g);
    const double reference = value_of(row.value) / advance;
    row.value -= S(advance) * nearest_turn<S>(angle.value, reference);
    row.gradient -= S(advance) * angle.gradient;
    return row;
  }
  Matrix12 curvature(const Marker& A, const Marker& B, const Parameters& p,
                     const Geometry<double>& g) const {
    return span(Z).curvature(A, B, p, g) - p.pitch / (2.0 * pi) * turn.curvature(A, B, g);
  }
  bool operator==(const ScrewRow&) const = default;
};
constexpr ScrewRow screw() { return {}; }

/// The list of all kinds. A new kind is a struct above, and its name here.
using AllRowKinds = std::variant<SpanRow, PerpRow, DistanceRow, AcrossRow, ScrewRow>;

/// A row of one of these kinds.
using BasicRow = AllRowKinds;

/// Value and gradient of a row. The list is known to the compiler, so that this is a switch.
template <class S>
Row<S> basic_row(const BasicRow& row, const Marker& A, const Marker& B, const Parameters& p,
                 const Geometry<S>& g) {
  return std::visit([&](const auto& kind) { return kind.template at<S>(A, B, p, g); }, row);
}

/// Curvature of a row (numbers only).
Matrix12 basic_curvature(const BasicRow& row, const Marker& A, const Marker& B, const Parameters& p,
                         const Geometry<double>& g);

/// Returns whether the value of the row is an angle (or the product of two axes), not a length.
inline bool is_angle(const BasicRow& row) {
  return std::visit([](const auto& kind) { return kind.is_angle; }, row);
}

/// Returns whether the row restricts a rotation.
inline bool needs_turns(const BasicRow& row) {
  return std::visit([](const auto& kind) { return kind.needs_turns; }, row);
}

/// Text for the value of a row: "gap along x".
inline std::string row_name(const BasicRow& row) {
  return std::visit([](const auto& kind) { return kind.name(); }, row);
}

} // namespace hydrodae::joint
