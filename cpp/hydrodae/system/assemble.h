#pragma once
/// Closing the loops at the start, and finding rows that follow from others.

#include "hydrodae/system/rank.h"
#include "hydrodae/system/system.h"

namespace hydrodae::system {

/// q moved along virtual displacements: `step` has one entry per velocity unknown [m or rad];
/// quaternions turn by exp(step), angles and translations add. Other unknowns stay.
void retract(const System& system, const VectorX& step, VectorX& y);

/// Moves the bodies by the smallest motion (measured by the scales) that closes all constraints,
/// then the velocities by the smallest change that keeps them closed, and writes both into the
/// bodies. Notes how far each body moved. Throws ModelError naming the constraint and its gap where
/// there is no such pose near.
void assemble(System& system);

/// Moves y to the nearest pose and velocities that keep all constraints; false where none is near.
bool close(const System& system, VectorX& y);

/// What one unit of each velocity coordinate means as a displacement [m or rad], (n_u,).
VectorX displacement_scale(const System& system);

/// Marks constraint rows that follow from the others in every closed pose near the start (rank of
/// the scaled gradient, there and at perturbed closed poses). A rank that is lost in
/// the pose of the start alone is a singular pose: noted, nothing dropped.
/// @returns whether rows were dropped; then the layout has to be made anew.
bool drop_redundant_rows(System& system);

/// Scaled gradient of all rows kept (n_lambda, n_u) at y: rows by their own scale, columns by the
/// length or angle that counts as one.
SparseMatrix constraint_gradient(const System& system, const VectorX& y);

/// Degrees of freedom that the constraints leave at the start: n_u - rank.
Index mobility(const System& system);

} // namespace hydrodae::system
