#pragma once
#include "hydrodae/system/system.h"

namespace hydrodae::system {

/// Moves q along virtual displacements: `step` has one entry per velocity unknown [m or rad].
/// Quaternions turn by exp(step), angles and translations add; other unknowns stay.
void retract(const System& system, const VectorX& step, VectorX& y);

/// Normalises the quaternions of free bodies.
void normalise(const System& system, VectorX& y);

} // namespace hydrodae::system
