#pragma once
/// Table [seabed]: depths on a grid.

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/math/smooth_table.h"

namespace hydrodae::model {

struct Seabed {
  static constexpr std::string_view doc =
      "Seabed under dynamic lines, by depths on a grid. The waves have the depth of the water.";
  std::vector<double> x, y, depth;

  /// Surface of the seabed, z [m] over x and y.
  std::shared_ptr<const SmoothTable> surface() const;
  std::optional<Fault> fault() const;

  template <class B = Seabed> static Fields<B> fields() {
    return {
        {"x", &B::x, "m", "Places of the grid along x, two or more in ascending order.", true},
        {"y", &B::y, "m", "Places of the grid along y, two or more in ascending order.", true},
        {"depth", &B::depth, "m",
         "Depths below z = 0, row by row: for the first y those of all x, then for the next y. "
         "Between the points the seabed is a smooth surface, beyond the grid it goes on level.",
         true, more_than(0)},
    };
  }
};

} // namespace hydrodae::model
