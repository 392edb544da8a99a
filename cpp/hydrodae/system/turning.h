#pragma once
/// Rotations as vectors for laws and results, with full turns counted.
///
/// A rotation by the angle a about the axis e equals one by a + 2 pi k. The vector nearest to the
/// prediction from the last accepted step and the rates is taken, so that it continues beyond half
/// a turn. Turns are counted while the axis stays; where it does not, a full turn has no direction
/// (run/guard_turns.cpp).

#include <cmath>

#include "hydrodae/system/regime.h"

namespace hydrodae::system {

using element::BodyState;

/// Poses of the two bodies of a joint at its markers; the ground is body -1.
template <class S>
joint::Geometry<S> joint_geometry(const JointData& j, const std::vector<BodyState<S>>& states) {
  const Vec3<S> origin = Vec3<S>::Zero();
  const Mat3<S> identity = Mat3<S>::Identity();
  const bool a = j.A.body >= 0, b = j.B.body >= 0;
  return joint::geometry<S>(j.B, a ? states[j.A.body].r : origin, a ? states[j.A.body].R : identity,
                            b ? states[j.B.body].r : origin, b ? states[j.B.body].R : identity);
}

/// Velocity (v_A, w_A, v_B, w_B) of the bodies of a joint.
template <class S>
joint::Vec12<S> joint_velocity(const JointData& j, const std::vector<BodyState<S>>& states) {
  joint::Vec12<S> u = joint::Vec12<S>::Zero();
  if (j.A.body >= 0)
    u.template head<6>() << states[j.A.body].v, states[j.A.body].w;
  if (j.B.body >= 0)
    u.template tail<6>() << states[j.B.body].v, states[j.B.body].w;
  return u;
}

/// Quaternion product p o conj(q), each (w, x, y, z).
template <class S> Vec4<S> over(const Vec4<S>& p, const Vec4<S>& q) {
  const Vec3<S> a = p.template tail<3>(), b = -q.template tail<3>();
  Vec4<S> out;
  out << p[0] * q[0] - dot<S>(a, b), p[0] * b + q[0] * a + cross<S>(a, b);
  return out;
}

/// Values of a vector without derivatives.
template <class S> Vector3 values(const Vec3<S>& v) {
  return {joint::value_of(v[0]), joint::value_of(v[1]), joint::value_of(v[2])};
}

/// Rotation vector of a quaternion of any norm, on the turn nearest to `near` [rad].
template <class S> Vec3<S> nearest_rotation(const Vec4<S>& p, const Vector3& near) {
  using std::sqrt;
  constexpr double lost = 1e-8; // sqrt of the rounding error: below it, `near` gives the axis
  const Vec3<S> least = rotation_vector<S>(p);
  const Vector3 value = values<S>(least);
  const double angle = value.norm();
  const Vector3 axis = angle > lost ? Vector3(value / angle) : near.normalized();
  const double more = std::round((near.dot(axis) - angle) / (2.0 * pi));
  if (more == 0.0 || !std::isfinite(more))
    return least;
  if (angle > lost)
    return (S(1) + S(2.0 * pi * more) / sqrt(dot<S>(least, least))) * least;
  return least + Vec3<S>((2.0 * pi * more * axis).template cast<S>());
}

/// Quaternion of a followed rotation, of any norm.
template <class S>
Vec4<S> attitude_of(const System& s, const RotationData& r,
                    const std::vector<BodyState<S>>& states) {
  if (r.joint < 0)
    return over<S>(states[r.body].p, r.turn.template cast<S>());
  const JointData& j = s.joints[r.joint];
  const Mat3<S> turned = j.A.axes.transpose().template cast<S>() * joint_geometry<S>(j, states).N *
                         j.B.axes.template cast<S>();
  return quaternion_of<S>(turned);
}

/// Angular velocity of a followed rotation, in the axes of its vector [rad/s].
template <class S>
Vec3<S> spin_of(const System& s, const RotationData& r, const std::vector<BodyState<S>>& states) {
  if (r.joint < 0)
    return states[r.body].R * states[r.body].w;
  const JointData& j = s.joints[r.joint];
  const joint::Vec12<S> u = joint_velocity<S>(j, states);
  return j.A.axes.transpose().template cast<S>() *
         (joint_geometry<S>(j, states).N * u.template tail<3>() - u.template segment<3>(3));
}

/// Coordinates of all motions near the start, then vectors of all rotations there: for bodies up to
/// a full turn, as placed; between two bodies, or over a mean yaw, up to half a turn.
std::vector<double> start_turns(const System& system);

/// Finds the rotations to follow: those of free bodies, those that laws read, and those between
/// markers. Call it again after elements were added.
void follow_rotations(System& system);

} // namespace hydrodae::system
