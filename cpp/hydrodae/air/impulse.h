#pragma once
#include "hydrodae/air/turbine.h"

namespace hydrodae::air {

/// Turbine whose flow is a power of the pressure, Phi = c |Psi|^e sign Psi: e is about 0.5 for
/// axial impulse turbines, 0.6 for biradial ones. Below Psi_l it is linear:
///
///   Phi = c Psi (Psi^2 + Psi_l^2)^((e - 1) / 2)
struct PowerTurbine : Turbine {
  double coefficient = 0.0, exponent = 0.0, laminar = 1e-4;

  template <class S> S flow(const S& drop, const Inlet<S>& in, const Held&) const {
    using std::exp, std::log;
    const S at = psi(drop, in);
    const S size = log(at * at + S(laminar * laminar));
    return mass_flow(S(S(coefficient) * at * exp(S(0.5 * (exponent - 1.0)) * size)), in);
  }
};

template <class O> Fields<O> power_fields(bool own) {
  return turbine_fields<O>() +
         Fields<O>{
             {"coefficient", &O::coefficient, "-", "c of Phi = c |Psi|^e.", own, more_than(0)},
             {"exponent", &O::exponent, "-", "e of Phi = c |Psi|^e.", own, {0.0, 1.0, true}},
             {"laminar", &O::laminar, "-",
              "Dimensionless pressure Psi_l below which the flow is linear: it removes the endless "
              "slope at zero.",
              false, more_than(0)},
         };
}

struct Impulse : PowerTurbine {
  static constexpr std::string_view type = "impulse";
  static constexpr std::string_view doc =
      "An axial impulse turbine: its flow is a power of the drop of pressure.";
  template <class O = Impulse> static Fields<O> fields() { return power_fields<O>(true); }
};

/// Biradial turbine: Phi = 0.195 Psi^0.6, as measured at a plant.
struct Biradial : PowerTurbine {
  static constexpr std::string_view type = "biradial";
  static constexpr std::string_view doc =
      "A biradial turbine: its flow goes with the power 0.6 of the drop of pressure.";
  Biradial() {
    coefficient = 0.195;
    exponent = 0.6;
  }
  template <class O = Biradial> static Fields<O> fields() { return power_fields<O>(false); }
};

} // namespace hydrodae::air
