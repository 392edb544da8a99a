#pragma once
#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "hydrodae/element/friction_loads.h"

namespace hydrodae::element {

/// Bristle friction along the free motion of a joint (Canudas de Wit, Olsson, Astrom, Lischinsky,
/// IEEE Trans. Automatic Control 40 (1995) 419-425).
///
///   f = -(sigma_0 z + sigma_1 z' + sigma_2 s')     [N], or [N m] if the motion is a rotation
///   z' = s' - sigma_0 |s'| z / g(s')               z: deflection of the bristles [m or rad]
///   g = F_c + (F_s - F_c) exp(-(s' / s'_s)^2)
///
/// F_s, F_c are given, or coefficients times the N of a Bearing. Below F_s the joint creeps by
/// micrometres and comes back: it sticks. Smooth, so no events.
struct FrictionLugre : FrictionLoads {
  static constexpr std::string_view type = "friction_lugre";
  static constexpr std::string_view doc =
      "Bristle friction (LuGre) along a joint: sticks and slips smoothly, by a state of its own.";
  static constexpr Port port = Port::along_joint;
  static constexpr int n_states = 1;
  static constexpr std::string_view at_rest_only =
      "it sticks there: its bristles are a spring and a damper";
  double stribeck_rate = 0.0;
  double bristle_stiffness = 0.0;
  double bristle_damping = 0.0;
  double viscous = 0.0;

  /// Law with derived numbers.
  struct Law {
    SteadyFriction steady;
    double stiffness, damping;

    template <class S> void slip(const In<S>& in, const Out<S>& out, const S& g) const {
      using std::abs;
      const S &s_dot = *in.v, &z = *in.z;
      const S z_dot = s_dot - S(stiffness) * abs(s_dot) * z / g;
      *out.load = -(S(stiffness) * z + S(damping) * z_dot + S(steady.viscous) * s_dot);
      *out.z_dot = z_dot;
    }
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      slip(in, out, steady.dry(*in.v));
    }
    double energy(const In<double>& in) const { return 0.5 * stiffness * in.z[0] * in.z[0]; }
    void observe(const In<double>& in, const Out<const double>& out, double* values) const {
      *values = *out.load * *in.v;
    }
  };
  Law law() const {
    return {{stick(), slip(), stribeck_rate, viscous}, bristle_stiffness, bristle_damping};
  }

  struct PressedLaw : Law {
    Bearing bearing;
    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      const S g = this->steady.dry(*in.v) * bearing.load(in.r);
      this->slip(in, out, g);
    }
    void observe(const In<double>& in, const Out<const double>& out, double* values) const {
      Law::observe(in, out, values);
      values[1] = bearing.across(in.r);
    }
  };
  PressedLaw pressed_law() const { return {law(), bearing()}; }

  static std::vector<Quantity> channels() { return {friction_power}; }
  static std::shared_ptr<const Elements> list(const std::vector<FrictionLugre>& forces) {
    return friction_list(forces);
  }

  std::array<Unknown, n_states> unknowns() const {
    return {{{"deflection", "m or rad", usual_load() / bristle_stiffness, 0.0}}};
  }

  template <class F = FrictionLugre> static Fields<F> fields() {
    return FrictionLoads::fields<F>(more_than(0)) +
           Fields<F>{
               {"stribeck_rate", &F::stribeck_rate, "m/s or rad/s",
                "Rate s'_s over which the load falls from F_s to F_c.", true, more_than(0)},
               {"bristle_stiffness", &F::bristle_stiffness, "N/m or N m/rad", "Stiffness sigma_0.",
                true, more_than(0)},
               {"bristle_damping", &F::bristle_damping, "N s/m or N m s/rad",
                "Damping sigma_1 of the bristles: 2 sqrt(sigma_0 m) lets a mass (or inertia) m "
                "stick without swinging.",
                true, at_least(0)},
               {"viscous", &F::viscous, "N s/m or N m s/rad", "Viscous damping sigma_2.", false,
                at_least(0)}};
  }
};

} // namespace hydrodae::element
