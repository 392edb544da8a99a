#pragma once
#include <string>
#include <vector>

#include "hydrodae/air/chamber.h"
#include "hydrodae/air/outlets.h"

namespace hydrodae::air {

/// Chambers with what presses them and what leads out of them. Chambers that no outlet joins are
/// networks of their own.
struct Parts {
  Atmosphere outside;
  std::vector<Chamber> chambers;
  std::vector<Piston> pistons;
  std::vector<AnyOutlet> outlets;
};

/// The parts of each network, in the order of its first chamber.
std::vector<Parts> networks(const Parts& all);

/// Where the chamber of this name stands; behind all if there is no such chamber.
int index_of(const std::vector<Chamber>& chambers, const std::string& name);

} // namespace hydrodae::air
