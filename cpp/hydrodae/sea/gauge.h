#pragma once
/// Table [[gauge]]: place where the elevation of the waves is reported, now and for some time
/// ahead.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/field.h"

namespace hydrodae::sea {

/// Elevation of the undisturbed waves, with their ramp, at a fixed place or at a marker.
struct Gauge {
  static constexpr std::string_view doc =
      "A place where the elevation of the undisturbed waves is reported, now and some time ahead.";
  std::string name;
  std::vector<double> point;
  std::optional<std::string> marker;
  std::vector<double> ahead;

  template <class G = Gauge> static Fields<G> fields() {
    return {
        {"name", &G::name, "-", "Name of the gauge in the results.", true},
        {"point", &G::point, "m", "Where it stands, [x, y]; the origin by default."},
        {"marker", &G::marker, "-", "Marker above or beneath which it stays, in place of a point."},
        {"ahead", &G::ahead, "s",
         "Times from now to those whose elevation is reported, too: a forecast without error, as "
         "the waves are those of the run.",
         false, at_least(0, longest_time)},
    };
  }
};

} // namespace hydrodae::sea
