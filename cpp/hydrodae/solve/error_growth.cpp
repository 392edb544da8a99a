#include "hydrodae/solve/error_growth.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

ErrorGrowth::ErrorGrowth(const system::System& s, const system::Pattern& pattern, double t,
                         Error error, int every)
    : s_(s), e_(s, pattern, 1.0), error_(std::move(error)), y_(VectorX::Zero(s.n)),
      yp_(VectorX::Zero(s.n)), since_(t), every_(every) {
  if (error_.vector.size() > 0)
    return;
  error_.vector = error_.fresh = VectorX::Zero(s.lambda0);
  error_.piled = error_.plain = VectorX::Zero(s.n_groups);
}

/// Root of the sum of squares over the positions and velocities of each group.
VectorX ErrorGrowth::sizes(const VectorX& vector, const VectorX& unit) const {
  VectorX out = VectorX::Zero(s_.n_groups);
  for (Index i = 0; i < s_.z0; ++i) {
    const double x = vector[i] / unit[i];
    out[s_.group[static_cast<std::size_t>(i)]] += x * x;
  }
  return out.cwiseSqrt();
}

bool ErrorGrowth::add(double t, const VectorX& step_error, const VectorX& unit,
                      const Interpolant& at) {
  error_.fresh += step_error;
  if (++steps_ < every_)
    return false;
  steps_ = 0;
  const VectorX before = sizes(error_.vector, unit);
  if (!error_.vector.isZero(0.0) && error_.vector.allFinite()) {
    at(t, y_, yp_);
    if (carry(t, error_.vector)) {
      const VectorX after = sizes(error_.vector, unit);
      for (Index g = 0; g < s_.n_groups; ++g)
        if (before[g] > 0.0)
          error_.piled[g] *= after[g] / before[g];
    }
  }
  const VectorX added = sizes(error_.fresh, unit);
  error_.piled += added;
  error_.plain += added;
  error_.vector += error_.fresh;
  error_.fresh.setZero();
  since_ = t;
  return true;
}

/// The implicit midpoint rule on F_y d + F_y' d' = 0, with the derivatives at its end; memory
/// states by backward Euler, since some fade within the step; the constraints hold at its end.
bool ErrorGrowth::carry(double t, VectorX& vector) {
  const double h = t - since_;
  if (h <= 0.0)
    return false;
  const system::Pattern& p = e_.pattern;
  if (!lu_)
    lu_ = std::make_unique<SparseLu<double>>(p.column_start, p.row);
  e_.accept(t, y_, yp_);
  e_.jacobian(t, y_, yp_);
  rhs_.setZero(s_.n);
  std::vector<double>& values = lu_->values();
  for (Index c = 0; c < s_.n; ++c)
    for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k) {
      const Index row = p.row[k];
      const bool whole = row >= s_.z0 || c >= s_.lambda0; // else half at either end
      const double by_y = e_.parts.by_y[k], by_rate = e_.parts.by_yp[k] / h;
      values[k] = (whole ? by_y : 0.5 * by_y) + by_rate;
      if (row < s_.lambda0 && c < s_.lambda0)
        rhs_[row] += (by_rate - (whole ? 0.0 : 0.5 * by_y)) * vector[c];
    }
  if (!lu_->factorise())
    return false; // a singular pose: the error stays what it was until the next look
  lu_->solve(rhs_.data());
  constexpr double most = 1e3; // beyond, the constraints are about to become dependent
  if (!rhs_.allFinite() || rhs_.head(s_.n_q).norm() > most * vector.norm())
    return false;
  vector = rhs_.head(s_.lambda0);
  return true;
}

} // namespace hydrodae::solve
