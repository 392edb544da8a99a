#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"
#include "hydrodae/math/curve.h"

namespace hydrodae::element {

/// Power take-off along the free motion of a joint: a sum of parts, within limits.
///
///   f = -k (s - s0) - F_k(s) - c |s'|^(n-1) s' - F_c(s') - F_0 s' / sqrt(s'^2 + s'_0^2) + u
///   |f| <= F_max,  |f s'| <= P_max                  [N], or [N m] if the motion is a rotation
///
/// F_k and F_c: curves through measured points, straight beyond their ends. u: load from a
/// controller, else zero. The absorbed power P = -f s' gives the electric power eta P; for P < 0
/// the machine drives the device and takes the electric power P / eta_m.
struct PtoGeneral {
  static constexpr std::string_view type = "pto_general";
  static constexpr std::string_view doc =
      "Power take-off along a joint: springs and dampers linear, by a power or by measured points, "
      "constant load, limits of load and power, efficiencies.";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_signals = 4, n_kinks = 1;
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double stiffness = 0.0, neutral = 0.0;
  double damping = 0.0, exponent = 1.0;
  double constant = 0.0;
  std::optional<double> reversal_rate;
  std::vector<double> spring_at, spring_load, damper_at, damper_load;
  std::optional<double> load_limit, power_limit;
  double efficiency = 1.0, motor_efficiency = 1.0;

  /// Law with derived numbers.
  struct Law {
    double n, F0, rate0, most, power, eta, eta_motor;
    Curve spring, damper;

    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      const S f = wanted(in), limit = limit_at(*in.v);
      *out.load = in.beyond(0, room(f, limit)) ? f : f > S(0) ? limit : -limit;
    }

    /// Switching function of the limits.
    void kinks(const In<double>& in, double* out) const {
      *out = room(wanted(in), limit_at(*in.v));
    }

    /// Unused part of the limit, 1 - |f| / limit.
    template <class S> static S room(const S& f, const S& limit) {
      using std::abs;
      return limit < S(INFINITY) ? S(1) - abs(f) / limit : S(1);
    }

    /// Load without limits.
    template <class S> S wanted(const In<S>& in) const {
      using std::abs, std::exp, std::log, std::sqrt;
      const double c = in.signals[0], k = in.signals[1], s0 = in.signals[2];
      const S &s = *in.x, &v = *in.v, speed = abs(v);
      S f = S(in.signals[3]) - S(k) * (s - S(s0));
      if (c > 0.0)
        f -= n == 1.0 ? S(c) * v : speed > S(0.0) ? S(c) * exp(S(n - 1.0) * log(speed)) * v : S(0);
      if (F0 > 0.0)
        f -= S(F0) * v / sqrt(v * v + S(rate0 * rate0));
      if (!spring.empty())
        f -= spring(s);
      if (!damper.empty())
        f -= damper(v);
      return f;
    }

    template <class S> S limit_at(const S& rate) const {
      using std::abs;
      const S speed = abs(rate);
      return speed * S(most) > S(power) ? S(power) / speed : S(most);
    }

    /// Energy of the springs; limits do not change it.
    double energy(const In<double>& in) const {
      const double d = *in.x - in.signals[2];
      double sum = 0.5 * in.signals[1] * d * d;
      if (!spring.empty())
        sum += spring.area(*in.x) - spring.area(0.0);
      return sum;
    }

    void observe(const In<double>& in, const Out<const double>& out, double* values) const {
      const double P = -*out.load * *in.v;
      values[0] = P > 0.0 ? eta * P : P / eta_motor;
    }
  };
  Law law() const {
    const auto curve = [](const std::vector<double>& x, const std::vector<double>& y) {
      return x.empty() ? Curve() : Curve(x, y);
    };
    return {exponent,
            constant,
            reversal_rate.value_or(0.0),
            load_limit.value_or(INFINITY),
            power_limit.value_or(INFINITY),
            efficiency,
            motor_efficiency,
            curve(spring_at, spring_load),
            curve(damper_at, damper_load)};
  }

  /// Inputs that a program may change during the run.
  static std::vector<Signal> inputs() {
    return {{"damping", "N (s/m)^n or N m (s/rad)^n", 0.0},
            {"stiffness", "N/m or N m/rad"},
            {"neutral", "m or rad"},
            {"load", "N or N m"}};
  }
  std::array<double, n_signals> start_signals() const { return {damping, stiffness, neutral, 0.0}; }

  static std::vector<Quantity> channels() {
    return {{"electric_power", "W", "Power delivered, after the losses of the machine."}};
  }

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const {
    if (const std::string_view wrong = Curve::fault(spring_at, spring_load); !wrong.empty())
      return Fault{"spring_at", "'spring_at' " + std::string(wrong) + " 'spring_load'"};
    if (const std::string_view wrong = Curve::fault(damper_at, damper_load); !wrong.empty())
      return Fault{"damper_at", "'damper_at' " + std::string(wrong) + " 'damper_load'"};
    if (constant > 0.0 && !reversal_rate)
      return Fault{"reversal_rate", "'constant' needs the key 'reversal_rate'"};
    return {};
  }

  template <class P = PtoGeneral> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of this force in the results.", true},
        {"joint", &P::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"stiffness", &P::stiffness, "N/m or N m/rad",
         "Stiffness k; negative: it pushes away from `neutral`."},
        {"neutral", &P::neutral, "m or rad", "Joint coordinate s0 at which this spring is slack."},
        {"damping", &P::damping, "N (s/m)^n or N m (s/rad)^n", "Damping c.", false, at_least(0)},
        {"exponent", &P::exponent, "-", "Exponent n of the damping: 1 linear, 2 quadratic.", false,
         between(1, 10)},
        {"constant", &P::constant, "N or N m", "Load F_0 against the motion, whatever its rate.",
         false, at_least(0)},
        {"reversal_rate", &P::reversal_rate, "m/s or rad/s",
         "Rate s'_0 over which `constant` changes its sign.", false, more_than(0)},
        {"spring_at", &P::spring_at, "m or rad", "Joint coordinates, ascending, of `spring_load`."},
        {"spring_load", &P::spring_load, "N or N m", "Loads F_k of a spring there, back for > 0."},
        {"damper_at", &P::damper_at, "m/s or rad/s", "Rates, ascending, of `damper_load`."},
        {"damper_load", &P::damper_load, "N or N m", "Loads F_c of a damper there, back for > 0."},
        {"load_limit", &P::load_limit, "N or N m", "Largest load F_max of all together.", false,
         more_than(0)},
        {"power_limit", &P::power_limit, "W", "Largest power P_max, either way.", false,
         more_than(0)},
        {"efficiency", &P::efficiency, "-", "eta of absorbed power.", false, between(0, 1)},
        {"motor_efficiency", &P::motor_efficiency, "-", "eta_m of power given to the device.",
         false, Range{0.0, 1.0, true}},
    };
  }
};

} // namespace hydrodae::element
