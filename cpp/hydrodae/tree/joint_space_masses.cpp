/// Masses, gradients and loads of the bodies, brought to joint coordinates.

#include <algorithm>
#include <cmath>

#include "hydrodae/tree/joint_space.h"

namespace hydrodae::tree {

namespace {

/// The wrench (force, moment about the centre of gravity) on a body, seen from a point `way` behind
/// it.
Vector6 shifted(const Vector6& wrench, const Vector3& way) {
  Vector6 out = wrench;
  out.tail<3>() += cross<double>(way, wrench.head<3>());
  return out;
}

/// X^T Phi X of a mass matrix about a point `way` ahead; X = [I, -[way]x; 0, I].
Matrix6 shifted(const Matrix6& mass, const Vector3& way) {
  Matrix6 X = Matrix6::Identity();
  X.topRightCorner<3, 3>() = -skew<double>(way);
  return X.transpose() * mass * X;
}

/// Rotations from body axes to world axes.
void turn(const Matrix3& R, Matrix6& mass) {
  mass.rightCols<3>() = (mass.rightCols<3>() * R.transpose()).eval();
  mass.bottomRows<3>() = (R * mass.bottomRows<3>()).eval();
}

} // namespace

/// Rows of bodies that have no mass in common with others: composite bodies from the tips inwards
/// (Featherstone, Rigid Body Dynamics Algorithms (2008), ch. 6), for any 6 x 6 mass matrices.
void JointSpace::add_own_masses() {
  for (Matrix6& mass : composite_)
    mass.setZero();
  for (const MassEntry& m : own_masses_)
    composite_[m.body](m.i, m.j) = parts_->by_yp[m.from];
  for (const tree::TreeLink& link : tree_.links)
    turn(motion_.bodies[static_cast<std::size_t>(link.body)].R,
         composite_[static_cast<std::size_t>(link.body)]);
  for (auto link = tree_.links.rbegin(); link != tree_.links.rend(); ++link) {
    const auto i = static_cast<std::size_t>(link->body);
    const tree::TreeMotion::Body& c = motion_.bodies[i];
    Matrix6& mass = composite_[i]; // of this body and those beyond, in world axes
    for (int k = 0; k < link->n_u; ++k) {
      const Index row = link->u0 + k;
      const Vector6 s = motion_.columns[static_cast<std::size_t>(row)].at(c.r);
      Vector6 by_column = mass * s, by_row = mass.transpose() * s;
      for (int j = 0; j <= k; ++j) {
        const Vector6 other = motion_.columns[static_cast<std::size_t>(link->u0 + j)].at(c.r);
        plain_(link->u0 + j, row) += other.dot(by_column);
        if (j < k)
          plain_(row, link->u0 + j) += other.dot(by_row);
      }
      const tree::TreeLink* at = &*link;
      while (at->before >= 0) {
        const Vector3& r = motion_.bodies[static_cast<std::size_t>(at->body)].r;
        at = &tree_.links[static_cast<std::size_t>(at->before)];
        const Vector3& parent = motion_.bodies[static_cast<std::size_t>(at->body)].r;
        by_column = shifted(by_column, r - parent);
        by_row = shifted(by_row, r - parent);
        for (int j = 0; j < at->n_u; ++j) {
          const Vector6 other = motion_.columns[static_cast<std::size_t>(at->u0 + j)].at(parent);
          plain_(at->u0 + j, row) += other.dot(by_column);
          plain_(row, at->u0 + j) += other.dot(by_row);
        }
      }
    }
    if (link->before >= 0)
      composite_[static_cast<std::size_t>(link->parent)] +=
          shifted(mass, c.r - motion_.bodies[static_cast<std::size_t>(link->parent)].r);
  }
}

/// S^T M S of all others.
void JointSpace::add_coupled_masses() {
  if (coupled_bodies_.empty())
    return;
  for (const Entry& m : coupled_masses_)
    coupled_(m.row, m.column) = parts_->by_yp[m.from];
  for (std::size_t h = 0; h < coupled_bodies_.size(); ++h) {
    const std::size_t body = coupled_bodies_[h];
    const tree::TreeMotion::Body& c = motion_.bodies[body];
    const auto row = 6 * static_cast<Index>(h);
    for (int at = tree_.link_of[body]; at >= 0;) {
      const tree::TreeLink& link = tree_.links[static_cast<std::size_t>(at)];
      for (int k = 0; k < link.n_u; ++k) {
        const tree::TreeColumn& column = motion_.columns[static_cast<std::size_t>(link.u0 + k)];
        coupled_S_.block<3, 1>(row, link.u0 + k) =
            column.slide + cross<double>(column.axis, c.r - column.pivot);
        coupled_S_.block<3, 1>(row + 3, link.u0 + k) = c.R.transpose() * column.axis;
      }
      at = link.before;
    }
  }
  coupled_MS_.noalias() = coupled_ * coupled_S_;
  plain_.topLeftCorner(n_, n_).noalias() += coupled_S_.transpose() * coupled_MS_;
}

void JointSpace::fill_masses() {
  plain_.topLeftCorner(n_, n_).setZero();
  if (!own_masses_.empty())
    add_own_masses();
  add_coupled_masses();
}

void JointSpace::fill_gradient() {
  if (m_ == 0)
    return;
  plain_.bottomLeftCorner(m_, n_).setZero();
  for (const Part& part : gradient_) {
    Vector6 tangent = Vector6::Zero();
    for (const auto& [from, component] : part.entries)
      tangent[component] = parts_->by_y[from];
    const Vector6 load = to_world(part.body, tangent);
    const Vector3& r = motion_.bodies[part.body].r;
    for (int at = tree_.link_of[part.body]; at >= 0;) {
      const tree::TreeLink& link = tree_.links[static_cast<std::size_t>(at)];
      for (int k = 0; k < link.n_u; ++k)
        plain_(n_ + part.row, link.u0 + k) +=
            motion_.columns[static_cast<std::size_t>(link.u0 + k)].at(r).dot(load);
      at = link.before;
    }
  }
  plain_.topRightCorner(n_, m_) = plain_.bottomLeftCorner(m_, n_).transpose();
}

/// Right-hand sides: S^T (f - M (dS/dt) u) and -gamma - G (dS/dt) u (+ drive).
void JointSpace::fill_loads(double t) {
  net_ = -residual_.segment(s_.u0, s_.n_u);
  for (const Entry& m : masses_)
    net_[m.row] -= parts_->by_yp[m.from] * bias_[m.column];
  for (Vector6& w : wrench_)
    w.setZero();
  for (Index u = 0; u < s_.n_u; ++u)
    wrench_[body_of_[u]][component_of_[u]] = net_[u];
  for (const tree::TreeLink& link : tree_.links)
    wrench_[static_cast<std::size_t>(link.body)] =
        to_world(static_cast<std::size_t>(link.body), wrench_[static_cast<std::size_t>(link.body)]);
  for (auto link = tree_.links.rbegin(); link != tree_.links.rend(); ++link) {
    const auto i = static_cast<std::size_t>(link->body);
    const Vector3& r = motion_.bodies[i].r;
    for (int k = 0; k < link->n_u; ++k)
      rhs_[link->u0 + k] =
          motion_.columns[static_cast<std::size_t>(link->u0 + k)].at(r).dot(wrench_[i]);
    if (link->before >= 0)
      wrench_[static_cast<std::size_t>(link->parent)] +=
          shifted(wrench_[i], r - motion_.bodies[static_cast<std::size_t>(link->parent)].r);
  }
  if (m_ == 0)
    return;
  rhs_.tail(m_) = -parts_->row_rates;
  for (const Part& part : gradient_)
    for (const auto& [from, component] : part.entries) {
      const system::BodyData& b = s_.bodies[part.body];
      for (int k = 0; k < b.n_active; ++k)
        if (b.active[static_cast<std::size_t>(k)] == component)
          rhs_[n_ + part.row] -= parts_->by_y[from] * bias_[b.u0 - s_.u0 + k];
    }
  for (const system::CouplerData& c : s_.couplers)
    if (cut_.holds(c))
      rhs_[n_ + cut_.lambda(c) - cut_.lambda0] += cut_.drive(c, t)[c.velocity_level ? 1 : 2];
}

} // namespace hydrodae::tree
