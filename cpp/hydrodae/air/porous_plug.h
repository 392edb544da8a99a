#pragma once
#include "hydrodae/air/outlet.h"

namespace hydrodae::air {

/// Porous plug, which replaces a turbine in tank models: m = k p.
struct PorousPlug : Outlet {
  static constexpr std::string_view type = "porous_plug";
  static constexpr std::string_view doc =
      "A porous plug: the mass flow is proportional to the drop of pressure.";
  double conductance = 0.0;

  template <class S> S flow(const S& drop, const Inlet<S>&, const Held&) const {
    return S(conductance) * drop;
  }

  template <class O = PorousPlug> static Fields<O> fields() {
    return outlet_fields<O>() +
           Fields<O>{
               {"conductance", &O::conductance, "kg/(s Pa)",
                "Mass flow k for each pascal of the drop.", true, more_than(0)},
           };
  }
};

} // namespace hydrodae::air
