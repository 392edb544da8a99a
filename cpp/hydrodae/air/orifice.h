#pragma once
#include <cmath>

#include "hydrodae/air/outlet.h"

namespace hydrodae::air {

/// Flow through a sharp-edged hole.
///
///   m = C A sqrt(2 rho_in) p / (p^2 + p_l^2)^(1/4)      p: drop of pressure
///
/// Below the laminar pressure p_l the flow is linear. If the downstream pressure falls below p_in
/// (2 / (g + 1))^(g / (g - 1)), g = 1.4 (0.528 p_in), the throat reaches the speed of sound, and a
/// further drop does not increase the flow: p stays at this value.
struct Hole {
  double coefficient = 0.0, area = 0.0, laminar_pressure = 1.0;

  static constexpr double critical_ratio = 0.52828178771717416; ///< 1.2^-3.5

  /// Relative excess of the drop over the one that chokes.
  template <class S> S choking(const S& drop, const Inlet<S>& in) const {
    using std::abs;
    return abs(drop) / (S(1.0 - critical_ratio) * in.pressure) - S(1);
  }
  template <class S> S through(const S& drop, const Inlet<S>& in, bool choked) const {
    using std::sqrt;
    S p = drop;
    if (choked)
      p = (drop < S(0) ? S(critical_ratio - 1.0) : S(1.0 - critical_ratio)) * in.pressure;
    const S size = sqrt(p * p + S(laminar_pressure * laminar_pressure));
    return S(coefficient * area) * sqrt(S(2) * in.density / size) * p;
  }
};

template <class O> Fields<O> hole_fields() {
  return {
      {"coefficient", &O::coefficient, "-", "Discharge coefficient C.", true, {0.0, 1.0, true}},
      {"area", &O::area, "m2", "Area A of the hole.", true, more_than(0)},
      {"laminar_pressure", &O::laminar_pressure, "Pa",
       "Drop of pressure p_l below which the flow is linear: it removes the endless slope of a "
       "root "
       "at zero. A larger one makes runs cheaper.",
       false, more_than(0)},
  };
}

/// Orifice or throttle: a controller may set the open part u of the area.
struct Orifice : Outlet, Hole {
  static constexpr std::string_view type = "orifice";
  static constexpr std::string_view doc =
      "An orifice: the flow goes with the root of the drop of pressure, until it chokes.";
  double opening = 1.0;

  static std::string_view signal() { return "opening"; }
  static std::string_view signal_unit() { return "-"; }
  double start_signal() const { return opening; }
  bool shut_at_rest() const { return opening == 0.0; }

  static constexpr bool has_kink() { return true; }
  template <class S> S kink(const S& drop, const Inlet<S>& in, const Held&) const {
    return choking(drop, in);
  }
  template <class S> S flow(const S& drop, const Inlet<S>& in, const Held& held) const {
    const double open = held.signal ? *held.signal : opening;
    return S(open) * through(drop, in, held.beyond(choking(drop, in)));
  }

  template <class O = Orifice> static Fields<O> fields() {
    return outlet_fields<O>() + hole_fields<O>() +
           Fields<O>{
               {"opening", &O::opening, "-",
                "Part of the area that is open at the start. A controller may write it.", false,
                between(0, 1)},
           };
  }
};

} // namespace hydrodae::air
