#pragma once
/// Detects a sampled loop that feeds itself: from some period or delay on, a held load puts energy
/// in (docs/control.md), and the swings of what the controller holds grow by the same factor on and
/// on.

#include <algorithm>
#include <cmath>
#include <deque>

#include "hydrodae/core/archive.h"

namespace hydrodae::run {

class SwingWatch {
public:
  /// The next answer.
  void add(double value) {
    if (value * last_ < 0.0) {
      peaks_.push_back(peak_);
      if (peaks_.size() > 2 * longest + 1)
        peaks_.pop_front();
      peak_ = 0.0;
    }
    peak_ = std::max(peak_, std::abs(value));
    if (value != 0.0)
      last_ = value;
  }

  struct Growth {
    std::size_t swings = 0; ///< half a cycle each; 0: no such growth
    double from = 0.0, to = 0.0;
  };

  /// Growth by `much` over some swings, and by as much over as many before: what a ramp, or a group
  /// of waves, brings slows down.
  Growth growth() const {
    for (const std::size_t n : windows) {
      if (peaks_.size() <= 2 * n)
        return {};
      const double now = peaks_.back(), then = *(peaks_.rbegin() + static_cast<long>(n)),
                   before = *(peaks_.rbegin() + static_cast<long>(2 * n));
      if (before > 0.0 && now > much * then && then > much * before)
        return {2 * n, before, now};
    }
    return {};
  }

  void remember(Archive& a) { a(last_, peak_, peaks_); }

private:
  static constexpr std::size_t windows[] = {3, 6, 15, 40, 100}, longest = 100; ///< swings
  static constexpr double much = 30.0;
  double last_ = 0.0, peak_ = 0.0;
  std::deque<double> peaks_; ///< largest value of each swing
};

} // namespace hydrodae::run
