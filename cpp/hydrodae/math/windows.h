#pragma once
/// Windows of time in which a sampled function is smooth: what a step may span without missing what
/// the function does.

#include <vector>

namespace hydrodae {

/// Consecutive windows that cover [0, end].
struct Windows {
  std::vector<double> start; ///< ascending, the first 0 [s]
  double end = 0.0;

  /// The latest time that a step from `t` may reach [s]: it may be as long as every window that it
  /// touches, and may always go up to the start of the next one. `hint` is where the last search
  /// ended. Infinite from `end` on.
  double reach(double t, std::size_t& hint) const;
};

/// Cuts [0, end] by halves until the middle of each window, and of all its parts, lies as near to
/// the chord as `flatness` of the range that the function has around it (eight windows wide).
/// @param values samples at equal steps from 0 to `end`, 2^k + 1 of them
Windows smooth_windows(const std::vector<double>& values, double end, double flatness = 0.05);

} // namespace hydrodae
