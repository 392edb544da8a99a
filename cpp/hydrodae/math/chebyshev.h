#pragma once
/// Polynomials on [0, 1] by their values at Chebyshev points, ends among them.

#include <cmath>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// x_k = (1 - cos(k pi / (n - 1))) / 2 (n,), n >= 2.
inline VectorX chebyshev_points(Eigen::Index n) {
  VectorX x(n);
  for (Eigen::Index k = 0; k < n; ++k)
    x[k] = 0.5 * (1.0 - std::cos(pi * static_cast<double>(k) / static_cast<double>(n - 1)));
  return x;
}

/// Factors (n,) of the values at those points that give the polynomial through them at x: the
/// barycentric formula with weights (-1)^k, halved at the ends (Berrut and Trefethen, SIAM Review
/// 46 (2004) 501).
inline void chebyshev_weights(const VectorX& points, double x, VectorX& out) {
  const Eigen::Index n = points.size();
  out.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double distance = x - points[k];
    if (distance == 0.0) {
      out = VectorX::Unit(n, k);
      return;
    }
    const double end = k == 0 || k == n - 1 ? 0.5 : 1.0;
    out[k] = (k % 2 == 0 ? end : -end) / distance;
  }
  out /= out.sum();
}

} // namespace hydrodae
