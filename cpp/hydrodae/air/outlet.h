#pragma once
/// What every table [[outlet]] has.

#include <optional>
#include <string>
#include <string_view>

#include "hydrodae/core/field.h"
#include "hydrodae/core/one_of.h"

namespace hydrodae::air {

/// The air at the inlet of an outlet: of the side from which it flows.
template <class S> struct Inlet {
  S pressure; ///< absolute [Pa]
  S density;  ///< [kg/m3]
  S speed{};  ///< of the rotor, if it has one [rad/s]
};

/// What a run holds of one outlet.
struct Held {
  const double* side = nullptr; ///< of its kink, 1 or -1, as located events hold it; null or 0: as
                                ///< the number of the kink says
  const double* signal = nullptr; ///< that a controller may write; null: as the case gives it

  template <class S> bool beyond(const S& now) const {
    return side && *side != 0.0 ? *side > 0.0 : now > S(0);
  }
};

/// What lets air out of a chamber. A type of outlet is a struct that derives from this one, with
///
///   type, doc, fields()          as every typed table (core/one_of.h)
///   flow(drop, inlet, held)      mass flow [kg/s], of the sign of the drop of pressure [Pa]
///   kink(drop, inlet, held)      optional, with has_kink(): a number that changes its sign where
///                                the flow or its slope jumps; its size where it counts is one
///   signal(), signal_unit(), start_signal()    optional: a number that a controller may write, and
///                                its start
///   prepare()                    optional: makes what the law needs of its keys
///   shut_at_rest()               optional: does it hold the air back where nothing moves?
///   fault()                      optional: what is wrong with its values
///
/// and one entry in the list of air/outlets.h. Where the flow turns, the density of the inlet is
/// that of the other side. There it is continuous, and the flow zero: only the curvature of the
/// flow jumps, by a part drop / (n p_a) of it, which the error control of a step sees.
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
