#include "hydrodae/system/kinks.h"

#include <algorithm>
#include <limits>

namespace hydrodae::system {

namespace {

constexpr int highest_order = 13; ///< highest order of the methods with adaptive steps

/// Rounding error of t [s]: instants that differ by less are equal.
double rounding_of(double t) {
  return 256.0 * std::numeric_limits<double>::epsilon() * std::abs(t);
}

} // namespace

/// Error of a step h over a jump of the m-th derivative: (h / T)^m / m! of the size of the motion,
/// whose m-th derivative is that size over T^m. Jumps with an error below the tolerance are
/// ignored.
Kinks::Kinks(std::vector<double> delays, double time, double longest, double rtol)
    : delays_(std::move(delays)) {
  double missed = 1.0;
  for (int m = 1; m <= highest_order + 1; ++m) {
    missed *= longest / (time * m);
    if (missed > rtol)
      highest_ = m;
  }
}

void Kinks::expect(double t, int derivative) {
  if (derivative > highest_)
    return;
  const auto at = std::lower_bound(state_.coming.begin(), state_.coming.end(), t - rounding_of(t),
                                   [](const Kink& k, double time) { return k.t < time; });
  if (at != state_.coming.end() && at->t <= t + rounding_of(t))
    at->derivative = std::min(at->derivative, derivative);
  else
    state_.coming.insert(at, {t, derivative});
}

void Kinks::add(double t, int derivative) {
  for (const double delay : delays_)
    expect(t + delay, derivative + 1);
}

int Kinks::pass(double t) {
  int lowest = none;
  while (!state_.coming.empty() && state_.coming.front().t <= t + rounding_of(t)) {
    const Kink kink = state_.coming.front();
    state_.coming.erase(state_.coming.begin());
    if (kink.t >= t - rounding_of(t))
      lowest = std::min(lowest, kink.derivative);
    add(kink.t, kink.derivative);
  }
  return lowest;
}

/// Next kink for a method of order p, which is sensitive to derivatives of s up to p + 1: the
/// effect of a jump in a higher one is below the method's own error.
double Kinks::next(int order) const {
  for (const Kink& kink : state_.coming)
    if (kink.derivative <= order + 1)
      return kink.t;
  return INFINITY;
}

} // namespace hydrodae::system
