/// Rates at a point, and what of the bodies follows from them.

#include <algorithm>
#include <cmath>

#include "hydrodae/tree/joint_space.h"

namespace hydrodae::tree {

namespace {

constexpr double tree_regularisation = 1e-8; ///< e
constexpr int tree_refinements = 4;
constexpr double tree_converged = 1e-13; ///< residual, relative to the right-hand side
constexpr double small_change = 1e-5;    ///< change of x by which derivatives are taken

template <class Vector> double largest_entry(const Vector& v) {
  return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
}

} // namespace

Vector6 JointSpace::to_world(std::size_t body, const Vector6& tangent) const {
  Vector6 out;
  out << tangent.head<3>(), motion_.bodies[body].R * tangent.tail<3>();
  return out;
}

void JointSpace::move_to(const VectorX& x) {
  motion_.move(tree_, x.data());
  motion_.write(s_, y_);
  y_.segment(s_.z0, s_.n_z) = x.tail(s_.n_z);
}

/// Accelerations of the bodies along their own velocities.
void JointSpace::write_accelerations(VectorX& out) const {
  for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
    const system::BodyData& b = s_.bodies[i];
    if (b.n_active == 0)
      continue;
    const tree::TreeMotion::Body& c = motion_.bodies[i];
    const Vector3 turning = c.R.transpose() * c.alpha;
    for (int k = 0; k < b.n_active; ++k) {
      const int component = b.active[static_cast<std::size_t>(k)];
      out[b.u0 - s_.u0 + k] = component < 3 ? c.a[component] : turning[component - 3];
    }
  }
}

bool JointSpace::factorise() {
  if (m_ == 0) {
    lu_.compute(plain_);
    return true;
  }
  matrix_ = plain_;
  for (Index i = 0; i < m_; ++i) {
    double d = 0.0;
    for (Index k = 0; k < n_; ++k)
      if (const double g = plain_(n_ + i, k); g != 0.0 && plain_(k, k) > 0.0)
        d += g * g / plain_(k, k);
    metric_[i] = d > 0.0 ? d : 1.0;
    matrix_(n_ + i, n_ + i) = -tree_regularisation * metric_[i];
  }
  if (!matrix_.allFinite())
    return false;
  lu_.compute(matrix_);
  return true;
}

/// The residual is taken with e = 0 (saddle_point.h).
void JointSpace::solve() {
  solution_ = lu_.solve(rhs_);
  for (int i = 0; m_ > 0 && i < tree_refinements; ++i) {
    r_.noalias() = plain_ * solution_;
    r_ = rhs_ - r_;
    const double load = largest_entry(rhs_.head(n_)), motion = largest_entry(solution_.head(n_));
    if (largest_entry(r_.head(n_)) <= tree_converged * load &&
        largest_entry(r_.tail(m_)) <= tree_converged * motion)
      return;
    solution_ += lu_.solve(r_);
  }
}

bool JointSpace::rates(double t, VectorX& x, VectorX& xp) {
  move_to(x);
  y_.tail(cut_.n - cut_.lambda0).setZero();
  if (!own_->solve_algebraic(t, y_) || !own_->free_residual(t, y_, yp0_, residual_))
    return false;
  x.tail(s_.n_z) = y_.segment(s_.z0, s_.n_z);
  own_->jacobian(t, y_, yp0_, pattern_, *parts_);
  motion_.accelerate(tree_, x.data(), nullptr);
  write_accelerations(bias_);
  fill_masses();
  fill_gradient();
  fill_loads(t);
  if (!factorise())
    return false;
  solve();
  motion_.position_rates(tree_, x.data(), xp.data());
  xp.segment(tree_.n_q, n_) = solution_.head(n_);
  // Rows of z are z' = (explicit): with y' = 0 the residual is minus the rate.
  xp.tail(s_.n_z) = -residual_.segment(s_.z0, s_.n_z);
  for (Index z = s_.z0; z < s_.memory0; ++z)
    if (s_.is_algebraic(z))
      xp[tree_.n_q + n_ + z - s_.z0] = 0.0;
  motion_.accelerate(tree_, x.data(), solution_.data());
  return solution_.allFinite();
}

void JointSpace::accept(double t, const VectorX& x, const VectorX& xp) {
  move_to(x);
  motion_.accelerate(tree_, x.data(), xp.data() + tree_.n_q);
  write_accelerations(bias_);
  yp_.segment(s_.u0, s_.n_u) = bias_;
  e_.accept(t, y_, yp_);
  own_->accept(t, y_, yp_);
}

bool JointSpace::leave(double t, const VectorX&, const VectorX&, VectorX& y, VectorX& yp) {
  y.setZero(s_.n); // guards give them without a size
  yp.setZero(s_.n);
  y.head(s_.lambda0) = y_.head(s_.lambda0);
  write_accelerations(bias_);
  if (of_redundant_) {
    if (!of_redundant_->accelerations(t, y, yp))
      return false;
  } else {
    system::for_each_row(s_, [&](const system::Row& row, bool) {
      if (cut_.holds(row))
        y[s_.lambda(row)] = -solution_[n_ + cut_.lambda(row) - cut_.lambda0];
    });
    share_reactions(y);
  }
  yp.head(s_.n_q) = -residual_.head(s_.n_q);
  yp.segment(s_.u0, s_.n_u) = bias_;
  yp.segment(s_.z0, s_.n_z) = -residual_.segment(s_.z0, s_.n_z);
  for (Index z = s_.z0; z < s_.memory0; ++z)
    if (s_.is_algebraic(z))
      yp[z] = 0.0;
  return y.allFinite();
}

const VectorX& JointSpace::of_bodies(const VectorX& x, const VectorX& change) {
  const Index n = tree_.n_q + n_;
  double size = 0.0;
  for (Index i = 0; i < n; ++i)
    size = std::max(size, std::abs(change[i]) / (1.0 + std::abs(x[i])));
  const double scale = size > 0.0 && std::isfinite(size) ? small_change / size : 1.0;
  moved_.move(tree_, x.data());
  moved_.write(s_, before_);
  moved_x_ = x + scale * change;
  moved_.move(tree_, moved_x_.data());
  moved_.write(s_, change_);
  change_.head(s_.z0) = (change_.head(s_.z0) - before_.head(s_.z0)) / scale;
  change_.segment(s_.z0, s_.n_z) = change.tail(s_.n_z);
  return change_;
}

} // namespace hydrodae::tree
