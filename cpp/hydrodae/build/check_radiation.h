#pragma once
#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::build {

/// Radiation carries energy away: at no frequency may the damping that is loaded feed the motion of
/// the coordinates that move, but for the noise of real tables. This damping is B, the transform of
/// the kernel, or Re H of the fit. Throws ModelError naming the coordinate, frequency and size,
/// unless the solver's `force` is set.
/// @param largest  damping of each coordinate on itself, largest over the table [(n_moving,)];
///                 used by constant radiation
void check_radiation(const model::Scene& scene, const system::System& system,
                     const VectorX& largest);

} // namespace hydrodae::build
