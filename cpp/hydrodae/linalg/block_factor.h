#pragma once
/// Factors of the saddle-point matrix in dense blocks:
///
///   [ M   G^T ]   M = U^T U for each set of bodies that act on each other's acceleration,
///   [ G   -eD ]   S = G M^-1 G^T (+ eD) for each set of rows on such a common set.
///
/// Suited to few large sets, for which a general sparse factorisation takes ten times as long. M
/// must be symmetric; otherwise the residual is large, and the caller must check it.

#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/dense_cholesky.h"

namespace hydrodae::linalg {

class BlockFactor {
public:
  /// @param column_start, row  compressed columns (n + 1,) and rows (nonzeros,) of the matrix
  /// @param n_u  number of unknowns of M, which come first
  /// @param together  set number of each of the first `n_u` unknowns
  BlockFactor(const std::vector<Index>& column_start, const std::vector<Index>& row, Index n_u,
              const std::vector<Index>& together, const dense::Kernels& kernels = dense::kernels());

  /// Number of multiply-adds of a factorisation.
  double work() const;

  /// Lower bound of the multiply-adds of any other factorisation, from sets with a full block of M.
  double least_work() const;

  /// Factorises the values (nonzeros,) of the matrix with e = 0, and eD (n - n_u,), which is
  /// omitted if S is regular without it.
  /// @return false if M is not positive definite
  bool factorise(const std::vector<double>& values, const VectorX& damping);

  /// Overwrites b (n,) with the solution.
  void solve(double* b);

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Place { ///< place of a matrix entry in the matrix of a set
    std::size_t value = 0;
    Index offset = 0;
  };
  struct Run { ///< entries with consecutive places
    std::size_t value = 0;
    Index offset = 0, count = 0;
  };
  struct Bodies {               ///< set of bodies that act on each other's acceleration
    std::vector<Index> unknown; ///< (n,) unknowns in the matrix
    std::vector<Index> local;   ///< (m,) its rows, numbered in the set of rows
    std::vector<Run> mass;      ///< triangle of M
    Index n_mass = 0;           ///< number of its entries
    std::vector<Place> gradient;
    std::size_t rows = 0; ///< number of its set of rows
    bool whole = false;   ///< true: it has all rows of the set, in order
    Index n = 0, m = 0;   ///< padded sizes
    RowMajor u, w;        ///< U; W = U^-T G^T
    RowMajor gram;        ///< W^T W, if not `whole`
    VectorX x, sum;       ///< (n,), (m,) scratch
  };
  struct Rows {
    std::vector<Index> unknown;
    Index m = 0; ///< padded size
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
  /// (n,) For each unknown the number of its set: bodies, or constraint rows.
  std::vector<std::size_t> set_of_;
  std::vector<Index> local_; ///< (n,) number within that set
  bool allocated_ = false;
};

} // namespace hydrodae::linalg
