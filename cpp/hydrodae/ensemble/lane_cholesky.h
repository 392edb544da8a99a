#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "hydrodae/ensemble/lanes.h"

namespace hydrodae::ensemble {

/// A symmetric positive definite matrix in lanes, by its Cholesky factor L.
class LaneCholesky {
public:
  void resize(Index n);
  Index size() const { return n_; }
  void set_zero() { std::fill(entries_.begin(), entries_.end(), Lanes(0.0)); }
  /// Entry of the lower triangle, column <= row.
  Lanes& at(Index row, Index column) {
    return entries_[static_cast<std::size_t>(row * n_ + column)];
  }

  /// M = L L^T. A pivot below `least` of its entry is replaced by that entry, and its lane is
  /// cleared in `sound`.
  void factorise(double least, std::array<bool, width>& sound);

  /// x := L^-1 x where x is zero before `from`, and x := L^-T x.
  void solve_forward(Lanes* x, Index from = 0) const;
  /// Solves for four vectors.
  void solve_forward(Lanes* const* x, Index from) const;
  void solve_backward(Lanes* x) const;

private:
  const Lanes* row(Index i) const { return entries_.data() + i * n_; }
  Index n_ = 0;
  std::vector<Lanes> entries_;    ///< (n, n) by rows; the lower triangle counts
  std::vector<Lanes> reciprocal_; ///< (n,) 1 / L_ii
};

} // namespace hydrodae::ensemble
