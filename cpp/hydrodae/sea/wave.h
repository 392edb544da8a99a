#pragma once
/// Tables [sea] and [[wave]]: the sea is the sum of its wave systems; without any it is still.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/core/one_of.h"
#include "hydrodae/sea/density_table.h"
#include "hydrodae/sea/jonswap.h"
#include "hydrodae/sea/measured.h"
#include "hydrodae/sea/ochi_hubble.h"
#include "hydrodae/sea/pierson_moskowitz.h"
#include "hydrodae/sea/regular.h"

namespace hydrodae::sea {

/// Table [sea]: values common to all wave systems.
struct Sea {
  static constexpr std::string_view doc = "What all wave systems share, and the current.";
  double ramp = 0.0;
  Vector3 current = Vector3::Zero();
  std::string phase = "fixed";
  std::string stretching = "vertical";
  bool bernoulli = false;

  template <class S = Sea> static Fields<S> fields() {
    return {
        {"ramp", &S::ramp, "s",
         "Time over which all waves grow from nothing, by a polynomial of degree 7 (three "
         "continuous derivatives).",
         false, at_least(0, longest_time)},
        {"current", &S::current, "m/s",
         "Velocity of the water, the same everywhere, on which the Morison elements work; the "
         "waves do not feel it."},
        {"phase",
         &S::phase,
         "-",
         "Where a body feels the phase of the waves: at its reference position (fixed), or where "
         "it is (moving: for bodies that drift; it costs a sum over all components in each "
         "evaluation).",
         false,
         any_value,
         {"fixed", "moving"}},
        {"stretching",
         &S::stretching,
         "-",
         "Pressure of the waves above z = 0 on bodies with `froude_krylov = \"mesh\"`. vertical: "
         "hydrostatic down from the crest, consistent to second order. wheeler: the linear profile "
         "moved up to the crest. extrapolated: e^(kz) as it is. none: the wetted part ends at z = "
         "0.",
         false,
         any_value,
         {"vertical", "wheeler", "extrapolated", "none"}},
        {"bernoulli", &S::bernoulli, "-",
         "Whether the pressure on them has the term -rho u^2 / 2 of the waves' own velocity."},
    };
  }
};

/// Table [[wave]]: one wave system. A new type is one header and one entry here.
using Wave = OneOf<WaveSystem, Regular, Jonswap, Bretschneider, PiersonMoskowitz, OchiHubble,
                   DensityTable, Measured>;

} // namespace hydrodae::sea
