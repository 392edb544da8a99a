#pragma once
/// What moors a scene at a pose at rest.

#include "hydrodae/statics/analysis.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::statics {

/// All ropes, lines, springs between points and mooring matrices, in the order of the case file
/// within each type.
/// @param ws  unpacked at y
std::vector<Mooring> moorings(const system::Regime& regime, system::Workspace<double>& ws,
                              const VectorX& y);

} // namespace hydrodae::statics
