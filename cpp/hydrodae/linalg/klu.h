#pragma once
/// Sparse LU by KLU (Davis and Palamadai Natarajan, ACM TOMS 37 (2010) 36), real or complex. The
/// order of the unknowns is found once, pivots are reused until they become bad.

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

  /// Values (nonzeros,), to be filled before `factorise`.
  std::vector<Scalar>& values();

  /// Factorises; returns false if the matrix is singular or has values that are not finite.
  /// `careful`: chooses new pivots also if a real matrix is ill-conditioned with the old ones.
  bool factorise(bool careful = false);

  /// Factorises with the old pivots, unchecked: the caller must check the residual of a solution,
  /// and call `factorise` if it is large. Returns false if there are no pivots or they do not fit.
  bool refactorise();

  /// Overwrites b (n,) with the solution.
  void solve(Scalar* b);

  /// Operations of a factorisation and of a solution, in scalars of this type.
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
