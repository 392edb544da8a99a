#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Power take-off along the free motion of a joint, whose machine follows its set load with a lag
/// of first order.
///
///   T f' = f_a - f
///   f_a = -k (s - s0) - c s' + u,   |f_a| <= F_max     [N], or [N m] if the motion is a rotation
///
/// s is the joint coordinate [m or rad]; u is the load from a controller, else zero. f is a state,
/// zero at the start. The absorbed power is -f s'. The lag turns damping partly into inertia: at
/// frequency w the machine is the impedance (c + k / (i w)) / (1 + i w T).
struct PtoLagged {
  static constexpr std::string_view type = "pto_lagged";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_states = 1;
  static constexpr int n_signals = 4;
  static constexpr std::string_view doc =
      "Power take-off along a joint whose load follows -k (s - s0) - c s' with a lag.";
  static constexpr std::string_view lost =
      "the linear model moves with what lags, but has no figure of the power that it takes";
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double lag = 0.0;
  double stiffness = 0.0, neutral = 0.0, damping = 0.0;
  double load_limit = 0.0;

  const PtoLagged& law() const { return *this; }

  std::array<Unknown, n_states> unknowns() const {
    return {{{"machine_load", "N or N m", 0.01 * load_limit, 0.0, load_limit / lag}}};
  }

  template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
    const double c = in.signals[0], k = in.signals[1], s0 = in.signals[2], u = in.signals[3];
    const S asked = S(u) - S(k) * (*in.x - S(s0)) - S(c) * *in.v, most(load_limit);
    *out.load = *in.z;
    *out.z_dot = ((asked > most ? most : asked < -most ? -most : asked) - *in.z) / S(lag);
  }

  bool lost_at_rest() const { return true; }

  /// Inputs that a program may change during the run.
  static std::vector<Signal> inputs() {
    return {{"damping", "N s/m or N m s/rad", 0.0},
            {"stiffness", "N/m or N m/rad"},
            {"neutral", "m or rad"},
            {"load", "N or N m"}};
  }
  std::array<double, n_signals> start_signals() const { return {damping, stiffness, neutral, 0.0}; }

  template <class P = PtoLagged> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of this force in the results.", true},
        {"joint", &P::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"lag", &P::lag, "s", "Time constant T of the machine.", true, more_than(0, longest_time)},
        {"stiffness", &P::stiffness, "N/m or N m/rad",
         "Stiffness k; negative: it pushes away from `neutral`."},
        {"neutral", &P::neutral, "m or rad", "Joint coordinate s0 at which the spring is slack."},
        {"damping", &P::damping, "N s/m or N m s/rad", "Damping c.", false, at_least(0)},
        {"load_limit", &P::load_limit, "N or N m", "Largest load F_max that is asked for.", true,
         more_than(0)},
    };
  }
};

} // namespace hydrodae::element
