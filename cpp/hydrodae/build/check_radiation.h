#pragma once
#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::build {

/// Checks that radiation dissipates energy: at no frequency may the damping feed the motion of the
/// moving coordinates, except for the noise of real tables. The damping is B, the transform of the
/// kernel, or Re H of the fit. Throws ModelError with the coordinate, frequency and size, unless
/// the solver's `force` is set.
void check_radiation(const model::Scene& scene, const system::System& system);

} // namespace hydrodae::build
