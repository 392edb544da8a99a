#pragma once
/// Factors of the saddle-point matrix by dense blocks:
///
///   [ M   G^T ]   M = U^T U of each set of bodies that feel each other's acceleration,
///   [ G   -eD ]   S = G M^-1 G^T (+ eD) of each set of rows that have such a set in common.
///
/// For a few large sets, which a general sparse matrix costs ten times as much. M must be
/// symmetric; where it is not, the residual shows it, and whoever solves with these factors looks
/// at the residual.

#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/dense_cholesky.h"

namespace hydrodae::linalg {

class BlockFactor {
public:
  /// Compressed columns (n + 1,) and rows (nonzeros,) of the matrix, whose first `n_u` are M.
  /// @param together of each of the first `n_u`: those with the same number are one set
  BlockFactor(const std::vector<Index>& column_start, const std::vector<Index>& row, Index n_u,
              const std::vector<Index>& together, const dense::Kernels& kernels = dense::kernels());

  /// Multiply-adds of a factorisation.
  double work() const;

  /// Those of any other factorisation at least: of the sets whose block of M is full.
  double least_work() const;

  /// From the values (nonzeros,) of the matrix with e = 0, and eD (n - n_u,), which is left out
  /// where S is regular without it.
  /// @return false when M is not positive definite
  bool factorise(const std::vector<double>& values, const VectorX& damping);

  /// Overwrites b (n,) with the solution.
  void solve(double* b);

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Place { ///< of an entry of the matrix in that of a set
    std::size_t value = 0;
    Index offset = 0;
  };
  struct Bodies {               ///< that feel each other's acceleration
    std::vector<Index> unknown; ///< (n,) in the matrix
    std::vector<Index> local;   ///< (m,) its rows, in those of the set of rows
    std::vector<Place> mass, gradient;
    std::size_t rows = 0; ///< the set of its rows
    bool whole = false;   ///< it has all rows of the set, in order
    Index n = 0, m = 0;   ///< padded
    RowMajor u, w;        ///< U; W = U^-T G^T
    RowMajor gram;        ///< W^T W, where it is not whole
    VectorX x, sum;       ///< (n,), (m,) scratch
  };
  struct Rows {
    std::vector<Index> unknown;
    Index m = 0; ///< padded
    RowMajor s;
    VectorX x;
  };
  void find_rows(const std::vector<Index>& column_start, const std::vector<Index>& row);
  void find_places(const std::vector<Index>& column_start, const std::vector<Index>& row);
  void allocate();
  bool factorise_rows(const VectorX* damping);

  const dense::Kernels& kernels_;
  Index n_u_ = 0, n_ = 0;
  std::vector<Bodies> bodies_;
  std::vector<Rows> rows_;
  std::vector<std::size_t> set_of_; ///< (n,) of an unknown: among the bodies, or among the rows
  std::vector<Index> local_;        ///< (n,) its number there
  bool allocated_ = false;
};

} // namespace hydrodae::linalg
