#include "hydrodae/core/methods.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae {

namespace {

std::vector<int> every_second(int low, int high) {
  std::vector<int> out;
  for (int order = low; order <= high; order += 2)
    out.push_back(order);
  return out;
}

} // namespace

const std::vector<MethodTraits>& methods() {
  static const std::vector<MethodTraits> all = {
      {.name = "radau",
       .orders = every_second(1, 19),
       .one_order = "",
       .drifting = true,
       .fails_index_3 = "",
       .coarse_inside = true,
       .passes_singular_poses = true},
      {.name = "explicit_rk",
       .orders = {5, 8},
       .one_order = "",
       .fails_index_3 = "",
       .coarse_inside = true,
       .passes_singular_poses = true,
       .projects_rates = true,
       .marches_lanes = true},
      {.name = "ida",
       .orders = {},
       .one_order = "ida varies its order; solver.max_order limits it",
       .fixes = false,
       .drifting = true,
       .fails_index_3 = "BDF on index 3 loses two to three digits and often stops: its error test "
                        "sees the velocities like multipliers",
       .limits_order = true,
       .many_steps = true,
       .loose_reactions = true},
      {.name = "generalized_alpha",
       .orders = {},
       .one_order = "generalized_alpha is always of order 2",
       .adapts = false,
       .fails_index_3 = "",
       .takes_radius = true},
      {.name = "gauss",
       .orders = every_second(2, 20),
       .one_order = "",
       .adapts = false,
       .drifting = true,
       .fails_index_3 = "Gauss methods diverge on index 3, as they are not stiffly accurate"},
      {.name = "lobatto_iiic",
       .orders = every_second(2, 18),
       .one_order = "",
       .adapts = false,
       .drifting = true,
       .fails_index_3 = ""},
  };
  return all;
}

const MethodTraits* find_method(std::string_view name) {
  for (const MethodTraits& m : methods())
    if (m.name == name)
      return &m;
  return nullptr;
}

const MethodTraits& method_traits(std::string_view name) {
  if (const MethodTraits* found = find_method(name))
    return *found;
  throw Error("no method " + in_quotes(std::string(name)));
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> out{"auto"};
  for (const MethodTraits& m : methods())
    out.push_back(m.name);
  return out;
}

std::vector<std::string> adaptive_methods() {
  std::vector<std::string> out;
  for (const MethodTraits& m : methods())
    if (m.adapts)
      out.emplace_back(m.name);
  return out;
}

} // namespace hydrodae
