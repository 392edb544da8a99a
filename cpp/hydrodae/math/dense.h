#pragma once
/// Decompositions of dense matrices where ranks matter, or where cost does not. They stand in one
/// file since Eigen's take long to compile; inner loops keep factors of their own.

#include <utility>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Thresholds are relative to the largest pivot; this one is Eigen's own, about the rounding.
inline constexpr double by_rounding = -1.0;

/// Solution X of A X = B, by an LU decomposition with partial pivoting. A is square and regular.
MatrixX solve_square(const MatrixX& A, const MatrixX& B);
Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

Eigen::MatrixXcd product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B);

/// T' A T with a real T.
Eigen::MatrixXcd congruence(const MatrixX& T, const Eigen::MatrixXcd& A);

/// Minimiser X of |A X - B|, one of them if A lacks rank (column-pivoted QR).
MatrixX least_squares(const MatrixX& A, const MatrixX& B);

/// Smallest x among the minimisers of |A x - b| (complete orthogonal decomposition).
VectorX minimum_norm(const MatrixX& A, const VectorX& b, double threshold = by_rounding);

/// Orthonormal columns that span {x : G x = 0} (n, n - rank).
MatrixX null_space(const MatrixX& G, double threshold = by_rounding);

/// Columns of A in the order in which a column-pivoted QR takes them, and the sizes of its pivots,
/// zero beyond the number of rows.
struct PivotedColumns {
  std::vector<Index> order;
  VectorX pivots;
};
PivotedColumns pivoted_columns(const MatrixX& A);

/// Eigenvalues of a symmetric matrix, ascending.
VectorX symmetric_eigenvalues(const MatrixX& A);

/// Real parts of the eigenvalues of a square matrix, in no order.
VectorX real_parts_of_eigenvalues(const MatrixX& A);

/// The smallest eigenvalue of a Hermitian matrix, of which only the lower triangle is read, and its
/// eigenvector of length one.
std::pair<double, Eigen::VectorXcd> lowest_eigenpair(const Eigen::MatrixXcd& A);

} // namespace hydrodae
