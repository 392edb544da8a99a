#pragma once
/// Free motions of joints: value, gradient and curvature (rows.h has the constraint rows).

#include "hydrodae/joint/types.h"

namespace hydrodae::joint {

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

/// Gradient of s where the points coincide and separate with the velocities u (12 numbers): its
/// limit along their motion; zero at rest.
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

/// Arc length from the first point of the curve to its point nearest to B [m].
template <class S> Row<S> travel_row(const Marker& A, const Marker& B, const Geometry<S>& g) {
  const PointFunction<S> f = A.path->arc<S>(g.e);
  return {f.value, place_gradient<S>(f.gradient, B, g)};
}

/// Angle of a motion that is a rotation.
constexpr TurnAngle turn_angle(const FreeMotion& motion) {
  return motion.kind == FreeMotion::Kind::turns ? turn_about_a(motion.axis)
                                                : turn_about_b(motion.axis);
}

/// The coordinate of a free motion: displacement a_i . (B - A); distance |B - A|; arc length; or
/// angle about an axis of marker A or B.
template <class S>
Row<S> motion_row(const FreeMotion& motion, const Marker& A, const Marker& B,
                  const Geometry<S>& g) {
  if (motion.kind == FreeMotion::Kind::slides)
    return SpanRow{motion.axis}.at<S>(A, B, {}, g);
  if (motion.kind == FreeMotion::Kind::stretches)
    return stretch_row<S>(A, B, g);
  if (motion.kind == FreeMotion::Kind::travels)
    return travel_row<S>(A, B, g);
  return turn_angle(motion).at<S>(A, B, g);
}

/// Curvature of the coordinate of a free motion (numbers only).
Matrix12 motion_curvature(const FreeMotion& motion, const Marker& A, const Marker& B,
                          const Geometry<double>& g);

} // namespace hydrodae::joint
