#include "hydrodae/solve/linear_flow.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

LinearFlow::LinearFlow(const system::Regime& s, const system::Pattern& pattern, double t,
                       const VectorX& y, const VectorX& yp)
    : s_(s), pattern_(condensed(s, pattern)), e_(s, pattern_, 1.0), mean_(pattern_),
      first_u_(y.segment(s.u0, s.n_u)), u_(first_u_), row_size_(s.n), time_(t) {
  e_.accept(t, y, yp);
  e_.jacobian(t, y, yp);
  before_ = first_by_y_ = by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
}

/// The implicit midpoint rule with the mean of the derivatives at both looks, lest what turns or
/// swings between them feeds the change; memory states by backward Euler, since some fade within a
/// substep; the constraints hold at its end, and so do the loads of states of forces, which may
/// fade within a thousandth of it. Rows of motions count twice, as (K + 2 M / h) d = ...
bool LinearFlow::look(double t, const VectorX& y, const VectorX& yp, int substeps) {
  h_ = (t - time_) / substeps;
  if (!matrix_)
    matrix_ = std::make_unique<NewtonMatrix<double>>(s_, pattern_);
  e_.accept(t, y, yp);
  e_.jacobian(t, y, yp);
  const double alpha = 2.0 / h_;
  from_.assign(by_y_.size(), 0.0);
  for (Index c = 0; c < s_.n; ++c)
    for (Index k = pattern_.column_start[c]; k < pattern_.column_start[c + 1]; ++k) {
      const Index row = pattern_.row[k];
      const bool of_force = c >= s_.z0 && c < s_.memory0 && !s_.is_absolute(c);
      double &by_y = mean_.by_y[k], &by_rate = mean_.by_yp[k];
      by_y = e_.parts.by_y[k];
      by_rate = 0.5 * e_.parts.by_yp[k];
      if (s_.is_motion(row)) {
        by_y = (of_force ? 1.0 : 0.5) * (by_y + by_y_[k]);
        by_rate += 0.5 * by_rate_[k];
        if (c < s_.lambda0)
          from_[k] = alpha * by_rate - (of_force ? 0.0 : by_y);
      } else if (row < s_.memory0 && c < s_.lambda0) {
        from_[k] = alpha * by_rate;
      }
    }
  mean_.memory = e_.parts.memory;
  before_.swap(by_y_);
  by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
  u_ = y.segment(s_.u0, s_.n_u);
  time_ = t;
  return matrix_->factorise(mean_, {alpha, alpha, 1.0 / h_});
}

void LinearFlow::keep(Look& out) const {
  out.by_y = by_y_;
  out.by_rate = by_rate_;
  out.before = before_;
  out.u = u_;
  out.time = time_;
}

void LinearFlow::go_back(const Look& to) {
  by_y_ = to.by_y;
  by_rate_ = to.by_rate;
  before_ = to.before;
  u_ = to.u;
  time_ = to.time;
}

bool LinearFlow::step(VectorX& change) {
  constexpr double most = 1e3;
  rhs_.setZero(s_.n);
  for (Index c = 0; c < s_.lambda0; ++c)
    for (Index k = pattern_.column_start[c]; k < pattern_.column_start[c + 1] && change[c] != 0.0;
         ++k)
      rhs_[pattern_.row[k]] += from_[k] * change[c];
  if (s_.has_memory()) {
    const Index n = s_.lambda0 - s_.memory0;
    rhs_.segment(s_.memory0, n) = change.segment(s_.memory0, n) / h_;
    matrix_->subtract_memory_loads(change.segment(s_.memory0, n), rhs_.data());
  }
  matrix_->solve(rhs_.data());
  if (!rhs_.allFinite() || rhs_.head(s_.n_q).norm() > most * change.norm())
    return false;
  change = rhs_.head(s_.lambda0);
  return true;
}

VectorX LinearFlow::effect(const VectorX& change) {
  rhs_.setZero(s_.n);
  for (Index c = 0; c < s_.lambda0; ++c)
    for (Index k = pattern_.column_start[c]; k < pattern_.column_start[c + 1]; ++k) {
      const Index row = pattern_.row[k];
      rhs_[row] += (s_.is_motion(row) ? 2.0 : 1.0) * (by_y_[k] - before_[k]) * change[c];
    }
  matrix_->solve(rhs_.data());
  return rhs_.head(s_.lambda0);
}

void LinearFlow::compare(const VectorX& rate, VectorX& since_last, VectorX& since_first) {
  const system::Pattern& p = pattern_;
  since_last.setZero(s_.n_error_groups());
  row_size_.setZero();
  const auto entries = [&](auto&& visit) {
    for (Index c = 0; c < s_.lambda0; ++c)
      for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k)
        if (p.row[k] >= s_.u0 && s_.is_motion(c) && p.row[k] < s_.lambda0 && s_.is_motion(p.row[k]))
          visit(k, p.row[k], c, s_.scale[c]);
  };
  entries([&](Index k, Index row, Index, double scale) {
    const double inertia =
        std::abs(by_rate_[k]) * rate[s_.error_group[static_cast<std::size_t>(row)]];
    row_size_[row] =
        std::max({row_size_[row], scale * std::abs(by_y_[k]), scale * std::abs(before_[k]),
                  scale * std::abs(first_by_y_[k]), scale * inertia});
  });
  const auto take = [&](Index row, double difference, double& change) {
    if (difference > change * row_size_[row])
      change = difference / row_size_[row];
  };
  entries([&](Index k, Index row, Index column, double scale) {
    const int group = s_.error_group[static_cast<std::size_t>(row)];
    take(row, scale * std::abs(by_y_[k] - before_[k]), since_last[group]);
    if (column < s_.u0 || column >= s_.z0) // not valves and friction
      take(row, scale * std::abs(by_y_[k] - first_by_y_[k]), since_first[group]);
  });
  for (const system::BodyData& b : s_.bodies) {
    if (b.rotation != system::BodyData::Rotation::free || b.group < 0)
      continue;
    const Index w = b.u0 + b.n_translations;
    const Matrix3 change = (system::gyroscopic_matrix(b.inertia, u_.segment<3>(w - s_.u0)) -
                            system::gyroscopic_matrix(b.inertia, first_u_.segment<3>(w - s_.u0)))
                               .cwiseAbs();
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        take(w + i, s_.scale[w + k] * change(i, k), since_first[b.group]);
  }
}

} // namespace hydrodae::solve
