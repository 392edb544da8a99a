#pragma once
/// Detects a sampled control loop that feeds itself: above some period or delay, a held load adds
/// energy (docs/control.md), and the swings of the output grow by a constant factor.

#include <algorithm>
#include <cmath>
#include <deque>

namespace hydrodae::run {

struct SwingWatch {
  double last = 0.0, peak = 0.0;
  std::deque<double> peaks; ///< largest value of each swing

  /// Takes the next output.
  void add(double value) {
    if (value * last < 0.0) {
      peaks.push_back(peak);
      if (peaks.size() > 2 * longest + 1)
        peaks.pop_front();
      peak = 0.0;
    }
    peak = std::max(peak, std::abs(value));
    if (value != 0.0)
      last = value;
  }

  struct Growth {
    std::size_t swings = 0; ///< number of swings, half a cycle each; 0: no growth
    double from = 0.0, to = 0.0;
  };

  /// Growth by `much` over a number of swings, and by the same over as many before. A ramp or a
  /// wave group grows more and more slowly.
  Growth growth() const {
    for (const std::size_t n : windows) {
      if (peaks.size() <= 2 * n)
        return {};
      const double now = peaks.back(), then = *(peaks.rbegin() + static_cast<long>(n)),
                   before = *(peaks.rbegin() + static_cast<long>(2 * n));
      if (before > 0.0 && now > much * then && then > much * before)
        return {2 * n, before, now};
    }
    return {};
  }

  static constexpr std::size_t windows[] = {3, 6, 15, 40, 100}, longest = 100; ///< swings
  static constexpr double much = 30.0;
};

} // namespace hydrodae::run
