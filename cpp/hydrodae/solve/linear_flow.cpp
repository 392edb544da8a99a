#include "hydrodae/solve/linear_flow.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

LinearFlow::LinearFlow(const system::Regime& s, const system::Pattern& pattern, double t,
                       const VectorX& y, const VectorX& yp)
    : s_(s), e_(s, pattern, 1.0), first_u_(y.segment(s.u0, s.n_u)), u_(first_u_), row_size_(s.n),
      time_(t) {
  e_.accept(t, y, yp);
  e_.jacobian(t, y, yp);
  before_ = first_by_y_ = by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
}

/// The implicit midpoint rule with the mean of the derivatives at both looks, lest what turns or
/// swings between them feeds the change; memory states by backward Euler, since some fade within a
/// substep; the constraints hold at its end, and so do the loads of states of forces, which may
/// fade within a thousandth of it.
bool LinearFlow::look(double t, const VectorX& y, const VectorX& yp, int substeps) {
  const double h = (t - time_) / substeps;
  const system::Pattern& p = e_.pattern;
  if (!lu_)
    lu_ = std::make_unique<SparseLu<double>>(p.column_start, p.row);
  e_.accept(t, y, yp);
  e_.jacobian(t, y, yp);
  std::vector<double>& values = lu_->values();
  from_.assign(values.size(), 0.0);
  for (Index c = 0; c < s_.n; ++c)
    for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k) {
      const Index row = p.row[k];
      const bool of_force = c >= s_.z0 && c < s_.memory0 && !s_.is_absolute(c);
      const bool moves = s_.is_motion(row), half = moves && c < s_.lambda0 && !of_force;
      const double by_y = moves ? 0.5 * (by_y_[k] + e_.parts.by_y[k]) : e_.parts.by_y[k],
                   by_rate =
                       (moves ? 0.5 * (by_rate_[k] + e_.parts.by_yp[k]) : e_.parts.by_yp[k]) / h;
      values[k] = (half ? 0.5 * by_y : by_y) + by_rate;
      if (row < s_.lambda0 && c < s_.lambda0)
        from_[k] = by_rate - (half ? 0.5 * by_y : 0.0);
    }
  before_.swap(by_y_);
  by_y_ = e_.parts.by_y;
  by_rate_ = e_.parts.by_yp;
  u_ = y.segment(s_.u0, s_.n_u);
  time_ = t;
  return lu_->factorise();
}

bool LinearFlow::step(VectorX& change) {
  constexpr double most = 1e3;
  const system::Pattern& p = e_.pattern;
  rhs_.setZero(s_.n);
  for (Index c = 0; c < s_.lambda0; ++c)
    for (Index k = p.column_start[c]; k < p.column_start[c + 1] && change[c] != 0.0; ++k)
      rhs_[p.row[k]] += from_[k] * change[c];
  lu_->solve(rhs_.data());
  if (!rhs_.allFinite() || rhs_.head(s_.n_q).norm() > most * change.norm())
    return false;
  change = rhs_.head(s_.lambda0);
  return true;
}

VectorX LinearFlow::effect(const VectorX& change) {
  const system::Pattern& p = e_.pattern;
  rhs_.setZero(s_.n);
  for (Index c = 0; c < s_.lambda0; ++c)
    for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k)
      rhs_[p.row[k]] += (by_y_[k] - before_[k]) * change[c];
  lu_->solve(rhs_.data());
  return rhs_.head(s_.lambda0);
}

void LinearFlow::compare(const VectorX& rate, VectorX& since_last, VectorX& since_first) {
  const system::Pattern& p = e_.pattern;
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
