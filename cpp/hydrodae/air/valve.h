#pragma once
#include <algorithm>
#include <cmath>

#include "hydrodae/air/orifice.h"

namespace hydrodae::air {

/// Valve that the pressure opens: a check, relief or bypass valve. It opens at a located event when
/// the drop rises to `opens_at`, and closes at one when it falls to `shuts_at`. Open, it is an
/// orifice (without choking); closed, it is tight.
///
/// Between the two pressures it keeps its state. Without that distance it would open and close
/// endlessly, because its flow reduces the pressure. Both may be zero, because the flow is then
/// zero, too.
struct Valve : Outlet, Hole {
  static constexpr std::string_view type = "valve";
  static constexpr std::string_view doc =
      "A check, relief or bypass valve: the drop of pressure opens it, and shuts it below.";
  double opens_at = 0.0, shuts_at = 0.0;
  std::string direction = "out";

  bool shut_at_rest() const { return opens_at > 0.0; }

  static constexpr bool has_kink() { return true; }
  template <class S> S kink(const S& drop, const Inlet<S>&, const Held& held) const {
    using std::abs;
    const bool open = held.side && *held.side > 0.0;
    const double size = std::max(opens_at, laminar_pressure);
    const S along = direction == "out" ? drop : direction == "in" ? -drop : abs(drop);
    return (along - S(open ? shuts_at : opens_at)) / S(size);
  }
  template <class S> S flow(const S& drop, const Inlet<S>& in, const Held& held) const {
    return held.beyond(kink(drop, in, held)) ? through(drop, in, false) : S(0);
  }

  std::optional<Fault> fault() const {
    if (opens_at > 0.0 ? shuts_at < opens_at : shuts_at == 0.0)
      return {};
    return Fault{"shuts_at", "must be below 'opens_at', or the valve would open and shut without "
                             "end; both may be zero"};
  }

  template <class O = Valve> static Fields<O> fields() {
    return outlet_fields<O>() + hole_fields<O>() +
           Fields<O>{
               {"opens_at", &O::opens_at, "Pa", "Drop of pressure at which it opens.", false,
                at_least(0)},
               {"shuts_at", &O::shuts_at, "Pa", "Drop of pressure at which it shuts.", false,
                at_least(0)},
               {"direction",
                &O::direction,
                "-",
                "Which way it lets the air: out of its chamber, in, or both.",
                false,
                any_value,
                {"out", "in", "both"}},
           };
  }
};

} // namespace hydrodae::air
