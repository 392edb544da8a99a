#include "hydrodae/ensemble/lane_cholesky.h"

#include <cmath>

#include "hydrodae/ensemble/lane_kernels.h"

namespace hydrodae::ensemble {

void LaneCholesky::resize(Index n) {
  n_ = n;
  entries_.assign(static_cast<std::size_t>(n * n), Lanes(0.0));
  reciprocal_.assign(static_cast<std::size_t>(n), Lanes(1.0));
}

void LaneCholesky::factorise(double least, std::array<bool, width>& sound) {
  Lanes sums[4];
  for (Index i = 0; i < n_; ++i) {
    Lanes* a = entries_.data() + i * n_;
    Index j = 0;
    for (; j + 4 <= i; j += 4) {
      const Lanes* const rows[4] = {row(j), row(j + 1), row(j + 2), row(j + 3)};
      lane_kernels().dots(a, rows, j, sums);
      for (Index k = 0; k < 4; ++k) {
        for (Index m = 0; m < k; ++m)
          sums[k] += a[j + m] * rows[k][j + m];
        a[j + k] = (a[j + k] - sums[k]) * reciprocal_[static_cast<std::size_t>(j + k)];
      }
    }
    for (; j < i; ++j)
      a[j] = (a[j] - dot(a, row(j), j)) * reciprocal_[static_cast<std::size_t>(j)];
    const Lanes entry = a[i];
    Lanes pivot = entry - dot(a, a, i);
    for (int k = 0; k < width; ++k)
      if (!(pivot[k] > least * entry[k])) {
        sound[static_cast<std::size_t>(k)] = false;
        pivot[k] = std::isfinite(entry[k]) && entry[k] > 0.0 ? entry[k] : 1.0;
      }
    a[i] = sqrt(pivot);
    reciprocal_[static_cast<std::size_t>(i)] = Lanes(1.0) / a[i];
  }
}

void LaneCholesky::solve_forward(Lanes* x, Index from) const {
  for (Index i = from; i < n_; ++i)
    x[i] =
        (x[i] - dot(row(i) + from, x + from, i - from)) * reciprocal_[static_cast<std::size_t>(i)];
}

void LaneCholesky::solve_forward(Lanes* const* x, Index from) const {
  Lanes sums[4];
  for (Index i = from; i < n_; ++i) {
    const Lanes* const vectors[4] = {x[0] + from, x[1] + from, x[2] + from, x[3] + from};
    lane_kernels().dots(row(i) + from, vectors, i - from, sums);
    for (int k = 0; k < 4; ++k)
      x[k][i] = (x[k][i] - sums[k]) * reciprocal_[static_cast<std::size_t>(i)];
  }
}

HYDRODAE_WIDE void LaneCholesky::solve_backward(Lanes* x) const {
  for (Index i = n_ - 1; i >= 0; --i) {
    x[i] *= reciprocal_[static_cast<std::size_t>(i)];
    const Lanes* a = row(i);
    for (Index k = 0; k < i; ++k)
      x[k] -= a[k] * x[i];
  }
}

} // namespace hydrodae::ensemble
