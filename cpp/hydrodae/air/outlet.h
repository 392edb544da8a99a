#pragma once
/// Common members of every table [[outlet]].

#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/core/one_of.h"

namespace hydrodae::air {

/// Air at the inlet of an outlet: the side from which it flows.
template <class S> struct Inlet {
  S pressure; ///< absolute [Pa]
  S density;  ///< [kg/m3]
  S speed{};  ///< speed of the rotor, if there is one [rad/s]
};

/// Held values of one outlet in a run.
struct Held {
  /// Side of its kink, 1 or -1, from located events; null or 0: from the sign
  const double* side = nullptr;
  const double* signal = nullptr; ///< signal of a controller; null: the value of the case

  template <class S> bool beyond(const S& now) const {
    return side && *side != 0.0 ? *side > 0.0 : now > S(0);
  }
};

/// Outlet of a chamber. A type of outlet is a struct that derives from this one, with
///
///   type, doc, fields()          as every typed table (core/one_of.h)
///   flow(drop, inlet, held)      mass flow [kg/s], with the sign of the pressure drop [Pa]
///   kink(drop, inlet, held)      optional, with has_kink(): switching function, which changes sign
///                                 where the flow or its slope jumps; of order one
///   signal(), signal_unit(), start_signal()    optional: signal of a controller, and its start
///   prepare()                    optional: derives numbers from the keys
///   shut_at_rest()               optional: whether it is closed at rest
///   fault()                      optional: fault in its values
///
/// and one entry in the list of air/outlets.h. When the flow reverses, the inlet density becomes
/// that of the other side, while the flow is zero. Only the curvature of the flow jumps, by a part
/// drop / (n p_a), which the error control of a step handles.
struct Outlet {
  static constexpr std::string_view list_doc =
      "What lets air out of a chamber and in: an orifice, a plug, a turbine.";
  std::string name;
  std::string chamber;
  std::optional<std::string> to;
};

template <class O> Fields<O> outlet_fields() {
  return {
      {"name", &O::name, "-", "Name of the outlet in the results.", true},
      {"chamber", &O::chamber, "-", "Chamber that it opens.", true},
      {"to", &O::to, "-", "Chamber to which it leads; default: the atmosphere."},
  };
}

} // namespace hydrodae::air
