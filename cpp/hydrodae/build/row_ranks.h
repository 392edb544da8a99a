#pragma once
/// Distance of constraint rows from linear dependence, by geometry alone, because masses and units
/// are arbitrary.

#include "hydrodae/build/constraints.h"

namespace hydrodae::build {

using Mask = std::vector<bool>; ///< rows to rank

/// Rows of a mechanism in a closed pose by decreasing pivots; empty rows come last.
struct Ranking {
  std::vector<RankedRow> rows;
  /// Number of pivots above a limit.
  std::size_t rank(double limit) const;
};

/// Rankings of all mechanisms at a pose, by their numbers in `constraints`. Rows of the spanning
/// tree precede those that close loops, so that redundant rows across the plane of a loop are
/// dropped at the closing joint. A mixed choice that is independent at the start may become
/// dependent as the bodies turn.
std::vector<Ranking> rank_at(const system::System& system, Constraints& constraints,
                             const Mask& mask, const VectorX& y);

/// Least pivot of the rows of a regime at a pose, by parts: about the sine of the angle between
/// aligned bars, 0 in a singular pose [-].
/// @param part  part of each row (n_lambda,), below `parts`; rows of different parts share no body
VectorX least_pivots(const system::Regime& regime, const VectorX& y, const std::vector<int>& part,
                     int parts);

} // namespace hydrodae::build
