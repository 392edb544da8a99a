#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Linear power take-off on the relative rotations of two bodies, such as a ball joint with damped
/// roll, pitch and yaw.
///
///   m = -K theta - C omega + u     on body B [N m], along the axes that body A carries
///
/// u is the load from a controller, else zero. theta: rotation vector of B against A [rad], zero in
/// the reference pose; omega: relative angular velocity. Without u the absorbed power is C omega .
/// omega. For rotations about several axes the spring keeps energy to second order in theta. Beyond
/// half a turn theta continues about its present axis, over any number of turns; a rotation without
/// a fixed axis ends the run there.
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

  static constexpr int n_signals = 9;

  /// Law with the signals C, K and u about x, y and z.
  struct Law {
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      for (int k = 0; k < 3; ++k) {
        out.load[k] = S(0);
        out.load[3 + k] = S(in.signals[6 + k]) - S(in.signals[3 + k]) * in.x[3 + k] -
                          S(in.signals[k]) * in.v[3 + k];
      }
    }
    template <class J> void jacobian(const In<double>& in, J& j) const {
      j.setZero();
      for (int k = 0; k < 3; ++k) {
        j(3 + k, 3 + k) = -in.signals[3 + k];
        j(3 + k, 9 + k) = -in.signals[k];
      }
    }
    /// Energy stored in the springs [J], to second order in theta.
    double energy(const In<double>& in) const {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k)
        sum += 0.5 * in.signals[3 + k] * in.x[3 + k] * in.x[3 + k];
      return sum;
    }
  };
  Law law() const { return {}; }

  /// Inputs that a program may change during the run.
  static std::vector<Signal> inputs() {
    return {{"damping.x", "N m s/rad", 0.0},
            {"damping.y", "N m s/rad", 0.0},
            {"damping.z", "N m s/rad", 0.0},
            {"stiffness.x", "N m/rad", 0.0},
            {"stiffness.y", "N m/rad", 0.0},
            {"stiffness.z", "N m/rad", 0.0},
            {"moment.x", "N m"},
            {"moment.y", "N m"},
            {"moment.z", "N m"}};
  }
  std::array<double, n_signals> start_signals() const {
    std::array<double, n_signals> out{};
    for (std::size_t k = 0; k < 3; ++k) {
      out[k] = damping[static_cast<Eigen::Index>(k)];
      out[3 + k] = stiffness[static_cast<Eigen::Index>(k)];
    }
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
