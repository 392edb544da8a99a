#pragma once
#include <algorithm>

#include "hydrodae/build/radiation_damping.h"
#include "hydrodae/math/dense_cholesky.h"

namespace hydrodae::build {

/// Largest number of multiplications of the sums over all entries
constexpr double sum_budget = 4e8;

/// Product table^T weights (n_frequencies, n_columns) for weights (n, n_frequencies); zeros pad the
/// columns of `weights` to whole registers.
/// @param fill  writes the column of that number of the table, zero at first
template <class Fill>
Damping::Rows weighted(const Damping::Rows& weights, Index n_frequencies, Index n_columns,
                       Fill&& fill) {
  using Rows = Damping::Rows;
  const Index strip = std::min<Index>(4 * dense::lanes, dense::padded(n_columns));
  Rows table(weights.rows(), strip), part(weights.cols(), strip), out(n_frequencies, n_columns);
  for (Index first = 0; first < n_columns; first += strip) {
    const Index count = std::min(strip, n_columns - first);
    table.setZero();
    part.setZero();
    for (Index i = 0; i < count; ++i)
      fill(first + i, table.col(i));
    dense::kernels().add_product(weights.rows(), weights.cols(), weights.data(), strip,
                                 table.data(), part.data());
    out.middleCols(first, count) = part.topLeftCorner(n_frequencies, count);
  }
  return out;
}

} // namespace hydrodae::build
