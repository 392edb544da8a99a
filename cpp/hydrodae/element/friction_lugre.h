#pragma once
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Bristle friction along the free motion of a joint (Canudas de Wit, Olsson, Astrom, Lischinsky,
/// IEEE Trans. Automatic Control 40 (1995) 419-425).
///
///   f = -(sigma_0 z + sigma_1 z' + sigma_2 s')     [N], or [N m] if the motion is a rotation
///   z' = s' - sigma_0 |s'| z / g(s')               z: deflection of the bristles [m or rad]
///   g = F_c + (F_s - F_c) exp(-(s' / s'_s)^2)
///
/// Below F_s the joint creeps by micrometres and comes back: it sticks. Smooth, so no events.
struct FrictionLugre {
  static constexpr std::string_view type = "friction_lugre";
  static constexpr std::string_view doc =
      "Bristle friction (LuGre) along a joint: sticks and slips smoothly, by a state of its own.";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_states = 1;
  static constexpr std::string_view at_rest_only =
      "it sticks there: its bristles are a spring and a damper";
  std::string name;
  std::string joint;
  std::optional<std::string> coordinate;
  double static_load = 0.0;
  double stribeck_rate = 0.0;
  double bristle_stiffness = 0.0;
  double bristle_damping = 0.0;
  std::optional<double> kinetic_load;
  double viscous = 0.0;

  /// The law that the system evaluates.
  struct Law {
    double stick, slip, rate, stiffness, damping, viscous;

    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      using std::abs, std::exp;
      const S &s_dot = *in.v, &z = *in.z, x = s_dot / S(rate);
      const S g = S(slip) + S(stick - slip) * exp(-(x * x));
      const S z_dot = s_dot - S(stiffness) * abs(s_dot) * z / g;
      *out.load = -(S(stiffness) * z + S(damping) * z_dot + S(viscous) * s_dot);
      *out.z_dot = z_dot;
    }
    double energy(const In<double>& in) const { return 0.5 * stiffness * in.z[0] * in.z[0]; }
  };
  Law law() const {
    return {static_load,     kinetic_load.value_or(static_load),
            stribeck_rate,   bristle_stiffness,
            bristle_damping, viscous};
  }

  std::array<Unknown, n_states> unknowns() const {
    return {{{"deflection", "m or rad", static_load / bristle_stiffness, 0.0}}};
  }

  /// What is wrong with it, if anything.
  std::optional<Fault> fault() const {
    if (kinetic_load && *kinetic_load > static_load)
      return Fault{"kinetic", "the kinetic friction must not be above the static one"};
    return {};
  }

  template <class F = FrictionLugre> static Fields<F> fields() {
    return {
        {"name", &F::name, "-", "Name of this force in the results.", true},
        {"joint", &F::joint, "-", "Joint along which it acts.", true},
        {"coordinate", &F::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"static", &F::static_load, "N or N m", "Largest load F_s that sticking holds.", true,
         more_than(0)},
        {"kinetic", &F::kinetic_load, "N or N m",
         "Load F_c of fast slip, without the viscous part; default: as `static`.", false,
         more_than(0)},
        {"stribeck_rate", &F::stribeck_rate, "m/s or rad/s",
         "Rate s'_s over which the load falls from `static` to `kinetic`.", true, more_than(0)},
        {"bristle_stiffness", &F::bristle_stiffness, "N/m or N m/rad", "Stiffness sigma_0.", true,
         more_than(0)},
        {"bristle_damping", &F::bristle_damping, "N s/m or N m s/rad",
         "Damping sigma_1 of the bristles: 2 sqrt(sigma_0 m) lets a mass (or inertia) m stick "
         "without swinging.",
         true, at_least(0)},
        {"viscous", &F::viscous, "N s/m or N m s/rad", "Viscous damping sigma_2.", false,
         at_least(0)},
    };
  }
};

} // namespace hydrodae::element
