#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::element {

/// Linear power take-off on the relative rotations of two bodies, as at a ball joint whose roll,
/// pitch and yaw are each damped.
///
///   m = -K theta - C omega     on body B [N m], along the axes that body A carries
///
/// theta: rotation vector of B against A [rad], zero in the reference pose; omega: relative angular
/// velocity. Power C omega . omega is absorbed. About several axes at once the spring keeps energy
/// to second order in theta.
struct PtoRotary {
  static constexpr std::string_view type = "pto_rotary";
  static constexpr std::string_view doc = "Linear power take-off on relative roll, pitch and yaw "
                                          "of two bodies: m = -K theta - C omega.";
  static constexpr Port port = Port::between;
  std::string name;
  std::string body_a;
  std::string body_b;
  Vector3 point = Vector3::Zero();
  std::optional<Vector3> axis, axis_x;
  Vector3 stiffness = Vector3::Zero();
  Vector3 damping = Vector3::Zero();

  LinearWrench law() const {
    LinearWrench out;
    out.stiffness.diagonal().tail<3>() = stiffness;
    out.damping.diagonal().tail<3>() = damping;
    return out;
  }

  template <class P = PtoRotary> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of this force in the results.", true},
        {"body_a", &P::body_a, "-", "First body, or ground: it carries the axes.", true},
        {"body_b", &P::body_b, "-", "Second body, or ground: the moment acts on it.", true},
        {"axis", &P::axis, "-", "Its z axis in the reference pose; default: that of the world."},
        {"axis_x", &P::axis_x, "-", "Its x axis in the reference pose, across `axis`."},
        {"stiffness", &P::stiffness, "N m/rad", "K about x, y and z: roll, pitch, yaw.", false,
         at_least(0)},
        {"damping", &P::damping, "N m s/rad", "C about x, y and z.", false, at_least(0)},
    };
  }
};

} // namespace hydrodae::element
