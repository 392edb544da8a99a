#include "hydrodae/math/band_matrix.h"

#include <algorithm>
#include <cmath>

namespace hydrodae {

BandMatrix::BandMatrix(Index n, Index reach)
    : n_(n), reach_(std::min(reach, std::max<Index>(n - 1, 0))),
      band_(MatrixX::Zero(3 * reach_ + 1, n)), pivot_(static_cast<std::size_t>(n)) {}

bool BandMatrix::factorise() {
  const Index diagonal = 2 * reach_;
  for (Index k = 0; k < n_; ++k) {
    const Index below = std::min(reach_, n_ - 1 - k), right = std::min(2 * reach_, n_ - 1 - k);
    Index at = 0;
    band_.col(k).segment(diagonal, below + 1).cwiseAbs().maxCoeff(&at);
    pivot_[static_cast<std::size_t>(k)] = k + at;
    const double pivot = band_(diagonal + at, k);
    if (pivot == 0.0 || !std::isfinite(pivot))
      return false;
    if (at != 0)
      for (Index j = k; j <= k + right; ++j)
        std::swap((*this)(k, j), (*this)(k + at, j));
    auto factors = band_.col(k).segment(diagonal + 1, below);
    factors /= pivot;
    for (Index j = k + 1; j <= k + right; ++j)
      if (const double above = (*this)(k, j); above != 0.0)
        band_.col(j).segment(diagonal + k + 1 - j, below) -= above * factors;
  }
  return true;
}

void BandMatrix::solve(Eigen::Ref<MatrixX> x) const {
  const Index diagonal = 2 * reach_;
  for (Index c = 0; c < x.cols(); ++c) {
    auto b = x.col(c);
    for (Index k = 0; k < n_; ++k) {
      std::swap(b[k], b[pivot_[static_cast<std::size_t>(k)]]);
      const Index below = std::min(reach_, n_ - 1 - k);
      b.segment(k + 1, below) -= b[k] * band_.col(k).segment(diagonal + 1, below);
    }
    for (Index k = n_ - 1; k >= 0; --k) {
      b[k] /= band_(diagonal, k);
      const Index above = std::min(2 * reach_, k);
      b.segment(k - above, above) -= b[k] * band_.col(k).segment(diagonal - above, above);
    }
  }
}

} // namespace hydrodae
