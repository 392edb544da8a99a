#pragma once
/// Tables [sea] and [[wave]]: the sea is the sum of its wave systems; without any it is still.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/core/one_of.h"
#include "hydrodae/sea/component_file.h"
#include "hydrodae/sea/density_table.h"
#include "hydrodae/sea/jonswap.h"
#include "hydrodae/sea/measured.h"
#include "hydrodae/sea/new_wave.h"
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
  int order = 1, second_order_terms = 400;
  std::optional<double> second_order_limit;
  std::vector<Vector3> current_profile; ///< z [m], speed [m/s], heading [deg]

  template <class S = Sea> static Fields<S> fields() {
    return {
        {"ramp", &S::ramp, "s",
         "Time over which all waves grow from nothing, by a polynomial of degree 7 (three "
         "continuous derivatives).",
         false, at_least(0, longest_time)},
        {"current", &S::current, "m/s",
         "Velocity of the water, the same everywhere, on which the Morison elements work; the "
         "waves do not feel it."},
        {"current_profile", &S::current_profile, "-",
         "In place of `current`: rows [z, speed, heading] in m, m/s and deg, z from 0 downwards; "
         "straight lines between, constant beyond the first and the last."},
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
        {"order", &S::order, "-",
         "2: gauges, Morison elements and lines feel the bound waves of second order, too, at sums "
         "and differences of the frequencies; the excitation of the database stays of first order.",
         false, between(1, 2)},
        {"second_order_limit", &S::second_order_limit, "rad/s",
         "Highest frequency of the components that make bound waves; sqrt(2 g / Hs) by default.",
         false, more_than(0)},
        {"second_order_terms", &S::second_order_terms, "-",
         "Largest number of bound waves that Morison elements and lines feel; the largest are "
         "kept. Gauges have all.",
         false, between(1, 100000)},
    };
  }
};

/// Table [[wave]]: one wave system. A new type is one header and one entry here.
using Wave = OneOf<WaveSystem, Regular, Jonswap, Bretschneider, PiersonMoskowitz, OchiHubble,
                   DensityTable, Measured, NewWave, ComponentFile>;

} // namespace hydrodae::sea
