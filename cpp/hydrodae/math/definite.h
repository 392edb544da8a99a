#pragma once
/// Positive definiteness of symmetric and Hermitian matrices with one sparse pattern.

#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// The unknowns are put into levels (Cuthill and McKee, Proc. 24th ACM Conf. (1969) 157), so that
/// each level is coupled with itself and with the levels beside it alone. The Cholesky
/// decomposition of this block tridiagonal matrix needs the dense blocks of two levels at a time,
///   S_k = A_kk - A_k,k-1 S_k-1^-1 A_k-1,k,
/// and the matrix is positive definite if all S_k are.
class Definite {
public:
  struct Place { ///< entry of the lower triangle: row >= column
    Index row = 0, column = 0;
    bool operator==(const Place&) const = default;
  };

  /// @param places  pattern of the lower triangle, each place once
  Definite(Index n, std::vector<Place> places);

  /// True if the matrix R + i I plus `shift` is positive definite, which its real form
  /// [R, -I; I, R] then is as well.
  /// @param real, imaginary  values of the places; no `imaginary`, null, for a real matrix
  bool test(const double* real, const double* imaginary, double shift = 0.0) const;

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Level {
    Index n = 0;                          ///< number of unknowns
    std::vector<std::size_t> own, before; ///< entries within it, and with the level before
  };
  struct Values {
    const double* real;
    const double* imaginary;
    Index padded(Index n) const; ///< rows of the blocks of a level with n unknowns
  };
  RowMajor own_block(const Level& level, const Values& values, double shift) const;
  RowMajor block_before(const Level& level, Index n_before, const Values& values) const;

  std::vector<Place> places_;
  std::vector<Index> local_;       ///< (n,) number of an unknown in its level
  std::vector<std::size_t> level_; ///< (n,) number of the level of an unknown
  std::vector<Level> levels_;
};

} // namespace hydrodae
