#pragma once
/// Motion of bodies that closes the constraint rows.

#include "hydrodae/build/constraints.h"

namespace hydrodae::build {

/// Largest gap of a closed pose, in units of its scale
inline constexpr double nearly_closed = 1e-8;

/// Closes positions by Newton's method with smallest corrections in units of the scales, each
/// mechanism separately.
/// @param moved  optional; on entry the longest displacement of each mechanism, on return the
/// actual one, in units of the scales
/// @returns the largest remaining gap in each mechanism
VectorX close_positions(const system::System& system, Constraints& constraints, VectorX& y,
                        VectorX* moved = nullptr);

/// Closes positions by Newton's method, damped along directions in which the rows hardly change: it
/// closes what is possible near y, and leaves small gaps of contradictory rows.
/// @returns the displacement of each mechanism, in units of the scales
VectorX approach(const system::System& system, Constraints& constraints, VectorX& y);

/// Mechanisms that are closed at y, except for gaps that no small motion closes.
std::vector<bool> closed_mechanisms(Constraints& constraints, const VectorX& y);

/// Moves y to the nearest closed pose; small gaps of contradictory rows stay open.
/// @returns whether there is one; otherwise y is the nearest pose found
bool find_pose(const system::System& system, Constraints& constraints, VectorX& y);

} // namespace hydrodae::build
