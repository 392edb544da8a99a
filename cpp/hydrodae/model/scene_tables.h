#pragma once
/// Tables of a case file and their members in the scene, in one list.

#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

/// Calls `visit(name, member)` for every table [name] and every list [[name]], in the order in
/// which they are read. The member is a struct of fields, an optional one, a vector of them (a
/// list), a vector of `OneOf` or `Forces` (lists in which every `type` is a struct of its own).
template <class Visit> void for_each_table(const Visit& visit) {
  visit("environment", &Scene::environment);
  visit("seabed", &Scene::seabed);
  visit("hydro", &Scene::hydro);
  visit("pose_table", &Scene::pose_tables);
  visit("sea", &Scene::sea);
  visit("wave", &Scene::waves);
  visit("second_order", &Scene::second_order);
  visit("body", &Scene::bodies);
  visit("mode", &Scene::modes);
  visit("attachment", &Scene::attachments);
  visit("joint", &Scene::joints);
  visit("constraint", &Scene::constraints);
  visit("marker", &Scene::markers);
  visit("force", &Scene::forces);
  visit("morison", &Scene::morison);
  visit("chamber", &Scene::chambers);
  visit("piston", &Scene::pistons);
  visit("outlet", &Scene::outlets);
  visit("gauge", &Scene::gauges);
  visit("controller", &Scene::controllers);
  visit("solver", &Scene::solver);
  visit("output", &Scene::output);
}

/// Returns whether every case must have this table.
constexpr bool is_required_table(std::string_view name) {
  return name == "body" || name == "solver";
}

} // namespace hydrodae::model
