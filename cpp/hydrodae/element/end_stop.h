#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Compliant end stops along the free motion of a joint (Hunt, Crossley, J. Appl. Mech. 42 (1975)
/// 440-445).
///
///   f = -max(0, k u^n (1 + d u') + c u') r(u)     [N], or [N m] if the motion is a rotation
///
/// u > 0: depth of s beyond `upper`, and likewise beyond `lower`. The load never pulls. Within the
/// first `width` the stiffness grows gradually, r = 3 x^2 - 2 x^3 with x = u / width; beyond it r =
/// 1. With c = 0 an impact at low speed v returns the part 1 - 2 d v / 3 of the speed. Both stops
/// are equal.
struct EndStop {
  static constexpr std::string_view type = "end_stop";
  static constexpr std::string_view doc =
      "Compliant end stops along a joint: a hardening spring with Hunt-Crossley damping.";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_kinks = 2;
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  std::optional<double> lower, upper, lower_angle, upper_angle;
  double stiffness = 0.0;
  double exponent = 1.5;
  double damping = 0.0, viscous = 0.0;
  double width = 0.0;

  /// Law with derived numbers.
  struct Law {
    double lower, upper, stiffness, exponent, damping, viscous, width;

    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      const S above = *in.x - S(upper), below = S(lower) - *in.x;
      *out.load = S(0);
      if (in.beyond(0, pushes(above, *in.v)))
        *out.load -= push(above, *in.v);
      if (in.beyond(1, pushes(below, -*in.v)))
        *out.load += push(below, -*in.v);
    }

    /// Energy of the spring: int k u^n r(u) du.
    double energy(const In<double>& in) const {
      const double u = depth(*in.x), n = exponent;
      const double from = std::min(u, width);
      double sum = stiffness * (std::pow(u, n + 1.0) - std::pow(from, n + 1.0)) / (n + 1.0);
      if (from > 0.0) {
        const double x = from / width;
        sum +=
            stiffness * std::pow(from, n + 1.0) * x * x * (3.0 / (n + 3.0) - 2.0 * x / (n + 4.0));
      }
      return sum;
    }

    void observe(const In<double>& in, const Out<const double>&, double* values) const {
      values[0] = depth(*in.x);
    }

    void kinks(const In<double>& in, double* out) const {
      out[0] = pushes(*in.x - upper, *in.v);
      out[1] = pushes(lower - *in.x, -*in.v);
    }

  private:
    double depth(double s) const { return std::max({s - upper, lower - s, 0.0}); }

    /// Switching function [m or rad]: depth beyond the point where the stop begins to push. That
    /// point needs contact and a load that does not pull.
    template <class S> S pushes(const S& u, const S& rate) const {
      if (!(u > S(0)))
        return u > S(-INFINITY) ? u : S(-1); // no stop on this side
      const S pressed = load(u, rate) / S(stiffness);
      return pressed < u ? pressed : u;
    }

    /// Load without the factor r of the width, continued as an odd function to u < 0.
    template <class S> S load(const S& u, const S& rate) const {
      using std::abs, std::exp, std::log;
      const S size = abs(u);
      S spring = S(stiffness) * u;
      if (exponent != 1.0)
        spring = size > S(0) ? spring * exp(S(exponent - 1.0) * log(size)) : S(0);
      return spring * (S(1) + S(damping) * rate) + S(viscous) * rate;
    }

    template <class S> S push(const S& u, const S& rate) const {
      const S f = load(u, rate);
      if (!(u < S(width)))
        return f;
      const S x = u > S(0) ? u / S(width) : S(0);
      return f * x * x * (S(3) - S(2) * x);
    }
  };
  Law law() const {
    return {lower ? *lower : lower_angle.value_or(-INFINITY),
            upper ? *upper : upper_angle.value_or(INFINITY),
            stiffness,
            exponent,
            damping,
            viscous,
            width};
  }

  static std::vector<Quantity> channels() {
    return {{"penetration", "m or rad", "How far the joint is beyond the stop."}};
  }

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const {
    const Law own = law();
    if (lower && lower_angle)
      return Fault{"lower_deg", "write either 'lower' or 'lower_deg'"};
    if (upper && upper_angle)
      return Fault{"upper_deg", "write either 'upper' or 'upper_deg'"};
    if (!std::isfinite(own.lower) && !std::isfinite(own.upper))
      return Fault{"upper", "a stop needs 'lower' or 'upper' (of an angle lower_deg, upper_deg)"};
    if (own.lower > own.upper)
      return Fault{lower ? "lower" : "lower_deg", "the lower stop must be below the upper one"};
    return {};
  }

  template <class E = EndStop> static Fields<E> fields() {
    return {
        {"name", &E::name, "-", "Name of this force in the results.", true},
        {"joint", &E::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &E::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"lower", &E::lower, "m", "Coordinate below which the stop pushes back."},
        {"upper", &E::upper, "m", "Coordinate above which it does."},
        {"lower_deg", &E::lower_angle, "deg", "The same of a joint that turns."},
        {"upper_deg", &E::upper_angle, "deg", "The same of a joint that turns."},
        {"stiffness", &E::stiffness, "N/m^n or N m/rad^n", "Stiffness k.", true, more_than(0)},
        {"exponent", &E::exponent, "-", "Exponent n: 1 a spring, 1.5 round bodies that touch.",
         false, between(1, 10)},
        {"damping", &E::damping, "s/m or s/rad",
         "Damping d: at a low speed v the part 1 - 2 d v / 3 of it is given back.", false,
         at_least(0)},
        {"viscous", &E::viscous, "N s/m or N m s/rad", "Damping c from the first touch on, linear.",
         false, at_least(0)},
        {"width", &E::width, "m or rad", "Depth over which the stop gets hard.", false,
         at_least(0)},
    };
  }
};

} // namespace hydrodae::element
