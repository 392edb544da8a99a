#pragma once
/// The linear algebra of static poses, where matrices may be singular: in directions that nothing
/// holds the smallest solution is wanted.

#include "hydrodae/core/types.h"

namespace hydrodae::statics {

/// Smallest x of A x = b (n,), A = [K, -G^T; G, 0] in units of one; infinite or no number when
/// it does not exist. Up to a few hundred unknowns by a dense factorisation with the rank; above
/// by a sparse one of A + d diag(1, -1), d next to nothing, and iterative refinement against A,
/// whose cost grows with the entries of A.
/// @param n_u rows of K
VectorX smallest_solution(const MatrixX& A, const VectorX& b, Index n_u);

} // namespace hydrodae::statics
