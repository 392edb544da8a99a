#pragma once
/// Curve carried by a body, along which a point of another body slides.
///
/// c(s): natural cubic spline through the given points over the chord length s, going on straight
/// beyond its ends (twice continuously differentiable everywhere). The place of a point d is the s
/// of the nearest point of the curve, an implicit function of d:
///
///   w . c'(s) = 0,   w = d - c(s);     grad s = c' / D,   D = c'.c' - w.c''
///
/// d lies on the curve where n_1(s) . w = n_2(s) . w = 0; n_1, n_2 are splines through unit vectors
/// across the curve that turn about it as little as they can. All vectors in the axes of the
/// carrying body [m].

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/math/rotation.h"

namespace hydrodae::joint {

/// The value of a scalar without its derivative.
inline double value_of(double x) { return x; }
template <class S> double value_of(const S& x) { return x.a; }

/// A function of the point d with its gradient, axes of the carrying body.
template <class S> struct PointFunction {
  S value;
  Vec3<S> gradient;
};

class Path {
public:
  /// Reason why these points are no path, or nothing: fewer than two, equal neighbours, sharp
  /// bends, or a curve that returns near itself, so that its nearest point is not unique.
  static std::optional<std::string> flaw(const std::vector<Vector3>& points);

  /// @param points  points without a flaw
  explicit Path(const std::vector<Vector3>& points);

  /// Arc length from the first point to the last [m]
  double length() const { return samples_.back().arc; }

  /// Distance n_i . w of d from the curve [m], i = 0, 1.
  template <class S> PointFunction<S> across(int i, const Vec3<S>& d) const;
  Matrix3 across_hessian(int i, const Vector3& d) const;

  /// Arc length from the first point to the place of d [m].
  template <class S> PointFunction<S> arc(const Vec3<S>& d) const;
  Matrix3 arc_hessian(const Vector3& d) const;

  /// Point and unit tangent at an arc length [m].
  std::array<Vector3, 2> at_arc(double arc) const;

private:
  static constexpr int per_piece = 4; ///< samples in each piece of the spline
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  template <class S> using Vec9 = Eigen::Matrix<S, 9, 1>;

  /// Cubic polynomial of (c, n_1, n_2) in s - start; the first and the last piece are the straight
  /// ends.
  struct Piece {
    double start = 0.0;
    std::array<Vector9, 4> coefficient;
  };
  struct Sample {
    double s = 0.0, arc = 0.0;
    Vector3 point;
  };
  /// (c, n_1, n_2) and three derivatives by s.
  template <class S> using Jet = std::array<Vec9<S>, 4>;
  /// Place of d on the curve, with derived values.
  template <class S> struct Place {
    S s, D;
    Jet<S> at;
    Vec3<S> w, gradient;
    Vec3<S> curve(int order) const { return at[order].template head<3>(); }
    Vec3<S> normal(int i, int order) const { return at[order].template segment<3>(3 + 3 * i); }
  };

  const Piece& piece(double s) const;
  template <class S> Jet<S> jet(const S& s) const;
  double nearest(const Vector3& d) const;
  double arc_at(double s) const;
  template <class S> Place<S> place(const Vec3<S>& d) const;
  Matrix3 place_hessian(const Place<double>& p) const;

  std::vector<double> knots_;
  std::vector<Piece> pieces_;
  std::vector<Sample> samples_;
};

template <class S> Path::Jet<S> Path::jet(const S& s) const {
  const Piece& p = piece(value_of(s));
  const S x = s - S(p.start);
  const Vec9<S> a = p.coefficient[0].cast<S>(), b = p.coefficient[1].cast<S>(),
                c = p.coefficient[2].cast<S>(), d = p.coefficient[3].cast<S>();
  return {Vec9<S>(a + x * (b + x * (c + x * d))), Vec9<S>(b + x * (S(2) * c + S(3) * x * d)),
          Vec9<S>(S(2) * c + S(6) * x * d), Vec9<S>(S(6) * d)};
}

template <class S> Path::Place<S> Path::place(const Vec3<S>& d) const {
  const Vector3 value(value_of(d[0]), value_of(d[1]), value_of(d[2]));
  Place<S> p;
  p.s = S(nearest(value));
  // One more Newton step, which also gives the derivatives.
  const auto complete = [&] {
    p.at = jet<S>(p.s);
    p.w = d - p.curve(0);
    p.D = dot<S>(p.curve(1), p.curve(1)) - dot<S>(p.w, p.curve(2));
  };
  complete();
  p.s += dot<S>(p.w, p.curve(1)) / p.D;
  complete();
  p.gradient = p.curve(1) / p.D;
  return p;
}

template <class S> PointFunction<S> Path::across(int i, const Vec3<S>& d) const {
  const Place<S> p = place<S>(d);
  const Vec3<S> n = p.normal(i, 0);
  const S by_s = dot<S>(p.normal(i, 1), p.w) - dot<S>(n, p.curve(1));
  return {dot<S>(n, p.w), Vec3<S>(n + by_s * p.gradient)};
}

template <class S> PointFunction<S> Path::arc(const Vec3<S>& d) const {
  using std::sqrt;
  const Place<S> p = place<S>(d);
  const S speed = sqrt(dot<S>(p.curve(1), p.curve(1)));
  const double s = value_of(p.s);
  return {S(arc_at(s)) + speed * (p.s - S(s)), Vec3<S>(speed * p.gradient)};
}

} // namespace hydrodae::joint
