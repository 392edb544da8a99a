#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Linear power take-off along the free motion of a joint.
///
///   f(t) = -k (s(t - tau) - s0) - c s'(t - tau) + u    [N], or [N m] if the motion is a rotation
///
/// s is the joint coordinate [m or rad], tau a pure delay [s]; before the start the joint is at
/// rest. u is the load from a controller, else zero. Without delay and u the absorbed power is P =
/// c s'^2 >= 0 [W]; otherwise it is -f(t) s'(t) and may have either sign.
struct PtoLinear {
  static constexpr std::string_view type = "pto_linear";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_signals = 4;
  static constexpr std::string_view doc =
      "Linear power take-off along a joint: f = -k (s - s0) - c s'.";
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double damping = 0.0;
  double stiffness = 0.0;
  double neutral = 0.0;
  double delay = 0.0;

  /// Law to evaluate: this struct.
  const PtoLinear& law() const { return *this; }

  template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
    const double c = in.signals[0], k = in.signals[1], s0 = in.signals[2], u = in.signals[3];
    *out.load = S(-k) * (*in.x - S(s0)) - S(c) * *in.v + S(u);
  }
  template <class J> void jacobian(const In<double>& in, J& j) const {
    j << -in.signals[1], -in.signals[0];
  }

  /// Energy stored in the spring [J].
  double energy(const In<double>& in) const {
    const double stretched = *in.x - in.signals[2];
    return 0.5 * in.signals[1] * stretched * stretched;
  }

  /// Inputs that a program may change during the run.
  static std::vector<Signal> inputs() {
    return {{"damping", "N s/m or N m s/rad", 0.0},
            {"stiffness", "N/m or N m/rad"},
            {"neutral", "m or rad"},
            {"load", "N or N m"}};
  }
  std::array<double, n_signals> start_signals() const { return {damping, stiffness, neutral, 0.0}; }

  template <class P = PtoLinear> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of this force in the results.", true},
        {"joint", &P::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"damping", &P::damping, "N s/m or N m s/rad", "Damping c.", false, at_least(0)},
        {"stiffness", &P::stiffness, "N/m or N m/rad",
         "Stiffness k; negative: it pushes away from `neutral`, as reactive control does."},
        {"neutral", &P::neutral, "m or rad", "Joint coordinate s0 at which the spring is slack."},
        {"delay", &P::delay, "s",
         "Pure delay tau of damper and spring: they act on the coordinate as it was tau ago.",
         false, at_least(0, longest_time)},
    };
  }
};

} // namespace hydrodae::element
