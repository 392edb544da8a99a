#pragma once
/// Linear dispersion relation w^2 = g k tanh(k h).

#include <cmath>

namespace hydrodae::sea {

/// Wavenumber k [rad/m] of waves of frequency w > 0 [rad/s] in water of depth h [m] (may be
/// infinite). Newton's method on x tanh x = w^2 h / g from above or from the shallow limit, where
/// it converges monotonically.
inline double wavenumber(double omega, double depth, double gravity) {
  const double deep = omega * omega / gravity;
  if (!std::isfinite(depth))
    return deep;
  const double a = deep * depth;
  double x = a > 1.0 ? a : std::sqrt(a);
  for (int k = 0; k < 30; ++k) {
    const double t = std::tanh(x), step = (x * t - a) / (t + x * (1.0 - t * t));
    x -= step;
    if (std::abs(step) <= 1e-15 * x)
      break;
  }
  return x / depth;
}

} // namespace hydrodae::sea
