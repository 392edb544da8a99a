#pragma once
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "hydrodae/element/friction_loads.h"

namespace hydrodae::element {

/// Smooth friction along the free motion of a joint, without states or events.
///
///   f = -g(s') s' / sqrt(s'^2 + s'_0^2) - sigma s'      [N], or [N m] if the motion is a rotation
///   g = F_c + (F_s - F_c) exp(-(s' / s'_s)^2)
///
/// F_s, F_c are given, or coefficients times the N of a Bearing. It does not stick: a load F below
/// F_s creeps at about s'_0 F / F_s.
struct FrictionStribeck : FrictionLoads {
  static constexpr std::string_view type = "friction_stribeck";
  static constexpr std::string_view doc = "Smooth friction along a joint (Coulomb, Stribeck and "
                                          "viscous); creeps where it should stick.";
  static constexpr Port port = Port::along_joint;
  static constexpr std::string_view at_rest_only = "its damping there is its load of sticking over "
                                                   "`creep_rate`, far above that at working rates";
  double creep_rate = 0.0;
  std::optional<double> stribeck_rate;
  double viscous = 0.0;

  /// Law with derived numbers.
  struct Law {
    SteadyFriction steady;
    double creep;

    /// Dry friction as a load, or as a coefficient.
    template <class S> S dry(const S& v) const {
      using std::sqrt;
      return steady.dry(v) / sqrt(v * v + S(creep * creep)) * v;
    }
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      *out.load = -dry(*in.v) - S(steady.viscous) * *in.v;
    }
    void observe(const In<double>& in, const Out<const double>& out, double* values) const {
      *values = *out.load * *in.v;
    }
  };
  Law law() const {
    return {{stick(), slip(), stribeck_rate.value_or(10.0 * creep_rate), viscous}, creep_rate};
  }

  struct PressedLaw : Law {
    Bearing bearing;
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      *out.load = -this->dry(*in.v) * bearing.load(in.r) - S(this->steady.viscous) * *in.v;
    }
    void observe(const In<double>& in, const Out<const double>& out, double* values) const {
      Law::observe(in, out, values);
      values[1] = bearing.across(in.r);
    }
  };
  PressedLaw pressed_law() const { return {law(), bearing()}; }

  static std::vector<Quantity> channels() { return {friction_power}; }
  static std::shared_ptr<const Elements> list(const std::vector<FrictionStribeck>& forces) {
    return friction_list(forces);
  }

  template <class F = FrictionStribeck> static Fields<F> fields() {
    return FrictionLoads::fields<F>(at_least(0)) +
           Fields<F>{{"creep_rate", &F::creep_rate, "m/s or rad/s",
                      "Rate s'_0 below which it is viscous: some thousandth of the rates at work.",
                      true, more_than(0)},
                     {"stribeck_rate", &F::stribeck_rate, "m/s or rad/s",
                      "Rate s'_s over which the load falls from F_s to F_c; default: ten times "
                      "`creep_rate`.",
                      false, more_than(0)},
                     {"viscous", &F::viscous, "N s/m or N m s/rad", "Viscous damping sigma.", false,
                      at_least(0)}};
  }
};

} // namespace hydrodae::element
