#pragma once
/// Cubic B-splines on the uniform grid x = 0, 1, .. n - 1: f(x) = sum_k c_k b(x - k + 1).

#include <array>
#include <cmath>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Weights of c_k .. c_(k+3) at x = k + u, 0 <= u < 1.
inline std::array<double, 4> bspline_weights(double u) {
  const double v = 1.0 - u, u2 = u * u, u3 = u2 * u;
  return {v * v * v / 6.0, (3.0 * u3 - 6.0 * u2 + 4.0) / 6.0,
          (-3.0 * u3 + 3.0 * u2 + 3.0 * u + 1.0) / 6.0, u3 / 6.0};
}

/// Coefficients c (n + 2,) of the spline through n >= 4 samples (c_k + 4 c_(k+1) + c_(k+2)) / 6 =
/// f_k, without a knot at x = 1 and with f'' = 0 at the end.
inline VectorX bspline_coefficients(const VectorX& f) {
  const Eigen::Index n = f.size();
  VectorX c(n + 2);
  c[2] = (8.0 * f[1] - f[0] - f[2]) / 6.0; // from equal third derivatives on both sides of x = 1
  c[n] = f[n - 1];
  // Rows k = 2 .. n - 2 for c_3 .. c_(n-1), by Thomas' algorithm; c holds the right-hand sides.
  VectorX upper = VectorX::Zero(n + 1);
  for (Eigen::Index k = 3; k < n; ++k) {
    double rhs = 6.0 * f[k - 1];
    if (k == n - 1)
      rhs -= c[n];
    const double pivot = 4.0 - upper[k - 1];
    upper[k] = 1.0 / pivot;
    c[k] = (rhs - c[k - 1]) / pivot;
  }
  for (Eigen::Index k = n - 2; k >= 3; --k)
    c[k] -= upper[k] * c[k + 1];
  c[1] = 6.0 * f[1] - 4.0 * c[2] - c[3];
  c[0] = 6.0 * f[0] - 4.0 * c[1] - c[2];
  c[n + 1] = 2.0 * c[n] - c[n - 1];
  return c;
}

} // namespace hydrodae
