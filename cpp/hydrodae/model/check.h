#pragma once
/// Parts of `check`.

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Name of the fixed world as an end of a joint
inline constexpr std::string_view ground = "ground";

void check_body(const Scene& scene, const Body& body);
void check_joint(const Scene& scene, const Joint& joint);
void check_constraint(const Scene& scene, const Constraint& constraint);
void check_marker(const Scene& scene, const Marker& marker);
void check_forces(const Scene& scene);
void check_morison(const Scene& scene);
void check_chambers(const Scene& scene);

/// Water below a piston by the database: what it is, and its stiffness rho g S [N/m].
struct WaterOfPiston {
  std::string name;
  double stiffness = 0.0;
};

/// Water below a piston; empty where the database has neither a mode nor a water column for it.
std::optional<WaterOfPiston> water_of_piston(const Scene& scene, const air::Piston& piston);

/// Refuses a second model of one effect of the water on a body (claims.h).
void check_claims(const Scene& scene);
void check_controller(const Scene& scene, const Controller& controller);
void check_solver(const Scene& scene);
void check_sea(const Scene& scene);
void check_seabed(const Scene& scene);
void check_second_order(const Scene& scene);                   ///< behind `check_database`
void check_gauge(const Scene& scene, const sea::Gauge& gauge); ///< behind `check_sea`
void check_pose_table(const Scene& scene, const PoseTable& table);
void check_database(const Scene& scene); ///< only called when the scene has one

/// Entry under check: [[kind]] with this name.
struct Entry {
  std::string kind;
  std::string name;
};

/// Throws ModelError with the key path "<kind>.<name>.<key>" (without a key: "<kind>.<name>").
[[noreturn]] void refuse(const Entry& entry, const std::string& key, const std::string& message);

/// Names that joints, forces and markers may use: bodies and attachments.
std::vector<std::string> names_of_bodies(const Scene& scene);

/// Refuses `key = name` of the entry unless `names` contains the name; `sort`: their kind.
void check_reference(const Entry& entry, const std::string& key, const std::string& name,
                     const std::vector<std::string>& names, const std::string& sort);

/// Refuses `body_a` and `body_b` of the entry unless they are two bodies, or a body and the ground.
void check_ends(const Scene& scene, const Entry& entry, const std::string& body_a,
                const std::string& body_b);

/// Refuses `joint_key = joint` unless that joint has a motion, and `coordinate_key = coordinate`
/// unless it is one of its motions.
void check_joint_coordinate(const Scene& scene, const Entry& entry, const std::string& joint_key,
                            const std::string& joint, const std::string& coordinate_key,
                            const std::optional<std::string>& coordinate);

/// Refuses a joint without the coordinate that the entry acts along; `coordinate` selects one of
/// several.
/// @returns whether the coordinate is an angle
bool check_motion(const Scene& scene, const Entry& entry, const std::string& name,
                  const std::optional<std::string>& coordinate);

/// Refuses faults in the values of an entry, alone or for a run of this length.
template <class Shared, class... T>
void check_own(const Entry& entry, const OneOf<Shared, T...>& any, double end_time = 0.0) {
  any.visit([&](const auto& one) {
    std::optional<Fault> fault;
    if constexpr (requires { one.fault(); })
      fault = one.fault();
    else if constexpr (requires { one.fault(end_time); })
      fault = one.fault(end_time);
    if (fault)
      refuse(entry, fault->key, fault->message);
  });
}

/// Refuses bounds in m for an angle, and in deg for a displacement.
template <class T>
void check_bounds(const Entry& entry, [[maybe_unused]] const T& item, [[maybe_unused]] bool angle) {
  if constexpr (requires { item.lower_angle; }) {
    if (angle && (item.lower || item.upper))
      refuse(entry, item.lower ? "lower" : "upper",
             "the coordinate is an angle: write 'lower_deg' and 'upper_deg'");
    if (!angle && (item.lower_angle || item.upper_angle))
      refuse(entry, item.lower_angle ? "lower_deg" : "upper_deg",
             "the coordinate is a displacement: write 'lower' and 'upper'");
  }
}

/// Returns whether two points of a scene coincide, up to rounding [m].
bool coincide(const Vector3& a, const Vector3& b);

template <class T> void append_names(const std::vector<T>& items, std::vector<std::string>& names) {
  for (const T& item : items)
    names.push_back(name_of_entry(item));
}

template <class T> std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  append_names(items, names);
  return names;
}

/// Item with this name, or null.
template <class T> const T* find_named(const std::vector<T>& items, const std::string& name) {
  for (const T& item : items)
    if (name_of_entry(item) == name)
      return &item;
  return nullptr;
}

} // namespace hydrodae::model
