#pragma once
#include "hydrodae/air/turbine.h"

namespace hydrodae::air {

/// Wells turbine.
///
///   Phi = K Psi                                            that is m = K D p / W
///   |Phi| = K Psi_s + K_s (|Psi| - Psi_s)                  for |Psi| > Psi_s: stalled
struct Wells : Turbine {
  static constexpr std::string_view type = "wells";
  static constexpr std::string_view doc =
      "A Wells turbine: its flow is proportional to the drop of pressure, until it stalls.";
  double flow_slope = 0.0;
  std::optional<double> stall, stall_slope;

  bool has_kink() const { return stall.has_value(); }

  template <class S> S kink(const S& drop, const Inlet<S>& in, const Held&) const {
    using std::abs;
    return abs(psi(drop, in)) / S(*stall) - S(1);
  }
  template <class S> S flow(const S& drop, const Inlet<S>& in, const Held& held) const {
    if (!stall || !held.beyond(kink(drop, in, held)))
      return S(flow_slope * diameter) * drop / in.speed;
    const S at = psi(drop, in);
    const double over = (flow_slope - *stall_slope) * *stall;
    return mass_flow(S(S(*stall_slope) * at + S(at < S(0) ? -over : over)), in);
  }

  std::optional<Fault> fault() const {
    if (stall.has_value() != stall_slope.has_value())
      return Fault{stall ? "stall_slope" : "stall",
                   "a turbine that stalls has both 'stall' and 'stall_slope'"};
    return Turbine::fault();
  }

  template <class O = Wells> static Fields<O> fields() {
    return turbine_fields<O>() +
           Fields<O>{
               {"flow_slope", &O::flow_slope, "-",
                "K of Phi = K Psi: flow over pressure, both dimensionless.", true, more_than(0)},
               {"stall", &O::stall, "-",
                "Dimensionless pressure Psi_s at which it stalls; default: it never does.", false,
                more_than(0)},
               {"stall_slope", &O::stall_slope, "-", "K_s, the slope of Phi beyond.", false,
                at_least(0)},
           };
  }
};

} // namespace hydrodae::air
