#pragma once
/// The integrators, one row each: what solver.method may name, and all that the rest of the program
/// has to know of a method. (integrate/integrator.cpp makes them.)

#include <string>
#include <string_view>
#include <vector>

namespace hydrodae {

struct MethodTraits {
  std::string_view name;
  std::vector<int> orders;        ///< that solver.order may name; empty: no choice
  std::string_view one_order;     ///< why there is no choice, for messages
  bool adapts = true;             ///< may it choose its steps by rtol?
  bool fixes = true;              ///< may it take fixed steps?
  bool drifting = false;          ///< does it take formulations that let the constraints drift?
  std::string_view fails_index_3; ///< why it fails on index 3; empty: it does not
  bool limits_order = false;      ///< does solver.max_order limit it?
  bool takes_radius = false;      ///< does solver.spectral_radius act on it?
  /// Is the polynomial inside its adaptive steps of a lower order than their ends? Then steps are
  /// repeated up to an event instead of being cut there.
  bool coarse_inside = false;
  /// Has it so many short steps that a pose on the way is met several times (multistep methods)?
  bool many_steps = false;
  bool passes_singular_poses = false; ///< of closed loops, by measurement (tests/stability)
  bool projects_rates = false;        ///< do its steps meet the rows of the rates exactly?
  bool loose_reactions = false;       ///< does no error test hold the multipliers of its steps?
  bool marches_lanes = false;         ///< can it march several runs side by side (ensemble/)?
};

/// All methods, those that choose their steps first, by how far the stability map trusts them.
const std::vector<MethodTraits>& methods();

/// Of a method by name; null where the scene chooses it ("auto").
const MethodTraits* find_method(std::string_view name);

/// Of a method by name; "auto" is not one.
const MethodTraits& method_traits(std::string_view name);

/// "auto" and the names of all.
std::vector<std::string_view> method_names();

/// Those that choose their steps.
std::vector<std::string> adaptive_methods();

} // namespace hydrodae
