#pragma once
/// Detects a sampled loop that feeds itself: from some period or delay on, a held load puts energy
/// in (docs/control.md), and the swings of what the controller holds grow by the same factor on and
/// on.

#include <algorithm>
#include <cmath>
#include <deque>

namespace hydrodae::run {

struct SwingWatch {
  double last = 0.0, peak = 0.0;
  std::deque<double> peaks; ///< largest value of each swing

  /// The next answer.
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
    std::size_t swings = 0; ///< half a cycle each; 0: no such growth
    double from = 0.0, to = 0.0;
  };

  /// Growth by `much` over some swings, and by as much over as many before: what a ramp, or a group
  /// of waves, brings slows down.
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
