#pragma once
/// Linear algebra of static poses with possibly singular matrices: in directions that nothing holds
/// the smallest solution is taken.

#include "hydrodae/core/types.h"

namespace hydrodae::statics {

/// Smallest x of A x = b (n,), A = [K, -G^T; G, 0] in scaled units; infinite or NaN if it does not
/// exist. Up to a few hundred unknowns a dense factorisation with the rank is used. Above that it
/// is a sparse one of A + d diag(1, -1) with tiny d, and iterative refinement against A; the cost
/// grows with the entries of A.
/// @param n_u  rows of K
VectorX smallest_solution(const MatrixX& A, const VectorX& b, Index n_u);

} // namespace hydrodae::statics
