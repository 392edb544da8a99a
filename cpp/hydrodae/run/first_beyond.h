#pragma once
/// When, inside a step, does something first go beyond its limit?

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

namespace hydrodae::run {

/// Looks at the ends of `nodes` equal parts of the step from t0 to t1, and inside a part for a peak
/// where its ends are not far from the limit and it rises at the first and falls at the last.
/// @param measure (double t) -> double: beyond from 0 on, -1 where nothing acts
/// @returns the first double that was seen beyond, by bisection [s]; none where nothing was
template <class Measure>
std::optional<double> first_beyond(double t0, double t1, int nodes, Measure&& measure) {
  static_assert(std::is_same_v<decltype(measure(t0)), double>);
  constexpr int halvings = 60;
  constexpr double near = -0.3, shift = 1e-3; // of the measure, of a part
  const auto bisect = [&](double a, double b) {
    for (int i = 0; i < halvings && b - a > 1e-15 * std::abs(b); ++i) {
      const double middle = 0.5 * (a + b);
      (measure(middle) >= 0.0 ? b : a) = middle;
    }
    return b;
  };
  double a = t0, at_a = measure(t0);
  for (int node = 1; node <= nodes; ++node) {
    const double b = node == nodes ? t1 : t0 + (t1 - t0) * node / nodes, at_b = measure(b);
    if (at_b >= 0.0)
      return bisect(a, b);
    const double h = shift * (b - a);
    if (std::max(at_a, at_b) > near && measure(a + h) > at_a && measure(b - h) > at_b) {
      double left = a, right = b;
      for (int i = 0; i < halvings && right - left > 4.0 * h * shift; ++i) {
        const double middle = 0.5 * (left + right), at_middle = measure(middle);
        if (at_middle >= 0.0)
          return bisect(a, middle);
        (measure(middle + h * shift) > at_middle ? left : right) = middle;
      }
    }
    a = b;
    at_a = at_b;
  }
  return std::nullopt;
}

} // namespace hydrodae::run
