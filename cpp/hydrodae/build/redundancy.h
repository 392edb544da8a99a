#pragma once
/// Constraint rows that depend on others, exactly or except for a small misalignment of their
/// joints.

#include "hydrodae/system/regime.h"

namespace hydrodae::build {

/// Treatment of joints that do not fit exactly.
struct Fit {
  /// Tolerance solver.tolerance_assembly, relative to a body's lever or one radian
  double tolerance = 1e-6;
  double end_time = 0.0; ///< end of the comparison of drives [s]
  bool force = false;    ///< true: keep misaligned rows
};

/// Marks and notes rows that depend on the others in every closed pose near y, within the tolerance
/// (rank of the scaled gradient, there and at perturbed poses). A rank lost only at the start is a
/// singular pose: noted, nothing dropped. Throws ModelError if a misalignment of nearly dependent
/// rows locks the mechanism, or drives contradict each other.
void drop_dependent_rows(system::System& system, const VectorX& y, const Fit& fit);

} // namespace hydrodae::build
