#pragma once
/// Integrators, one row each: names for solver.method, and properties of each method.
/// (integrate/integrator.cpp makes them.)

#include <string>
#include <string_view>
#include <vector>

namespace hydrodae {

struct MethodTraits {
  std::string_view name;
  std::vector<int> orders;        ///< choices of solver.order; empty: no choice
  std::string_view one_order;     ///< reason why there is no choice, for messages
  bool adapts = true;             ///< true: chooses its steps by rtol
  bool fixes = true;              ///< true: takes fixed steps
  bool drifting = false;          ///< true: takes formulations with drifting constraints
  std::string_view fails_index_3; ///< reason why it fails on index 3; empty: it does not
  bool limits_order = false;      ///< true: solver.max_order limits it
  bool takes_radius = false;      ///< true: solver.spectral_radius acts on it
  /// True: the polynomial inside adaptive steps is of lower order than their ends. Steps are then
  /// repeated up to an event instead of being cut there.
  bool coarse_inside = false;
  /// True: it makes so many short steps that it meets a pose several times (multistep methods).
  bool many_steps = false;
  bool passes_singular_poses = false; ///< of closed loops, by measurement (tests/stability)
  bool projects_rates = false;        ///< do its steps meet the rows of the rates exactly?
  bool loose_reactions = false;       ///< does no error test hold the multipliers of its steps?
  bool marches_lanes = false;         ///< can it march several runs side by side (ensemble/)?
};

/// Methods, adaptive ones first, in the order of reliability in the stability map.
const std::vector<MethodTraits>& methods();

/// Traits of a method by name; null for "auto".
const MethodTraits* find_method(std::string_view name);

/// Traits of a method by name; "auto" is not one.
const MethodTraits& method_traits(std::string_view name);

/// Names of "auto" and of all methods.
std::vector<std::string_view> method_names();

/// Names of the adaptive methods.
std::vector<std::string> adaptive_methods();

} // namespace hydrodae
