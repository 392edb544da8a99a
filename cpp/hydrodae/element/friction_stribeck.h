#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Smooth friction along the free motion of a joint, without states or events.
///
///   f = -g(s') s' / sqrt(s'^2 + s'_0^2) - sigma s'      [N], or [N m] if the motion is a rotation
///   g = F_c + (F_s - F_c) exp(-(s' / s'_s)^2)
///
/// It does not stick: a load F below F_s creeps at about s'_0 F / F_s.
struct FrictionStribeck {
  static constexpr std::string_view type = "friction_stribeck";
  static constexpr std::string_view doc = "Smooth friction along a joint (Coulomb, Stribeck and "
                                          "viscous); creeps where it ought to stick.";
  static constexpr Port port = Port::along_joint;
  static constexpr std::string_view at_rest_only =
      "its damping there is `static` / `creep_rate`, far above that at working rates";
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double static_load = 0.0;
  double creep_rate = 0.0;
  std::optional<double> kinetic_load;
  std::optional<double> stribeck_rate;
  double viscous = 0.0;

  /// The law that the system evaluates.
  struct Law {
    double stick, slip, rate, creep, viscous;

    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      using std::exp, std::sqrt;
      const S &v = *in.v, x = v / S(rate);
      const S g = S(slip) + S(stick - slip) * exp(-(x * x));
      *out.load = -(g / sqrt(v * v + S(creep * creep)) + S(viscous)) * v;
    }
  };
  Law law() const {
    return {static_load, kinetic_load.value_or(static_load),
            stribeck_rate.value_or(10.0 * creep_rate), creep_rate, viscous};
  }

  /// What is wrong with it, if anything.
  std::optional<Fault> fault() const {
    if (kinetic_load && *kinetic_load > static_load)
      return Fault{"kinetic", "the kinetic friction must not be above the static one"};
    return {};
  }

  template <class F = FrictionStribeck> static Fields<F> fields() {
    return {
        {"name", &F::name, "-", "Name of this force in the results.", true},
        {"joint", &F::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &F::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"static", &F::static_load, "N or N m", "Largest load F_s without the viscous part.", true,
         more_than(0)},
        {"creep_rate", &F::creep_rate, "m/s or rad/s",
         "Rate s'_0 below which it is viscous: some thousandth of the rates at work.", true,
         more_than(0)},
        {"kinetic", &F::kinetic_load, "N or N m",
         "Load F_c of fast slip, without the viscous part; default: as `static`.", false,
         at_least(0)},
        {"stribeck_rate", &F::stribeck_rate, "m/s or rad/s",
         "Rate s'_s over which the load falls from `static` to `kinetic`; default: ten times "
         "`creep_rate`.",
         false, more_than(0)},
        {"viscous", &F::viscous, "N s/m or N m s/rad", "Viscous damping sigma.", false,
         at_least(0)},
    };
  }
};

} // namespace hydrodae::element
