#pragma once
#include <string>
#include <vector>

#include "hydrodae/air/chamber.h"
#include "hydrodae/air/outlets.h"

namespace hydrodae::air {

/// Chambers with their pistons and outlets. Chambers that no outlet connects are separate networks.
struct Parts {
  Atmosphere outside;
  std::vector<Chamber> chambers;
  std::vector<Piston> pistons;
  std::vector<AnyOutlet> outlets;
};

/// Parts of each network, in the order of its first chamber.
std::vector<Parts> networks(const Parts& all);

/// Index of the chamber with this name; the number of chambers if missing.
int index_of(const std::vector<Chamber>& chambers, const std::string& name);

} // namespace hydrodae::air
