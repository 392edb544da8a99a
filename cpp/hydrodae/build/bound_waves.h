#pragma once
/// Bound waves of second order for what feels them.

#include "hydrodae/build/sea.h"

namespace hydrodae::build {

/// Adds the bound waves of [sea] order = 2 to the field of a drawn sea, and all of them for gauges.
/// Throws ModelError where the components are too many.
void add_bound_waves(const model::Scene& scene, Sea& sea);

} // namespace hydrodae::build
