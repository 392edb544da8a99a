#pragma once
#include "hydrodae/system/system.h"

namespace hydrodae::system {

/// q moved along virtual displacements: `step` has one entry per velocity unknown [m or rad];
/// quaternions turn by exp(step), angles and translations add. Other unknowns stay.
void retract(const System& system, const VectorX& step, VectorX& y);

/// The quaternions of free bodies made unit ones.
void normalise(const System& system, VectorX& y);

} // namespace hydrodae::system
