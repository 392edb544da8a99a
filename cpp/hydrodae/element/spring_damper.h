#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Spring and damper between a point of one body and a point of another (or of the ground).
///
///   f = -k (s - s0) - c s' + f0      [N], s the distance of the points [m], f > 0 pushes them
///   apart
///
/// The points are given in the reference pose. The law is not defined where they coincide.
struct SpringDamper {
  static constexpr std::string_view type = "spring_damper";
  static constexpr Port port = Port::along_distance;
  static constexpr std::string_view doc =
      "Spring and damper between points of two bodies: f = -k (s - s0) - c s' + f0, s their "
      "distance.";
  std::string name;
  std::string body_a;
  std::string body_b;
  Vector3 point_a = Vector3::Zero();
  Vector3 point_b = Vector3::Zero();
  double stiffness = 0.0;
  double damping = 0.0;
  double force = 0.0;
  std::optional<double> length; ///< s0; by default the distance in the reference pose

  /// The law that the system evaluates, with s0 known.
  struct Law {
    double stiffness, damping, force, length;

    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      *out.load = S(force) - S(stiffness) * (*in.x - S(length)) - S(damping) * *in.v;
    }
    template <class J> void jacobian(const In<double>&, J& j) const { j << -stiffness, -damping; }
    double energy(const In<double>& in) const {
      const double stretched = *in.x - length;
      return 0.5 * stiffness * stretched * stretched - force * stretched;
    }
  };
  Law law() const {
    return {stiffness, damping, force, length.value_or((point_b - point_a).norm())};
  }

  static Fields<SpringDamper> fields() {
    using D = SpringDamper;
    return {
        {"name", &D::name, "-", "Name of this force in the results.", true},
        {"body_a", &D::body_a, "-", "First body, or ground.", true},
        {"body_b", &D::body_b, "-", "Second body, or ground.", true},
        {"point_a", &D::point_a, "m", "Point of the first body in the reference pose, world axes.",
         true},
        {"point_b", &D::point_b, "m", "Point of the second body in the reference pose, world axes.",
         true},
        {"stiffness", &D::stiffness, "N/m", "Stiffness k.", false, at_least(0)},
        {"damping", &D::damping, "N s/m", "Damping c.", false, at_least(0)},
        {"force", &D::force, "N", "Constant part f0, positive apart."},
        {"length", &D::length, "m",
         "Length s0 at which the spring is slack; default: distance of the points in the reference "
         "pose.",
         false, at_least(0)},
    };
  }
};

} // namespace hydrodae::element
