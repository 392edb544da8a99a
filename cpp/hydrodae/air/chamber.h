#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"

namespace hydrodae::air {

/// Air outside, into which outlets lead.
struct Atmosphere {
  double pressure = 101325.0; ///< p_a, absolute [Pa]
  /// Density rho_a [kg/m3]; both for the standard atmosphere at sea level
  double density = 1.225;
};

/// Table [[chamber]]: air compressed by pistons. Its mass M [kg] is a state.
///
///   V = V0 - sum_k S_k s_k                      s_k: coordinates of its pistons
///   (p_a + p) / p_a = (rho / rho_a)^n           rho = M / V;  n: exponent
///   M' = - sum of the mass flows of its outlets
///   load on s_k: -S_k p                         p: gauge pressure [Pa]
///
/// (Falcao, Henriques, Renewable Energy 85 (2016) 1391-1424.) With the mass as state, a closed
/// chamber keeps p V^n, and a network its air, to rounding. The energy stored against the
/// atmosphere, E = M (e - e_a) + p_a (V - M / rho_a) with e the internal energy, satisfies
///
///   E' = p sum S_k s_k' - sum m (h - h_a)       h - h_a = int dp / rho
///
/// so that the work of pistons is stored, or leaves through outlets.
struct Chamber {
  static constexpr std::string_view doc =
      "Air between pistons and outlets: an air chamber, or a tank. Its pressure loads the pistons.";
  std::string name;
  double volume = 0.0;
  double exponent = 1.4;
  double pressure = 0.0;

  template <class C = Chamber> static Fields<C> fields() {
    return {
        {"name", &C::name, "-", "Name of the chamber in the results.", true},
        {"volume", &C::volume, "m3",
         "Volume V0 of the air where all its pistons are at zero. At a scale of 1 : e it is that "
         "of "
         "the device over e^2, as the atmosphere has no scale.",
         true, more_than(0)},
        {"exponent", &C::exponent, "-",
         "Exponent n of the air: 1.4 isentropic, 1 isothermal, between them polytropic.", false,
         between(1, 1.4)},
        {"pressure", &C::pressure, "Pa", "Gauge pressure at the start."},
    };
  }
};

/// Table [[piston]]: coordinate that compresses the air of a chamber, such as the displacement of a
/// body on a slide or the amplitude of a mode.
struct Piston {
  static constexpr std::string_view doc =
      "A coordinate that presses the air of a chamber: of a joint, or the amplitude of a mode.";
  std::string name;
  std::string chamber;
  std::optional<std::string> joint, coordinate, mode;
  double area = 0.0;
  std::optional<double> roof;

  template <class P = Piston> static Fields<P> fields() {
    return {
        {"name", &P::name, "-", "Name of the piston.", true},
        {"chamber", &P::chamber, "-", "Chamber whose air it presses.", true},
        {"joint", &P::joint, "-", "Joint whose coordinate it is."},
        {"coordinate", &P::coordinate, "-",
         "Which coordinate of the joint: displacement, angle, angle_2, ...; default: its only "
         "one."},
        {"mode", &P::mode, "-", "Mode whose amplitude it is."},
        {"area", &P::area, "m2 or m3/rad",
         "Area S by which it takes volume from the chamber; on a rotation times its lever. Of a "
         "mode the integral of its vertical shape over the water.",
         true, more_than(0)},
        {"roof", &P::roof, "m",
         "Coordinate at which the water is at the roof: the run ends there. Default: where no air "
         "is left."},
    };
  }
};

} // namespace hydrodae::air
