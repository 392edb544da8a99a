#pragma once
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// A square matrix whose entries lie within `reach` of the diagonal, and its LU factors with
/// partial pivoting (Golub and Van Loan, Matrix Computations, section 4.3).
class BandMatrix {
public:
  BandMatrix(Index n, Index reach);

  void set_zero() { band_.setZero(); }
  /// Entry (i, j), |i - j| <= reach, until it is factorised.
  double& operator()(Index i, Index j) { return band_(2 * reach_ + i - j, j); }

  /// Factorises in place. @returns false if a pivot is zero or not finite
  bool factorise();
  /// Solves x = A^-1 x, column by column.
  void solve(Eigen::Ref<MatrixX> x) const;

private:
  Index n_, reach_;
  MatrixX band_; ///< (3 reach + 1, n): row 2 reach is the diagonal, those above take the fill
  std::vector<Index> pivot_;
};

} // namespace hydrodae
