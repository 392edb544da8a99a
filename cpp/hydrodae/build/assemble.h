#pragma once
/// Closing of the loops at the start, and search for redundant rows.

#include "hydrodae/build/closing.h"
#include "hydrodae/build/redundancy.h"
#include "hydrodae/build/start_velocities.h"

namespace hydrodae::build {

/// Omits redundant rows (see redundancy.h). Moves the bodies by the smallest motion (in units of
/// the scales) that closes all constraints, and finds velocities that keep them closed (see
/// start_velocities.h). Writes both into the bodies, and notes changes. Throws ModelError with the
/// constraint and its gap if there is no such pose nearby, or with the body or joint whose given
/// velocity does not fit.
void assemble(system::System& system, const Fit& fit, const std::vector<BodyStart>& given);

/// Moves y to the nearest pose and velocities that keep all constraints; returns false if none is
/// near.
bool close(const system::Regime& regime, VectorX& y);

/// Scaled gradient of all kept rows (n_lambda, n_u) at y: rows by their scale, columns by the unit
/// length or angle.
SparseMatrix constraint_gradient(const system::Regime& regime, const VectorX& y);

/// Degrees of freedom that the constraints leave at the start: n_u - rank.
Index mobility(const system::Regime& regime);

} // namespace hydrodae::build
