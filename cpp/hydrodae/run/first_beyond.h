#pragma once
/// When, inside a step, does something first go beyond its limit?

#include <cmath>
#include <optional>

namespace hydrodae::run {

/// By bisection, after the first of `nodes` equal parts of the step from t0 to t1 that ends beyond.
/// @param is_beyond (double t) -> bool
/// @returns the first double that was seen beyond [s]; none when no part ends beyond
template <class IsBeyond>
std::optional<double> first_beyond(double t0, double t1, int nodes, IsBeyond&& is_beyond) {
  constexpr int bisections = 60;
  double a = t0;
  for (int node = 1; node <= nodes; ++node) {
    double b = node == nodes ? t1 : t0 + (t1 - t0) * node / nodes;
    if (!is_beyond(b)) {
      a = b;
      continue;
    }
    for (int i = 0; i < bisections && b - a > 1e-15 * std::abs(b); ++i) {
      const double middle = 0.5 * (a + b);
      (is_beyond(middle) ? b : a) = middle;
    }
    return b;
  }
  return std::nullopt;
}

} // namespace hydrodae::run
