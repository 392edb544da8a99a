#pragma once
/// Declarations of everything that loads the bodies, list by list (`for_each_list`). The layout,
/// names and tolerances of states, the groups of bodies, the cost of elements, the energy balance
/// and the results follow from them.

#include "hydrodae/core/channel.h"
#include "hydrodae/system/system.h"

namespace hydrodae::system {

struct Declaration {
  /// Load on one body in the results, under the name of its component.
  struct Load {
    std::string component;
    int body = 0;
    element::Work work = element::Work::spent;
  };
  std::vector<StateBlock> states;        ///< states in the order of y
  std::vector<Load> loads;               ///< loads in the order in which the observer takes them
  std::vector<std::array<int, 2>> pairs; ///< bodies that act on each other; -1: the ground
  /// Channels in the results besides the loads, see Observation::elements
  std::vector<Channel> channels;
};

void declare(const System& system, const ElementList& list, Declaration& out);
void declare(const System& system, const HydroData& hydro, Declaration& out);

/// Declaration of all lists of the system.
Declaration declare(const System& system);

} // namespace hydrodae::system
