/// Reactions of the joints of the tree, and projection onto the rows that it leaves.

#include <algorithm>
#include <array>
#include <cmath>

#include "hydrodae/tree/joint_space.h"

namespace hydrodae::tree {

namespace {

constexpr int tree_projections = 8;
constexpr double tree_closed = 1e-13; ///< gaps in units of their scale
constexpr double tree_moving = 1e-8;  ///< rates of the gaps likewise

} // namespace

/// What each body lacks of M a = f + G^T lambda is the reaction of the joint that it hangs on and
/// of those that hang on it: from the tips inwards.
void JointSpace::share_reactions(VectorX& y) {
  net_ = residual_.segment(s_.u0, s_.n_u);
  for (const Entry& m : masses_)
    net_[m.row] += parts_->by_yp[m.from] * bias_[m.column];
  for (Vector6& w : wrench_)
    w.setZero();
  for (Index u = 0; u < s_.n_u; ++u)
    wrench_[body_of_[u]][component_of_[u]] = net_[u];
  for (const Part& part : gradient_)
    for (const auto& [from, component] : part.entries)
      wrench_[part.body][component] += parts_->by_y[from] * solution_[n_ + part.row];
  for (auto link = tree_.links.rbegin(); link != tree_.links.rend(); ++link) {
    if (link->joint < 0)
      continue;
    const system::JointData& j = s_.joints[static_cast<std::size_t>(link->joint)];
    const system::BodyData& child = s_.bodies[static_cast<std::size_t>(link->body)];
    const auto pose = [&](int body) -> std::pair<Vector3, Matrix3> {
      if (body < 0)
        return {Vector3::Zero(), Matrix3::Identity()};
      const auto& c = motion_.bodies[static_cast<std::size_t>(body)];
      return {c.r, c.R};
    };
    const auto [r_A, R_A] = pose(j.A.body);
    const auto [r_B, R_B] = pose(j.B.body);
    const joint::Geometry<double> g = joint::geometry<double>(j.B, r_A, R_A, r_B, R_B);
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
    using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
    Matrix6 on_parent = Matrix6::Zero();
    std::array<Index, 6> lambda{};
    Small on_child(child.n_active, 0);
    int rows = 0;
    for (const system::RowData& row : j.rows) {
      if (!s_.holds(row) || rows == 6)
        continue;
      const joint::Vector12 gradient =
          joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient;
      const Vector6 own = link->turned ? gradient.head<6>() : gradient.tail<6>();
      on_parent.col(rows) = link->turned ? gradient.tail<6>() : gradient.head<6>();
      on_child.conservativeResize(Eigen::NoChange, rows + 1);
      for (int k = 0; k < child.n_active; ++k)
        on_child(k, rows) = own[child.active[static_cast<std::size_t>(k)]];
      lambda[static_cast<std::size_t>(rows++)] = s_.lambda(row);
    }
    if (rows == 0)
      continue;
    SmallVector load(child.n_active);
    for (int k = 0; k < child.n_active; ++k)
      load[k] =
          wrench_[static_cast<std::size_t>(link->body)][child.active[static_cast<std::size_t>(k)]];
    const SmallVector found = on_child.colPivHouseholderQr().solve(load);
    for (int i = 0; i < rows; ++i) {
      y[lambda[static_cast<std::size_t>(i)]] = found[i];
      if (link->before >= 0)
        wrench_[static_cast<std::size_t>(link->parent)] -= found[i] * on_parent.col(i);
    }
  }
}

/// Are the rates of the rows left next to nothing beside the velocities of the bodies?
bool JointSpace::are_rows_at_rest(const VectorX& u) {
  for (Index i = 0; i < m_; ++i)
    if (std::abs(residual_[cut_.lambda0 + i]) >
        tree_moving * std::max(cut_.row_scale[cut_.lambda0 + i], u.cwiseAbs().maxCoeff()))
      return false;
  return true;
}

bool JointSpace::project(double t, VectorX& x) {
  tree::normalise(tree_, x);
  if (m_ == 0)
    return x.allFinite();
  double before = HUGE_VAL;
  const auto residual = [&] {
    move_to(x);
    y_.tail(cut_.n - cut_.lambda0).setZero();
    return own_->residual(t, y_, yp0_, residual_);
  };
  for (int i = 0; i < tree_projections; ++i) {
    if (!residual())
      return false;
    rhs_.setZero();
    double gap = 0.0;
    system::for_each_row(s_, [&](const system::Row& row, bool velocity_level) {
      if (!cut_.holds(row) || velocity_level)
        return;
      const Index mu = cut_.mu(row);
      rhs_[n_ + cut_.lambda(row) - cut_.lambda0] = -residual_[mu];
      gap = std::max(gap, std::abs(residual_[mu]) / cut_.row_scale[mu]);
    });
    if (gap <= tree_closed || (i > 0 && gap >= 0.5 * before && gap < 1e-10))
      break;
    if ((i > 1 && gap > 2.0 * before) || (i + 1 == tree_projections && gap > 1e-9))
      return false;
    before = gap;
    solve();
    tree::retract(tree_, solution_.head(n_), x);
  }
  for (int i = 0; i < 2; ++i) { // the matrix is of a pose a little off: twice
    if (!residual())
      return false;
    rhs_.setZero();
    rhs_.tail(m_) = -residual_.segment(cut_.lambda0, m_);
    solve();
    x.segment(tree_.n_q, n_) += solution_.head(n_);
  }
  return residual() && are_rows_at_rest(y_.segment(s_.u0, s_.n_u)) && x.allFinite();
}

bool JointSpace::close(double t, VectorX& x, VectorX& xp) {
  if (m_ == 0)
    return true;
  const VectorX before = x;
  if (!project(t, x))
    x = before;
  return rates(t, x, xp);
}

} // namespace hydrodae::tree
