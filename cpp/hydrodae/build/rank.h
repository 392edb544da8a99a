#pragma once
/// Rank and smallest solutions of sparse, possibly rank-deficient systems, one connected component
/// at a time: components of up to `dense_limit` rows and columns by dense orthogonal
/// decompositions, larger ones by sparse factorisations whose cost grows about linearly with the
/// length of a chain.

#include <Eigen/SparseCore>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::build {

using SparseMatrix = Eigen::SparseMatrix<double>;

inline constexpr Index usual_dense_limit = 120;

/// Rows and columns of a matrix that are coupled to each other, ascending. Columns and rows without
/// an entry belong to no component.
struct Component {
  std::vector<Index> rows, columns;
};

/// The connected components, in the order of their first column.
std::vector<Component> components(const SparseMatrix& matrix);

/// A row, and how far it is from the span of the rows of its component that come before it, in
/// lengths of rows.
struct RankedRow {
  Index row = 0;
  double pivot = 0.0;
};

/// All rows but empty ones, each component by falling pivots: greedily, the next is the row that
/// the ones before it leave most of. In large components the rows that are well away from all
/// others (pivot > 0.03) come first in the order of a sparse factorisation.
/// @param first  rows that come before the others of their component, by falling pivots among
///               themselves; empty: all are alike. Large components heed it where at most 200 rows
///               are others
std::vector<RankedRow> ranked_rows(const SparseMatrix& matrix, const std::vector<bool>& first = {},
                                   Index dense_limit = usual_dense_limit);

/// A largest set of independent rows, ascending; its size is the rank. A row counts as dependent
/// when what the others leave of it is below 1e-9 of the largest pivot of its component (dense), or
/// of its own length (sparse).
std::vector<Index> independent_rows(const SparseMatrix& matrix,
                                    Index dense_limit = usual_dense_limit);

/// The x of smallest norm among those that minimise |matrix x - b|. Directions in which the matrix
/// is singular up to rounding are left out (dense), or nearly so (sparse: damped by
/// s^2 / (s^2 + 1e-12) for a singular value s of the matrix with rows of length one, and repeated).
VectorX smallest_solution(const SparseMatrix& matrix, const VectorX& b,
                          Index dense_limit = usual_dense_limit);

/// x = G^T (G G^T + damping I)^-1 b with the rows of G, and b with them, scaled to length one: the
/// smallest solution, but that directions of singular values below sqrt(damping) hardly take part.
VectorX damped_solution(const SparseMatrix& matrix, const VectorX& b, double damping);

} // namespace hydrodae::build
