#include "hydrodae/build/constraints.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/system/dropped_rows.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::build {

VectorX displacement_scale(const system::System& s) {
  VectorX scale(s.n_u);
  for (const system::BodyData& b : s.bodies)
    for (int k = 0; k < b.n_active; ++k)
      scale[b.u0 - s.u0 + k] = b.active[k] < 3 ? b.length_scale : b.length_scale / b.lever;
  return scale;
}

Constraints::Constraints(const system::Regime& s, std::vector<system::MotionStart> starts)
    : s_(s), starts_(std::move(starts)), ws_(s), scale_(displacement_scale(s)),
      size_(s.n_lambda + static_cast<Index>(starts_.size())), lever_(VectorX::Ones(size_.size())),
      mu_(s.n_lambda, -1), angle_(static_cast<std::size_t>(size_.size()), false) {
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const system::MotionData& motion = s.motions[starts_[k].motion];
    const system::JointData& j = s.joints[motion.joint];
    const system::BodyData& b = s.bodies[j.B.body >= 0 ? j.B.body : j.A.body];
    const Index i = s.n_lambda + static_cast<Index>(k);
    angle_[static_cast<std::size_t>(i)] = motion.motion.is_angle();
    size_[i] = motion.motion.is_angle() ? b.length_scale / b.lever : b.length_scale;
    lever_[i] = system::smaller_arm(s, j);
  }
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      if (s.holds(row)) {
        angle_[static_cast<std::size_t>(s.lambda(row) - s.lambda0)] = joint::is_angle(row.kind);
        lever_[s.lambda(row) - s.lambda0] = system::smaller_arm(s, j);
      }
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c)) {
      const system::MotionData& motion = s.motions[c.terms.front().motion];
      angle_[static_cast<std::size_t>(s.lambda(c) - s.lambda0)] = motion.motion.is_angle();
      lever_[s.lambda(c) - s.lambda0] = system::smaller_arm(s, s.joints[motion.joint]);
    }
  system::for_each_row(s, [&](const system::Row& row, bool velocity_level) {
    if (!s.holds(row))
      return;
    const Index i = s.lambda(row) - s.lambda0;
    size_[i] = s.row_scale[velocity_level ? s.lambda(row) : s.mu(row)];
    mu_[i] = velocity_level ? -1 : s.mu(row);
  });
}

void Constraints::evaluate(const VectorX& y, VectorX& gaps, VectorX& rates) {
  const VectorX rest = VectorX::Zero(s_.n);
  VectorX r(s_.n);
  system::residual<double>(s_, ws_, 0.0, y.data(), rest.data(), r.data());
  gaps = rates = VectorX::Zero(size_.size());
  for (Index i = 0; i < s_.n_lambda; ++i) {
    gaps[i] = mu_[i] < 0 ? 0.0 : r[mu_[i]] / size_[i];
    rates[i] = r[s_.lambda0 + i] / size_[i];
  }
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    const system::MotionStart& given = starts_[k];
    const auto row = system::motion_row<double>(s_, ws_, given.motion);
    const system::JointData& j = s_.joints[s_.motions[given.motion].joint];
    const Index i = s_.n_lambda + static_cast<Index>(k);
    if (given.value)
      gaps[i] = (row.value - *given.value) / size_[i];
    if (given.rate)
      rates[i] = (row.gradient.dot(system::joint_velocity<double>(j, ws_.bodies)) - *given.rate) /
                 size_[i];
  }
}

SparseMatrix Constraints::gradient(const std::function<bool(Index)>& wanted) const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const system::JointData& j, Index i, const joint::Vector12& row) {
    if (wanted(i))
      append(entries, j, i, row);
  };
  for (const system::JointData& j : s_.joints) {
    const auto g = system::joint_geometry<double>(j, ws_.bodies);
    for (const system::RowData& row : j.rows)
      if (s_.holds(row))
        add(j, s_.lambda(row) - s_.lambda0,
            joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient);
  }
  for (const system::CouplerData& c : s_.couplers)
    for (const system::CouplerData::Term& term : c.terms)
      if (s_.holds(c))
        add(s_.joints[s_.motions[term.motion].joint], s_.lambda(c) - s_.lambda0,
            term.factor * system::motion_row<double>(s_, ws_, term.motion).gradient);
  for (std::size_t k = 0; k < starts_.size(); ++k)
    add(s_.joints[s_.motions[starts_[k].motion].joint], s_.n_lambda + static_cast<Index>(k),
        system::motion_row<double>(s_, ws_, starts_[k].motion).gradient);
  SparseMatrix G(size_.size(), s_.n_u);
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

void Constraints::append(std::vector<Eigen::Triplet<double>>& entries, const system::JointData& j,
                         Index i, const joint::Vector12& gradient) const {
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const system::BodyData& b = s_.bodies[body];
    for (int k = 0; k < b.n_active; ++k) {
      const Index u = b.u0 - s_.u0 + k;
      entries.emplace_back(i, u, gradient[6 * side + b.active[k]] * scale_[u] / size_[i]);
    }
  }
}

std::string Constraints::name(Index i) const {
  if (i >= s_.n_lambda) {
    const system::MotionData& motion = s_.motions[start(i).motion];
    return "joints/" + s_.joints[motion.joint].name + " initial " + motion.name;
  }
  return s_.row_names[mu_[i] < 0 ? s_.lambda0 + i : mu_[i]];
}

std::string Constraints::key(Index i) const {
  if (i >= s_.n_lambda)
    return "joint." + s_.joints[s_.motions[start(i).motion].joint].name;
  for (const system::JointData& j : s_.joints)
    for (const system::RowData& row : j.rows)
      if (s_.holds(row) && s_.lambda(row) == s_.lambda0 + i)
        return "joint." + j.name;
  for (const system::CouplerData& c : s_.couplers)
    if (s_.holds(c) && s_.lambda(c) == s_.lambda0 + i)
      return "constraint." + c.name;
  return "joint";
}

} // namespace hydrodae::build
