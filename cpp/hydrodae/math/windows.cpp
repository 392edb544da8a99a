#include "hydrodae/math/windows.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace hydrodae {

double Windows::reach(double t, std::size_t& hint) const {
  if (t >= end || start.empty())
    return INFINITY;
  hint = std::min(hint, start.size() - 1);
  while (hint > 0 && start[hint] > t)
    --hint;
  const double rounding = 1e-12 * end;
  const auto stop = [&](std::size_t i) { return i + 1 < start.size() ? start[i + 1] : end; };
  while (hint + 1 < start.size() && stop(hint) <= t + rounding)
    ++hint;
  double latest = t + stop(hint) - start[hint];
  for (std::size_t i = hint + 1; i < start.size() && start[i] < latest; ++i)
    latest = std::min(latest, std::max(start[i], t + stop(i) - start[i]));
  return latest;
}

Windows smooth_windows(const std::vector<double>& values, double end, double flatness) {
  constexpr double noise = 1e-6; // of the whole range: rounding, and what splines ring
  struct Level {
    std::vector<double> low, high;
    std::vector<bool> smooth;
  };
  const std::size_t cells = values.size() - 1;
  std::vector<Level> levels(1);
  for (std::size_t i = 0; i < cells; ++i) {
    levels[0].low.push_back(std::min(values[i], values[i + 1]));
    levels[0].high.push_back(std::max(values[i], values[i + 1]));
    levels[0].smooth.push_back(true);
  }
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double least = noise * (*highest - *lowest);
  for (std::size_t size = 2; size <= cells; size *= 2) {
    const Level& below = levels.back();
    Level level;
    const std::size_t count = cells / size;
    for (std::size_t i = 0; i < count; ++i) {
      level.low.push_back(std::min(below.low[2 * i], below.low[2 * i + 1]));
      level.high.push_back(std::max(below.high[2 * i], below.high[2 * i + 1]));
    }
    for (std::size_t i = 0; i < count; ++i) {
      double low = level.low[i], high = level.high[i];
      for (std::size_t k = i >= 4 ? i - 4 : 0; k < std::min(count, i + 5); ++k) {
        low = std::min(low, level.low[k]);
        high = std::max(high, level.high[k]);
      }
      const double chord = 0.5 * (values[i * size] + values[(i + 1) * size]);
      level.smooth.push_back(below.smooth[2 * i] && below.smooth[2 * i + 1] &&
                             std::abs(values[i * size + size / 2] - chord) <=
                                 std::max(flatness * (high - low), least));
    }
    levels.push_back(std::move(level));
  }
  Windows out;
  out.end = end;
  const std::function<void(std::size_t, std::size_t)> cut = [&](std::size_t level, std::size_t i) {
    if (level == 0 || levels[level].smooth[i]) {
      out.start.push_back(end * static_cast<double>(i << level) / static_cast<double>(cells));
      return;
    }
    cut(level - 1, 2 * i);
    cut(level - 1, 2 * i + 1);
  };
  cut(levels.size() - 1, 0);
  return out;
}

} // namespace hydrodae
