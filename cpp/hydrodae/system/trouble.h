#pragma once
/// Loads that are not numbers: name of the force and reason.

#include <string>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

/// Message on the first law whose load in the last evaluation of `ws` is not a number although its
/// inputs are: "catenary 'bow': end B is 2 m below the seabed ..."; empty if there is no such law.
std::string unknown_load(const Regime& system, const Workspace<double>& ws);

} // namespace hydrodae::system
