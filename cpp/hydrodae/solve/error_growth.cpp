#include "hydrodae/solve/error_growth.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

namespace {
constexpr double rough = 0.5; ///< change of the equations from which on growth is not believed
// Growth per radian of the motion that may come of looks far apart; chaotic motions have 0.2 to 1.
constexpr double doubtful = 0.05;
} // namespace

ErrorGrowth::ErrorGrowth(const system::System& s, const system::Pattern& pattern, double t,
                         const VectorX& y, const VectorX& yp, Error error, int every)
    : s_(s), e_(s, pattern, 1.0), error_(std::move(error)), y_(y), yp_(yp),
      growth_(VectorX::Ones(s.n_groups)), fade_(growth_), change_(VectorX::Zero(s.n_groups)),
      row_size_(s.n), since_(t), fewest_(std::max(1, every / 4)), most_(4 * every), every_(every) {
  linearise(t);
  if (error_.vector.size() > 0)
    return;
  error_.change = VectorX::Zero(s.n_groups);
  error_.vector = error_.fresh = VectorX::Zero(s.lambda0);
  error_.piled = error_.plain = error_.excess = VectorX::Zero(s.n_groups);
  error_.level = VectorX::Ones(s.n_groups);
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

/// The derivatives at a look, for the next.
void ErrorGrowth::linearise(double t) {
  e_.accept(t, y_, yp_);
  e_.jacobian(t, y_, yp_);
  by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
}

bool ErrorGrowth::add(double t, const VectorX& step_error, const VectorX& unit, const VectorX& rate,
                      bool last, const Interpolant& at) {
  error_.fresh += step_error;
  if (++steps_ < every_ && !last)
    return false;
  steps_ = 0;
  growth_.setOnes();
  fade_.setOnes();
  const VectorX before = sizes(error_.vector, unit);
  if (!error_.vector.isZero(0.0) && error_.vector.allFinite()) {
    at(t, y_, yp_);
    if (carry(t, error_.vector)) {
      const VectorX after = sizes(error_.vector, unit);
      for (Index g = 0; g < s_.n_groups; ++g) {
        if (before[g] > 0.0)
          growth_[g] = after[g] / before[g];
        follow(g, rate[g] * (t - since_));
      }
    }
  }
  // It tells growth only, and is kept from growing without end.
  constexpr double large = 1.0;
  const VectorX size = sizes(error_.vector, unit);
  for (Index i = 0; i < s_.lambda0; ++i)
    if (const double own = size[s_.group[static_cast<std::size_t>(i)]]; !(own <= large))
      error_.vector[i] = std::isfinite(own) ? 1e-3 * error_.vector[i] / own : 0.0;
  const VectorX added = sizes(error_.fresh, unit);
  error_.piled += added;
  error_.plain += added;
  error_.vector += error_.fresh;
  error_.fresh.setZero();
  since_ = t;
  return true;
}

/// What the growth of the vector means to what has piled up, over `phase` radians of the motion.
void ErrorGrowth::follow(Index g, double phase) {
  constexpr double held = 10.0; // 1 / rate of the motion: what fades slower is seen to fade
  const double growth = change_[g] > rough ? std::min(growth_[g], 1.0) : growth_[g];
  const double level = error_.level[g] * std::min(growth, 1e6),
               envelope = std::max(level, std::exp(-phase / held));
  error_.level[g] = std::max(level / envelope, 1e-300);
  fade_[g] = std::min(envelope, 1.0);
  const double before = error_.excess[g],
               seeming = doubtful * std::min(change_[g] / rough, 1.0) * phase;
  error_.excess[g] = std::max(0.0, before + std::log(std::max(growth, 1e-300)) - seeming);
  error_.piled[g] *= fade_[g] * std::exp(error_.excess[g] - before);
}

/// Of the entries of each row of q and u, relative to the largest of them. Between looks that are
/// too far apart errors would seem to grow that do not.
void ErrorGrowth::find_change() {
  constexpr double much = 0.25, little = 0.05;
  const system::Pattern& p = e_.pattern;
  change_.setZero();
  row_size_.setZero();
  const auto entries = [&](auto&& visit) {
    for (Index c = 0; c < s_.n; ++c)
      for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k)
        if (p.row[k] < s_.z0)
          visit(k, p.row[k], s_.group[static_cast<std::size_t>(p.row[k])]);
  };
  entries([&](Index k, Index row, int) {
    row_size_[row] = std::max({row_size_[row], std::abs(e_.parts.by_y[k]), std::abs(by_y_[k])});
  });
  entries([&](Index k, Index row, int group) {
    const double difference = std::abs(e_.parts.by_y[k] - by_y_[k]);
    if (difference > change_[group] * row_size_[row])
      change_[group] = difference / row_size_[row];
  });
  error_.change = error_.change.cwiseMax(change_);
  const double most = change_.size() > 0 ? change_.maxCoeff() : 0.0;
  if (most > much)
    every_ = std::max(fewest_, every_ / 2);
  else if (most < little)
    every_ = std::min(most_, every_ + 1 + every_ / 4);
}

/// The implicit midpoint rule on F_y d + F_y' d' = 0, with the mean of the derivatives at both
/// ends, lest what turns or swings between them feeds the error; memory states by backward Euler,
/// since some fade within the step; the constraints hold at its end.
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
      const bool moves = row < s_.z0, half = moves && c < s_.lambda0;
      const double by_y = moves ? 0.5 * (by_y_[k] + e_.parts.by_y[k]) : e_.parts.by_y[k],
                   by_rate =
                       (moves ? 0.5 * (by_rate_[k] + e_.parts.by_yp[k]) : e_.parts.by_yp[k]) / h;
      values[k] = (half ? 0.5 * by_y : by_y) + by_rate;
      if (row < s_.lambda0 && c < s_.lambda0)
        rhs_[row] += (by_rate - (half ? 0.5 * by_y : 0.0)) * vector[c];
    }
  find_change();
  by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
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
