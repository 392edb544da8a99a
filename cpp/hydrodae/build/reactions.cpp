/// Joint reactions that laws depend on.

#include <algorithm>
#include <array>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::build {

namespace {

using joint::BasicRow;

constexpr std::array<std::string_view, 4> pressing_joints = {"prismatic", "revolute", "cylindrical",
                                                             "sliding"};

/// Load on body B by a unit multiplier, in the pose in which both markers coincide: force and
/// moment along the axes of marker A.
Vector6 load_on_b(const BasicRow& row) {
  const joint::Marker marker;
  const auto g = joint::geometry<double>(marker, Vector3::Zero(), Matrix3::Identity(),
                                         Vector3::Zero(), Matrix3::Identity());
  const joint::Row<double> at = joint::basic_row<double>(row, marker, marker, {}, g);
  return joint::reaction(at.gradient, marker, marker, g);
}

/// Gradients of all rows of the scene that may be needed, as columns by velocity coordinates.
class Gradients {
public:
  explicit Gradients(const system::Regime& s) : s_(s), ws_(s) {
    const VectorX y = system::initial_state(s), rest = VectorX::Zero(s.n);
    system::unpack<double>(s, y.data(), rest.data(), ws_.bodies);
  }
  VectorX row(const system::JointData& j, const BasicRow& kind) const {
    const auto g = system::joint_geometry<double>(j, ws_.bodies);
    VectorX out = VectorX::Zero(s_.n_u);
    add(j, joint::basic_row<double>(kind, j.A, j.B, j.parameters, g).gradient, out);
    return out;
  }
  VectorX coupler(const system::CouplerData& c) const {
    VectorX out = VectorX::Zero(s_.n_u);
    for (const system::CouplerData::Term& term : c.terms) {
      const system::JointData& j =
          s_.joints[static_cast<std::size_t>(s_.motions[term.motion].joint)];
      add(j, term.factor * system::motion_row<double>(s_, ws_, term.motion).gradient, out);
    }
    return out;
  }

private:
  void add(const system::JointData& j, const joint::Vector12& gradient, VectorX& out) const {
    for (int side = 0; side < 2; ++side) {
      const int body = side == 0 ? j.A.body : j.B.body;
      if (body < 0)
        continue;
      const system::BodyData& b = s_.bodies[static_cast<std::size_t>(body)];
      for (int k = 0; k < b.n_active; ++k)
        out[b.u0 - s_.u0 + k] += gradient[6 * side + b.active[k]];
    }
  }
  const system::Regime& s_;
  system::Workspace<double> ws_;
};

/// Text "gap along x of 'guide', ...": redundant rows that depend on rows of this joint, so that
/// the reaction is shared arbitrarily; empty: none.
std::string shared_rows(const system::Regime& s, const system::JointData& pressed) {
  constexpr double part = 1e-6;
  std::vector<std::pair<std::string, VectorX>> dropped;
  const Gradients gradients(s);
  MatrixX kept = MatrixX::Zero(s.n_u, s.n_lambda);
  std::vector<Index> own;
  const auto take = [&](Index lambda, const std::string& name, VectorX gradient, bool of_pressed) {
    if (lambda == system::redundant) {
      dropped.emplace_back(name, std::move(gradient));
      return;
    }
    kept.col(lambda - s.lambda0) = gradient;
    if (of_pressed)
      own.push_back(lambda - s.lambda0);
  };
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      take(s.lambda(row), joint::row_name(row.kind) + " of " + in_quotes(j.name),
           gradients.row(j, row.kind), &j == &pressed);
  for (const system::CouplerData& c : s.couplers)
    if (c.of_switch < 0)
      take(s.lambda(c), in_quotes(c.name), gradients.coupler(c), false);
  if (dropped.empty())
    return {};
  MatrixX gradients_of_dropped(s.n_u, static_cast<Index>(dropped.size()));
  for (std::size_t k = 0; k < dropped.size(); ++k)
    gradients_of_dropped.col(static_cast<Index>(k)) = dropped[k].second;
  const MatrixX parts = least_squares(kept, gradients_of_dropped);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < dropped.size(); ++k) {
    const auto& [name, gradient] = dropped[k];
    const auto c = parts.col(static_cast<Index>(k));
    const double size = gradient.norm();
    const bool shares = std::any_of(own.begin(), own.end(), [&](Index i) {
      return std::abs(c[i]) * kept.col(i).norm() > part * size;
    });
    if (shares || name.ends_with(" of " + in_quotes(pressed.name)))
      names.push_back(name);
  }
  return joined(names);
}

/// Checks the radii and lengths that the joint needs, and refuses others.
void check_lengths(const system::JointData& j, const system::PortData& port,
                   const std::string& key) {
  const element::Bearing& b = *port.bearing;
  Vector6 taken = Vector6::Zero();
  for (const system::PortData::Pressing& p : port.reaction)
    taken += p.on_b.cwiseAbs();
  const bool bends = taken[3] + taken[4] > 0.0, twists = taken[5] > 0.0;
  const auto need = [&](bool wanted, double value, const char* name, const char* what) {
    if (wanted && value <= 0.0)
      throw ModelError(key, "joint " + in_quotes(j.name) + " takes " + what +
                                ", which presses too: friction from 'static_coefficient' needs the "
                                "key '" +
                                name + "' [m]");
  };
  need(bends, b.length, "length", "moments across its axis");
  if (b.turns)
    need(true, b.radius, "radius", "forces at its bearing");
  else
    need(twists, b.radius, "radius", "a moment about its axis");
}

} // namespace

void find_reactions(system::System& s) {
  const system::Regime start(s);
  for (system::ElementList& list : s.elements)
    for (system::PortData& port : list.ports) {
      if (!port.bearing)
        continue;
      const std::string key = "force." + port.component;
      const system::JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
      if (std::find(pressing_joints.begin(), pressing_joints.end(), j.type->name) ==
          pressing_joints.end())
        throw ModelError(key, "'static_coefficient' needs a joint whose reaction presses a bearing "
                              "on its axis: prismatic, revolute, cylindrical or sliding, and not " +
                                  std::string(j.type->name) + "; give the load itself as 'static'");
      for (std::size_t k = 0; k < j.rows.size(); ++k)
        port.reaction.push_back({k, load_on_b(j.rows[k].kind)});
      if (port.reaction.empty())
        throw ModelError(key,
                         "joint " + in_quotes(j.name) +
                             " restricts no free coordinate, so that no reaction of it presses:"
                             " give the load itself as 'static', or free the bodies");
      check_lengths(j, port, key);
      if (const std::string rows = shared_rows(start, j); !rows.empty())
        throw ModelError(key, "how much presses joint " + in_quotes(j.name) +
                                  " is not known: its reaction may be shared in any way with "
                                  "redundant constraint rows (" +
                                  rows +
                                  "). Let other joints hold less, or give the load itself as "
                                  "'static'");
    }
}

} // namespace hydrodae::build
