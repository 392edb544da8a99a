#pragma once
/// Sparse LU by KLU (Davis and Palamadai Natarajan, ACM TOMS 37 (2010) 36), real or complex: the
/// order of the unknowns once, pivots once, after that only numbers, until the pivots go bad.

#include <complex>
#include <memory>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::linalg {

template <class Scalar> class SparseLu {
public:
  /// Compressed columns (n + 1,) and rows (nonzeros,) of a square matrix.
  SparseLu(const std::vector<Index>& column_start, const std::vector<Index>& row);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) = delete;

  /// The values (nonzeros,), to be filled before `factorise`.
  std::vector<Scalar>& values();

  /// False when the matrix is singular or holds values that are not finite. `careful`: new pivots
  /// also where a real matrix is ill-conditioned with those of before.
  bool factorise(bool careful = false);

  /// With the pivots of before, which are not looked at: whoever calls it judges the residual of a
  /// solution, and calls `factorise` where that is large. False where they are missing or do
  /// not fit.
  bool refactorise();

  /// Overwrites b (n,) with the solution.
  void solve(Scalar* b);

  /// Operations of a factorisation and of a solution, of numbers of this kind.
  struct Work {
    double factorise = 0.0, solve = 0.0;
  };
  Work work() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class SparseLu<double>;
extern template class SparseLu<std::complex<double>>;

} // namespace hydrodae::linalg
