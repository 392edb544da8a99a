#include "hydrodae/build/constraints.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/math/sets.h"
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
  set_mechanisms();
  set_tree();
}

void Constraints::set_tree() {
  tree_.assign(static_cast<std::size_t>(size_.size()), false);
  const Index ground = std::ssize(s_.bodies);
  Sets sets(ground + 1);
  // The ground guides a body with at most two coordinates.
  const auto place = [&](int body) {
    return body < 0 || s_.bodies[body].n_active <= 2 ? ground : Index{body};
  };
  for (const system::JointData& j : s_.joints) {
    const Index a = place(j.A.body), b = place(j.B.body);
    const bool holds = std::any_of(j.rows.begin(), j.rows.end(),
                                   [&](const system::RowData& row) { return s_.holds(row); });
    if (!holds || sets.root(a) == sets.root(b))
      continue;
    sets.join(a, b);
    for (const system::RowData& row : j.rows)
      if (s_.holds(row))
        tree_[static_cast<std::size_t>(s_.lambda(row) - s_.lambda0)] = true;
  }
}

void Constraints::set_mechanisms() {
  const auto moves = [&](int body) { return body >= 0 && s_.bodies[body].n_active > 0; };
  Sets sets(std::ssize(s_.bodies));
  const auto join = [&](const system::JointData& j) {
    if (moves(j.A.body) && moves(j.B.body))
      sets.join(j.A.body, j.B.body);
    return moves(j.A.body) ? j.A.body : std::max(j.B.body, 0);
  };
  std::vector<Index> body(static_cast<std::size_t>(size_.size()), 0); // one body of each row
  for (const system::JointData& j : s_.joints)
    for (const system::RowData& row : j.rows)
      if (s_.holds(row))
        body[static_cast<std::size_t>(s_.lambda(row) - s_.lambda0)] = join(j);
  for (const system::CouplerData& c : s_.couplers)
    if (s_.holds(c)) {
      Index& first = body[static_cast<std::size_t>(s_.lambda(c) - s_.lambda0)];
      first = join(s_.joints[s_.motions[c.terms.front().motion].joint]);
      for (const system::CouplerData::Term& term : c.terms)
        sets.join(first, join(s_.joints[s_.motions[term.motion].joint]));
    }
  for (std::size_t k = 0; k < starts_.size(); ++k)
    body[static_cast<std::size_t>(s_.n_lambda) + k] =
        join(s_.joints[s_.motions[starts_[k].motion].joint]);
  const Sets::Lists lists = sets.lists();
  n_mechanisms_ = std::ssize(lists.members);
  for (Index b : body)
    mechanism_.push_back(s_.bodies.empty() ? 0 : static_cast<Index>(lists.set[b]));
  owner_.resize(static_cast<std::size_t>(s_.n_u));
  for (std::size_t b = 0; b < s_.bodies.size(); ++b)
    for (int k = 0; k < s_.bodies[b].n_active; ++k)
      owner_[static_cast<std::size_t>(s_.bodies[b].u0 - s_.u0 + k)] =
          static_cast<Index>(lists.set[b]);
}

VectorX Constraints::largest_row(const VectorX& rows) const {
  VectorX out = VectorX::Zero(n_mechanisms_);
  for (Index i = 0; i < rows.size(); ++i)
    if (double& value = out[mechanism(i)]; !(std::abs(rows[i]) <= value)) // also for NaN
      value = std::abs(rows[i]);
  return out;
}

VectorX Constraints::largest_motion(const VectorX& motion) const {
  VectorX out = VectorX::Zero(n_mechanisms_);
  for (Index k = 0; k < motion.size(); ++k)
    out[owner(k)] = std::max(out[owner(k)], std::abs(motion[k]));
  return out;
}

void Constraints::copy_mechanism(Index mechanism, const VectorX& from, VectorX& to) const {
  for (const system::BodyData& b : s_.bodies)
    if (b.n_active > 0 && owner(b.u0 - s_.u0) == mechanism)
      to.segment(b.q0, b.n_position) = from.segment(b.q0, b.n_position);
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
