#pragma once
#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::build {

/// Builds the system of a checked scene: dofs, markers, constraint rows that matter, hydrodynamics,
/// scales; the excitation of the sea is that of the start, or left out. Throws ModelError.
system::System build(const model::Scene& scene, bool with_excitation = true);

} // namespace hydrodae::build
