#pragma once
/// Moving bodies so that the constraint rows close.

#include "hydrodae/build/constraints.h"

namespace hydrodae::build {

inline constexpr double nearly_closed = 1e-8; ///< gaps that a closed pose may have, of their scale

/// Newton's method with smallest corrections in units of the scales, each mechanism by itself.
/// @param moved  if given: the longest way that each mechanism may go; the ways gone, in units of
///               the scales
/// @returns the largest gap left in each mechanism
VectorX close_positions(const system::System& system, Constraints& constraints, VectorX& y,
                        VectorX* moved = nullptr);

/// Newton's method damped along directions in which the rows hardly change: closes what can be
/// closed near y, and leaves the gaps of rows that contradict each other by a little.
/// @returns the way that each mechanism has gone, in units of the scales
VectorX approach(const system::System& system, Constraints& constraints, VectorX& y);

/// Which mechanisms are closed at y, but for gaps that no small motion closes?
std::vector<bool> closed_mechanisms(Constraints& constraints, const VectorX& y);

/// Moves y to the closed pose near it; rows that contradict each other by a little stay open.
/// @returns whether there is one; else y is as near as it gets
bool find_pose(const system::System& system, Constraints& constraints, VectorX& y);

} // namespace hydrodae::build
