#pragma once
/// Rotation vectors beyond half a turn.
///
/// Up to 180 degrees a rotation is a vector, whatever the way there. Beyond, the vector goes on
/// (system/turning.h) as long as the rotation keeps its axis. A rotation that leaves it by a small
/// angle d passes a full turn with a vector that swings round within the angle d: each such turn
/// changes the motion by a part d. So d is held to what the tolerance bears anyway.

#include <memory>

#include "hydrodae/run/guards.h"

namespace hydrodae::run {

/// Ends the run where a load follows such a vector and there is no axis. Null: no law sees one.
std::unique_ptr<Guard> make_turn_check(const system::Regime& system, double rtol);

} // namespace hydrodae::run
