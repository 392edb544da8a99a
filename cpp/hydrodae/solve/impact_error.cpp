#include "hydrodae/solve/impact_error.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

ImpactError::ImpactError(const system::Regime& s, Switching& switching, std::size_t which, double t,
                         const VectorX& y0, const VectorX& yp0, const VectorX& y1,
                         const VectorX& yp1)
    : s_(s), switching_(switching), which_(which), t_(t), y0_(y1), yp0_(yp1),
      jump_(y1.head(s.lambda0) - y0.head(s.lambda0)),
      slip_(yp0.head(s.lambda0) - yp1.head(s.lambda0)) {
  y0_.head(s.lambda0) = y0.head(s.lambda0);
  yp0_.head(s.lambda0) = yp0.head(s.lambda0);
  struck_ = switching_.motion_of(which_, t_, y0_, yp0_);
}

/// With the gap's change ds and its rate's dr the impact comes later by tau = -ds / s'; then
/// e+ = e + (f- - f+) tau, and the jump of the velocities, which goes with s', by the part
/// (dr + s'' tau) / s' of itself. Where s' is so low that the time would be that of a fall through
/// ds, it is no more than this.
void ImpactError::operator()(VectorX& change, const VectorX& unit) const {
  constexpr double small = 1e-6;
  const double size = (change.array() / unit.array()).abs().head(s_.z0).maxCoeff();
  if (!(size > 0.0) || !std::isfinite(size) || struck_.rate == 0.0)
    return;
  const double part = small / size;
  const auto moved = [&](double by) {
    VectorX y = y0_;
    y.head(s_.z0) += by * change.head(s_.z0);
    return switching_.motion_of(which_, t_, y, yp0_);
  };
  const Switching::Motion up = moved(part), down = moved(-part);
  const double ds = (up.value - down.value) / (2.0 * part),
               dr = (up.rate - down.rate) / (2.0 * part), pull = std::abs(struck_.acceleration),
               most = pull > 0.0 ? std::sqrt(2.0 * std::abs(ds) / pull) : INFINITY,
               late = std::clamp(-ds / struck_.rate, -most, most);
  change += late * slip_;
  change.segment(s_.u0, s_.n_u) +=
      (dr + struck_.acceleration * late) / struck_.rate * jump_.segment(s_.u0, s_.n_u);
}

} // namespace hydrodae::solve
