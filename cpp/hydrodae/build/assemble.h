#pragma once
/// Closing the loops at the start, and finding rows that follow from others.

#include "hydrodae/build/closing.h"
#include "hydrodae/build/redundancy.h"
#include "hydrodae/build/start_velocities.h"

namespace hydrodae::build {

/// Leaves out rows that follow from others (see redundancy.h). Moves the bodies by the smallest
/// motion (measured by the scales) that closes all constraints, and finds velocities that keep them
/// closed (see start_velocities.h). Writes both into the bodies. Notes what was moved or
/// changed. Throws ModelError naming the constraint and its gap where there is no such pose near,
/// or the body or joint whose given velocity does not fit.
void assemble(system::System& system, const Fit& fit, const std::vector<BodyStart>& given);

/// Moves y to the nearest pose and velocities that keep all constraints; false where none is near.
bool close(const system::Regime& regime, VectorX& y);

/// Scaled gradient of all rows kept (n_lambda, n_u) at y: rows by their own scale, columns by the
/// length or angle that counts as one.
SparseMatrix constraint_gradient(const system::Regime& regime, const VectorX& y);

/// Degrees of freedom that the constraints leave at the start: n_u - rank.
Index mobility(const system::Regime& regime);

} // namespace hydrodae::build
