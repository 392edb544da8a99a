#pragma once
/// Moorings of a scene at a pose at rest.

#include "hydrodae/statics/analysis.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::statics {

/// Ropes, lines, springs between points and mooring matrices, in the order of the case file within
/// each type.
/// @param ws  workspace unpacked at y
std::vector<Mooring> moorings(const system::Regime& regime, system::Workspace<double>& ws,
                              const VectorX& y);

} // namespace hydrodae::statics
