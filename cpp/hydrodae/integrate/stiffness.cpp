#include "hydrodae/integrate/stiffness.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/linalg/saddle_point.h"

namespace hydrodae::integrate {

namespace {

/// Size of one unit of each position, velocity and memory state, independent of the present motion
/// (lambda0,).
VectorX full_scales(const system::Regime& s) {
  VectorX out = s.scale.head(s.lambda0);
  for (Index i = 0; i < s.lambda0; ++i)
    if (const int g = s.group[static_cast<std::size_t>(i)]; g >= 0 && !s.is_absolute(i))
      out[i] /= s.motion_scale[g];
  return out;
}

/// Numbers in [-1, 1] without a pattern, the same on every machine.
VectorX scattered(Index n) {
  constexpr double golden = 0.6180339887498949;
  VectorX out(n);
  for (Index i = 0; i < n; ++i)
    out[i] = 2.0 * std::fmod(golden * static_cast<double>(i + 1), 1.0) - 1.0;
  return out;
}

} // namespace

double fastest_rate(const system::Regime& s, const system::Pattern& pattern, double t,
                    const VectorX& y, const VectorX& yp) {
  // growth is measured between these counts, as that of pairs of values
  constexpr int first = 4, last = 14;
  constexpr double little = 1e-6; // step of the differences, as part of the scales
  linalg::Equations equations(s, pattern, 1.0);
  equations.accept(t, y, yp);
  linalg::SaddlePoint saddle(equations);
  const Index n = s.lambda0;
  const Eigen::ArrayXd scale = full_scales(s).array();
  VectorX at = y, rates = yp, v = scattered(n);
  if (!saddle.accelerations(t, at, rates))
    return INFINITY;
  const VectorX here = rates.head(n);
  double grown = 0.0; // ln of it
  for (int k = 0; k < last; ++k) {
    const double size = v.norm();
    if (!(size > 0.0))
      return 0.0;
    if (k >= first)
      grown += std::log(size);
    v /= size;
    at.head(n) = y.head(n).array() + little * scale * v.array();
    if (!saddle.accelerations(t, at, rates))
      return INFINITY;
    v = (rates.head(n) - here).array() / (little * scale);
  }
  return v.norm() > 0.0 ? std::exp((grown + std::log(v.norm())) / (last - first + 1)) : 0.0;
}

double motion_rate(const system::Regime& s, const VectorX& y) {
  double rate = 0.0;
  for (const system::BodyData& b : s.bodies) {
    if (b.n_active == 0)
      continue;
    rate = std::max(rate, 1.0 / b.time_scale);
    for (int k = 0; k < b.n_active; ++k)
      rate = std::max(rate, std::abs(y[b.u0 + k]) / (b.active[k] < 3 ? b.lever : 1.0));
  }
  return rate;
}

} // namespace hydrodae::integrate
