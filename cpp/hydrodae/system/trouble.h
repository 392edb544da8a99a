#pragma once
/// Loads that are no numbers: which force, and why.

#include <string>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// What a message says of the first law whose load in the last evaluation of `ws` is no number,
/// though it saw numbers: "catenary 'bow': end B is 2 m below the seabed ..."; empty if
/// there is no such law.
std::string unknown_load(const Regime& system, const Workspace<double>& ws);

} // namespace hydrodae::system
