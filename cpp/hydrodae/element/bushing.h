#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/linear_wrench.h"

namespace hydrodae::element {

/// Elastic joint between two bodies, or a body and the ground: stiffness and damping of all six
/// relative motions at a point.
///
///   W = W0 - K [d; theta] - C [d'; omega]     on body B, about its point, along the axes of the
///                                             bushing, which body A carries [N; N m]
///
/// d: place of the point of B relative to that of A [m]; theta: rotation vector of B against A
/// [rad]; both are zero in the reference pose. d', omega: relative velocities. A rotation vector is
/// no exact coordinate of a moment: where theta is large or K couples rotations, energy is kept to
/// second order in theta. Beyond half a turn theta continues about its present axis; a rotation
/// without a fixed axis ends the run there.
struct Bushing {
  static constexpr std::string_view type = "bushing";
  static constexpr std::string_view doc =
      "Elastic joint: stiffness and damping of all six relative motions of two bodies at a point.";
  static constexpr Port port = Port::between;
  std::string name;
  std::string body_a;
  std::string body_b;
  Vector3 point = Vector3::Zero();
  std::optional<Vector3> axis, axis_x;
  Matrix6 stiffness = Matrix6::Zero();
  Matrix6 damping = Matrix6::Zero();
  Vector6 pretension = Vector6::Zero();

  LinearWrench law() const { return {pretension, stiffness, damping}; }

  template <class B = Bushing> static Fields<B> fields() {
    return {
        {"name", &B::name, "-", "Name of this force in the results.", true},
        {"body_a", &B::body_a, "-", "First body, or ground: it carries the axes.", true},
        {"body_b", &B::body_b, "-", "Second body, or ground: the load acts on it.", true},
        {"point", &B::point, "m", "Where the bushing is in the reference pose, world axes.", true},
        {"axis", &B::axis, "-", "Its z axis in the reference pose; default: that of the world."},
        {"axis_x", &B::axis_x, "-", "Its x axis in the reference pose, across `axis`."},
        {"stiffness", &B::stiffness, "N/m, N, N m/rad",
         "K: six numbers (diagonal: x, y, z, about x, y, z) or a 6x6 matrix.", true},
        {"damping", &B::damping, "N s/m, N s, N m s/rad",
         "C: six numbers (diagonal) or a 6x6 matrix."},
        {"pretension", &B::pretension, "N, N m", "W0: force and moment in the reference pose."},
    };
  }
};

} // namespace hydrodae::element
