#pragma once
/// How far the rows of the constraints are from following from each other, by geometry alone:
/// masses and units say nothing about a mechanism.

#include "hydrodae/build/constraints.h"

namespace hydrodae::build {

using Mask = std::vector<bool>; ///< which rows are looked at

/// Rows of a mechanism in a closed pose by falling pivots; rows without any entry come last.
struct Ranking {
  std::vector<RankedRow> rows;
  /// Number of pivots above a limit.
  std::size_t rank(double limit) const;
};

/// The rankings of all mechanisms at a pose, by their numbers in `constraints`. Rows of the
/// spanning tree come before those that close loops. What the joints of a loop hold across its
/// plane is then left out at the closing joint. A mixture of rows that is independent at the start
/// may become dependent as the bodies turn.
std::vector<Ranking> rank_at(const system::System& system, Constraints& constraints,
                             const Mask& mask, const VectorX& y);

/// Least pivot of the rows of a regime at a pose, by parts: about the sine of the angle between
/// bars in line, 0 in a singular pose [-].
/// @param part of each row (n_lambda,), below `parts`; rows of different parts share no body
VectorX least_pivots(const system::Regime& regime, const VectorX& y, const std::vector<int>& part,
                     int parts);

} // namespace hydrodae::build
