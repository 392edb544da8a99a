#pragma once
#include "hydrodae/build/sea.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::build {

/// Builds the system of a checked scene: degrees of freedom, markers, constraint rows that matter,
/// hydrodynamics, scales; the excitation of the sea is that at the start, or omitted. Throws
/// ModelError.
system::System build(const model::Scene& scene, const Sea& sea, bool with_excitation = true);
inline system::System build(const model::Scene& scene, bool with_excitation = true) {
  return build(scene, draw_sea(scene), with_excitation);
}

} // namespace hydrodae::build
