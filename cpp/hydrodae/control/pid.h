#pragma once
#include <algorithm>
#include <cmath>

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

struct PidState {
  bool began = false;
  double error = 0.0, slope = 0.0, integral = 0.0;
};

/// PID controller with a filtered derivative, limits and back-calculation (Astrom, Murray, Feedback
/// Systems, 2nd ed. 2021, sec. 11.5), at sampling instants T apart:
///
///   e = target - input
///   d = Tf / (Tf + T) d + (e - e_before) / (Tf + T)      0 at the first instant
///   v = Kp e + I + Kd d,   u = v within [lower, upper]
///   I += T (Ki e + (u - v) / Tt)                         0 at the start; Tt: tracking time
class PidLaw final : public StatefulLaw<PidState> {
public:
  struct Gains {
    double p = 0.0, i = 0.0, d = 0.0;
    double target = 0.0;
    double period = 0.0, filter_time = 0.0;
    double tracking_time = INFINITY;
    double lower = -INFINITY, upper = INFINITY;
  };

  explicit PidLaw(const Gains& gains) : g_(gains) {}

  /// @param in  controlled channel, and optionally its target
  void sample(double, std::span<const double> in, std::span<double> out) override {
    const double e = (in.size() > 1 ? in[1] : g_.target) - in[0],
                 width = g_.filter_time + g_.period;
    if (state_.began)
      state_.slope = g_.filter_time / width * state_.slope + (e - state_.error) / width;
    const double wanted = g_.p * e + state_.integral + g_.d * state_.slope;
    out[0] = std::clamp(wanted, g_.lower, g_.upper);
    state_.integral += g_.period * (g_.i * e + (out[0] - wanted) / g_.tracking_time);
    state_.error = e;
    state_.began = true;
  }

private:
  Gains g_;
};

struct Pid : Sampled {
  static constexpr std::string_view type = "pid";
  static constexpr std::string_view doc =
      "u = Kp e + Ki int e + Kd e' with e = target - input; within limits.";
  static constexpr Arity arity = of_target;
  double gain_p = 0.0, gain_i = 0.0, gain_d = 0.0, filter_time = 0.0, target = 0.0;
  std::optional<double> lower, upper, tracking_time;

  std::unique_ptr<Law> law(const Place&) const {
    const double own = gain_p != 0.0 && gain_i != 0.0 ? std::abs(gain_p / gain_i) : INFINITY;
    return std::make_unique<PidLaw>(PidLaw::Gains{
        gain_p, gain_i, gain_d, target, period, filter_time, tracking_time.value_or(own),
        lower.value_or(-INFINITY), upper.value_or(INFINITY)});
  }
  std::optional<Fault> fault() const {
    if (lower && upper && *lower > *upper)
      return Fault{"lower", "'lower' is above 'upper'"};
    if ((lower || upper) && gain_i != 0.0 && gain_p == 0.0 && !tracking_time)
      return Fault{"tracking_time",
                   "an integral within limits needs the key 'tracking_time', as there is no gain_p "
                   "to take it from"};
    return {};
  }
  static std::optional<Fault> fault(const Terminals& t) { return target_fault(t); }

  template <class C = Pid> static Fields<C> fields() {
    return usual_fields<C>() +
           Fields<C>{
               {"gain_p", &C::gain_p, "out per in", "Proportional gain Kp."},
               {"gain_i", &C::gain_i, "out per in and s", "Integral gain Ki."},
               {"gain_d", &C::gain_d, "out s per in", "Derivative gain Kd."},
               {"filter_time", &C::filter_time, "s",
                "Time constant of the filter of first order on the derivative.", false,
                at_least(0)},
               {"target", &C::target, "unit of the input",
                "What the input is to be, where no second input gives it."},
               {"lower", &C::lower, "unit of the output", "Least output."},
               {"upper", &C::upper, "unit of the output", "Largest output."},
               {"tracking_time", &C::tracking_time, "s",
                "Time in which the integral follows an output at its limit (back-calculation); "
                "default |Kp / Ki|.",
                false, more_than(0)},
           };
  }
};

} // namespace hydrodae::control
