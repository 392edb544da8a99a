#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/hydro/database.h"

namespace hydrodae::model {

struct Scene;

/// Table [[pose_table]].
struct PoseTable {
  static constexpr std::string_view doc = "Added mass, radiation and excitation of one body by its "
                                          "pose: databases computed for several "
                                          "poses, blended by cubic splines.";
  std::string name, body, coordinate;
  static constexpr std::size_t most = 100; ///< largest number of poses
  std::vector<double> values, values_deg;  ///< one of the two is empty; values_deg is in radians
  std::vector<std::string> databases;
  std::string memory = "rest";
  std::vector<std::shared_ptr<const hydro::Database>> loaded; ///< loaded `databases`

  bool blends_memory() const { return memory == "blended"; }
  bool turns() const { return coordinate != "heave"; }
  int component() const; ///< component of the pose, 0..5
  const std::vector<double>& poses() const { return turns() ? values_deg : values; }

  template <class T = PoseTable> static Fields<T> fields() {
    return {
        {"name", &T::name, "-", "Name of the table.", true},
        {"body", &T::body, "-", "Body whose pose it follows, and which it loads.", true},
        {"coordinate",
         &T::coordinate,
         "-",
         "Coordinate of the pose: the rise of the centre of gravity above the reference pose, or "
         "the "
         "angle of the body.",
         true,
         any_value,
         {"heave", "roll", "pitch", "yaw"}},
        {"values", &T::values, "m", "Heave of the databases, two or more in ascending order."},
        {"values_deg", &T::values_deg, "deg",
         "Roll, pitch or yaw of the databases, two or more in ascending order."},
        {"databases", &T::databases, "-",
         "Paths of the databases, one for each value, relative to the case file. Each is about the "
         "centre of gravity where it then is.",
         true},
        {"memory",
         &T::memory,
         "-",
         "Radiation memory of radiation = \"exponential\": that of the database in [hydro], "
         "passive "
         "at any pose (rest), or those of all poses, each multiplied by its weight (blended).",
         false,
         any_value,
         {"rest", "blended"}},
    };
  }
};

/// Scene for the radiation and excitation of `table` at pose k: with that database, and only this
/// body in the water, moved to the pose.
Scene scene_at_pose(const Scene& scene, const PoseTable& table, std::size_t k);

/// Scene for the memory at rest: with the database of the scene, and only the body of `table` in
/// the water.
Scene scene_at_rest(const Scene& scene, const PoseTable& table);

/// Scene for the radiation of all other bodies.
Scene scene_without_tables(const Scene& scene);

/// Table of a body, or null.
const PoseTable* pose_table(const Scene& scene, const std::string& body);

} // namespace hydrodae::model
