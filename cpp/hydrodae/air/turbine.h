#pragma once
#include <cmath>
#include <limits>
#include <vector>

#include "hydrodae/air/outlet.h"
#include "hydrodae/math/curve.h"

namespace hydrodae::air {

/// Turbine in dimensionless numbers (Falcao, Henriques, Renewable Energy 85 (2016) 1391-1424):
///
///   Psi = p / (rho_in W^2 D^2)            p: drop of pressure, W: speed of rotation [rad/s]
///   m = Phi(Psi) rho_in W D^3
///   T W = eta(|Psi|) p m / rho_in         power that it takes from the air
///
/// Without inertia its speed is constant. With inertia the speed is a state,
///
///   I W' = T - a_w W^2 - T_g(W) - u       a_w: windage
///   T_g = a W^b, or a curve of measured points; u: torque from a controller
struct Turbine : Outlet {
  double diameter = 0.0, speed = 0.0, windage = 0.0, torque = 0.0, torque_exponent = 2.0;
  std::optional<double> inertia;
  std::vector<double> torque_at, torque_load, efficiency_at, efficiency;
  double generator_efficiency = 1.0;
  Curve eta, generator; ///< curves made by `prepare`

  void prepare() {
    if (!efficiency.empty())
      eta = Curve(efficiency_at, efficiency);
    if (!torque_load.empty())
      generator = Curve(torque_at, torque_load);
  }

  std::string_view signal() const { return inertia ? "torque" : "speed"; }
  std::string_view signal_unit() const { return inertia ? "N m" : "rad/s"; }
  double start_signal() const { return inertia ? 0.0 : speed; }

  template <class S> S psi(const S& drop, const Inlet<S>& in) const {
    return drop / (in.density * in.speed * in.speed * S(diameter * diameter));
  }
  template <class S> S mass_flow(const S& phi, const Inlet<S>& in) const {
    return phi * in.density * in.speed * S(diameter * diameter * diameter);
  }
  /// Returns whether its data cover this pressure.
  template <class S> bool reaches(const S& drop, const Inlet<S>& in) const {
    using std::abs;
    return eta.empty() || abs(psi(drop, in)) <= S(efficiency_at.back());
  }
  /// Power that it takes from the air [W].
  template <class S> S power(const S& drop, const S& flow, const Inlet<S>& in) const {
    using std::abs;
    return eta.empty() ? S(0) : S(eta(S(abs(psi(drop, in)))) * drop * flow / in.density);
  }
  /// Torque of the generator, with that of a controller [N m].
  template <class S> S generator_torque(const S& speed_now, const Held& held) const {
    using std::exp, std::log;
    const S own =
        generator.empty()
            ? (torque == 0.0 ? S(0) : S(torque) * exp(S(torque_exponent) * log(speed_now)))
            : generator(speed_now);
    return own + S(held.signal ? *held.signal : 0.0);
  }
  /// Angular acceleration W' [rad/s2].
  template <class S>
  S acceleration(const S& drop, const S& flow, const Inlet<S>& in, const Held& held) const {
    const S& w = in.speed;
    return (power(drop, flow, in) / w - S(windage) * w * w - generator_torque(w, held)) /
           S(*inertia);
  }

  std::optional<Fault> fault() const;
};

/// Keys of every turbine.
template <class O> Fields<O> turbine_fields() {
  return outlet_fields<O>() +
         Fields<O>{
             {"diameter", &O::diameter, "m", "Diameter D of the rotor.", true, more_than(0)},
             {"speed", &O::speed, "rad/s",
              "Speed W of rotation: it stays, or with `inertia` begins so. A controller may write "
              "a "
              "speed that stays.",
              true, more_than(0)},
             {"inertia", &O::inertia, "kg m2",
              "Moment of inertia I of the rotor with the generator; with it the speed is a state.",
              false, more_than(0)},
             {"windage", &O::windage, "N m s2/rad2",
              "Torque a_w W^2 that friction in the air takes.", false, at_least(0)},
             {"torque", &O::torque, "N m (s/rad)^b",
              "Coefficient a of the generator's torque a W^b.", false, at_least(0)},
             {"torque_exponent", &O::torque_exponent, "-", "Its exponent b.", false,
              between(0, 10)},
             {"torque_at", &O::torque_at, "rad/s",
              "Speeds at which the torque of the generator is given instead.", false, at_least(0)},
             {"torque_load", &O::torque_load, "N m", "That torque at these speeds.", false,
              at_least(0)},
             {"efficiency_at", &O::efficiency_at, "-",
              "Dimensionless pressures |Psi| at which the efficiency is given, from 0 on.", false,
              at_least(0)},
             {"efficiency", &O::efficiency, "-",
              "Power at the shaft over p m / rho_in at these; negative where the shaft drives the "
              "air. Without it the shaft has no torque.",
              false, Range{-std::numeric_limits<double>::infinity(), 1.0}},
             {"generator_efficiency", &O::generator_efficiency, "-",
              "Electric power over that at the shaft.", false, between(0, 1)},
         };
}

} // namespace hydrodae::air
