#pragma once
/// Constraint rows that follow from others, exactly or but for a small misalignment of their
/// joints.

#include "hydrodae/system/regime.h"

namespace hydrodae::build {

/// How the assembly treats joints that do not quite fit each other.
struct Fit {
  double tolerance = 1e-6; ///< solver.tolerance_assembly, of a body's lever or of one radian
  double end_time = 0.0;   ///< drives are compared up to here [s]
  bool force = false;      ///< hold misaligned rows all the same
};

/// Marks rows that follow from the others in every closed pose near y, up to the tolerance (rank of
/// the scaled gradient, there and at perturbed poses), and notes them. A rank that is lost in the
/// pose of the start alone is a singular pose: noted, nothing dropped. Throws ModelError where rows
/// are so nearly dependent that a misalignment locks the mechanism, and where drives contradict
/// each other.
void drop_dependent_rows(system::System& system, const VectorX& y, const Fit& fit);

} // namespace hydrodae::build
