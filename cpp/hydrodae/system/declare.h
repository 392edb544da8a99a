#pragma once
/// What all that loads the bodies declares of itself, list by list (`for_each_list`). The layout of
/// its states, their names and tolerances, the groups of bodies, what elements cost, the balance of
/// energy and the results follow from this.

#include "hydrodae/core/channel.h"
#include "hydrodae/system/system.h"

namespace hydrodae::system {

struct Declaration {
  /// A load on one body that is reported, under the name of a component.
  struct Load {
    std::string component;
    int body = 0;
    element::Work work = element::Work::spent;
  };
  std::vector<StateBlock> states;        ///< in the order of y
  std::vector<Load> loads;               ///< in the order in which the observer takes them
  std::vector<std::array<int, 2>> pairs; ///< bodies that feel each other, -1: the ground
  std::vector<Channel> channels; ///< what is reported beside the loads, see Observation::elements
};

void declare(const System& system, const ElementList& list, Declaration& out);
void declare(const System& system, const HydroData& hydro, Declaration& out);

/// That of all lists.
Declaration declare(const System& system);

} // namespace hydrodae::system
