#pragma once
/// Rank and smallest solutions of sparse, possibly rank-deficient systems, for each connected
/// component: up to `dense_limit` rows and columns by dense orthogonal decompositions, larger ones
/// by sparse factorisations whose cost grows about linearly with the length of a chain.

#include <Eigen/SparseCore>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::build {

using SparseMatrix = Eigen::SparseMatrix<double>;

inline constexpr Index usual_dense_limit = 120;

/// Coupled rows and columns of a matrix, ascending. Empty columns and rows belong to no component.
struct Component {
  std::vector<Index> rows, columns;
};

/// Connected components in the order of their first column.
std::vector<Component> components(const SparseMatrix& matrix);

/// Row with its distance from the span of the earlier rows of its component, relative to the length
/// of a row.
struct RankedRow {
  Index row = 0;
  double pivot = 0.0;
};

/// Nonempty rows, each component by decreasing pivots: the next row is the one with the largest
/// remainder after the earlier ones. In large components the rows well away from all others (pivot
/// > 0.03) come first, in the order of a sparse factorisation.
/// @param first  rows that precede the others of their component, by decreasing pivots among
/// themselves; empty: no precedence. Large components use it if at most 200 rows are others
std::vector<RankedRow> ranked_rows(const SparseMatrix& matrix, const std::vector<bool>& first = {},
                                   Index dense_limit = usual_dense_limit);

/// Largest set of independent rows, ascending; its size is the rank. A row counts as dependent if
/// its remainder after the others is below 1e-9 of the largest pivot of its component (dense), or
/// of its own length (sparse).
std::vector<Index> independent_rows(const SparseMatrix& matrix,
                                    Index dense_limit = usual_dense_limit);

/// Smallest x among the minimisers of |matrix x - b|. Directions in which the matrix is singular up
/// to rounding are omitted (dense), or nearly so (sparse: damped by s^2 / (s^2 + 1e-12) for a
/// singular value s of the matrix with rows of length one, and repeated).
VectorX smallest_solution(const SparseMatrix& matrix, const VectorX& b,
                          Index dense_limit = usual_dense_limit);

/// Damped solution x = G^T (G G^T + damping I)^-1 b, with the rows of G and b scaled to rows of
/// length one: the smallest solution, almost without directions of singular values below
/// sqrt(damping).
VectorX damped_solution(const SparseMatrix& matrix, const VectorX& b, double damping);

} // namespace hydrodae::build
