#include "hydrodae/statics/static_step.h"

#include <algorithm>

#include "hydrodae/linalg/klu.h"
#include "hydrodae/math/dense.h"

namespace hydrodae::statics {

namespace {

constexpr Index most_dense = 250; ///< unknowns of a dense solve

/// Columns of A + d diag(1, -1), with its factors.
linalg::SparseLu<double> shifted(const MatrixX& A, Index n_u, double d) {
  std::vector<Index> start{0}, row;
  std::vector<double> values;
  for (Index c = 0; c < A.cols(); ++c) {
    for (Index r = 0; r < A.rows(); ++r)
      if (r == c || A(r, c) != 0.0) {
        row.push_back(r);
        values.push_back(r != c ? A(r, c) : A(r, c) + (c < n_u ? d : -d));
      }
    start.push_back(static_cast<Index>(row.size()));
  }
  linalg::SparseLu<double> lu(start, row);
  lu.values() = values;
  return lu;
}

/// Pivot below which nothing holds a direction, as part of the largest. Next to a spring much
/// stiffer than weights over lengths, soft directions still hold, down to rounding.
double rank_threshold(const MatrixX& A) {
  constexpr double usual = 1e-12, soft = 1e-9, rounded = 1e-14;
  return std::clamp(soft / std::max(A.cwiseAbs().maxCoeff(), soft), rounded, usual);
}

} // namespace

VectorX smallest_solution(const MatrixX& A, const VectorX& b, Index n_u) {
  if (b.size() <= most_dense)
    return minimum_norm(A, b, rank_threshold(A));
  constexpr double shift = 1e-9, enough = 1e-13;
  constexpr int passes = 5;
  linalg::SparseLu<double> lu = shifted(A, n_u, shift);
  if (!lu.factorise())
    return VectorX::Constant(b.size(), INFINITY);
  VectorX x = VectorX::Zero(b.size()), left = b;
  for (int k = 0; k < passes && left.norm() > enough * b.norm(); ++k) {
    VectorX change = left;
    lu.solve(change.data());
    const VectorX now = b - A * (x + change);
    if (!(now.norm() < left.norm()))
      return k == 0 ? change : x; // the remainder has no solution
    x += change;
    left = now;
  }
  return x;
}

} // namespace hydrodae::statics
