#include "hydrodae/measure/observer.h"

#include <algorithm>

#include "hydrodae/math/dense.h"
#include "hydrodae/system/declare.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::measure {

using namespace system;

namespace {

int component_index(Observation& out, const std::string& name) {
  const auto found = std::find(out.components.begin(), out.components.end(), name);
  if (found != out.components.end())
    return static_cast<int>(found - out.components.begin());
  out.components.push_back(name);
  return static_cast<int>(out.components.size()) - 1;
}

} // namespace

Observer::Observer(const Regime& system) : s_(system), ws_(system) {
  const auto plan = [&](const std::string& component, int body, element::Work work) {
    out_.loads.push_back({component_index(out_, component), body});
    out_.works.resize(out_.components.size(), work);
  };
  const Declaration declared = declare(s_);
  for (int i = 0; i < static_cast<int>(s_.bodies.size()); ++i)
    plan("weight", i, element::Work::lent);
  for (const Declaration::Load& load : declared.loads)
    plan(load.component, load.body, load.work);
  out_.components.push_back("constraints");
  out_.works.push_back(element::Work::lent);
  Eigen::Index rows = 0;
  for (int j = 0; j < static_cast<int>(s_.joints.size()); ++j)
    for (const RowData& row : s_.joints[j].rows) {
      ++rows;
      if (!s_.holds(row))
        redundant_joints_.push_back(j);
    }
  shared_ = VectorX::Zero(rows);
  out_.reactions.resize(s_.joints.size());
  out_.supports.resize(s_.bodies.size());
  out_.powers.resize(out_.components.size());
  out_.motions.resize(s_.motions.size());
  out_.constraints.resize(s_.couplers.size());
  totals_.resize(s_.bodies.size());
  std::size_t own = 0;
  for (const Channel& channel : declared.channels)
    own += static_cast<std::size_t>(channel.width);
  out_.elements.resize(own);
  for (const ElementList& list : s_.elements) {
    const element::Elements& laws = *list.laws;
    const std::size_t each = std::max(1 + laws.channel_size(), 6 * (1 + laws.parts.size()));
    element_values_.resize(std::max(element_values_.size(), laws.size() * each));
    if (!in_waves_ && laws.waves().omega.size() > 0)
      in_waves_ = &laws;
  }
  out_.in_waves = in_waves_ != nullptr;
  const Eigen::Index loads = s_.hydro.added_mass.all.rows();
  rate_ = momentum_ = radiation_ = VectorX::Zero(loads);
  moving_ = VectorX::Zero(s_.hydro.n_moving);
}

/// Adds the next planned load to the list, the power of its component, and the balance.
void Observer::add_load(const Vector6& world_load) {
  ComponentLoad& entry = out_.loads[next_load_++];
  const BodyState<double>& state = ws_.bodies[entry.body];
  entry.load = world_load;
  entry.power = world_load.dot(twist<double>(state));
  out_.powers[entry.component] += entry.power;
  if (out_.works[entry.component] != element::Work::part)
    totals_[entry.body] -= to_tangent<double>(state, world_load);
}

void Observer::observe_weight() {
  for (const BodyData& b : s_.bodies) {
    Vector6 weight = Vector6::Zero();
    weight[2] = -b.mass * s_.gravity;
    add_load(weight);
    out_.potential += b.mass * s_.gravity * (ws_.bodies[&b - s_.bodies.data()].r - b.reference)[2];
  }
}

void Observer::observe_joints(const double* y) {
  const bool shared = !redundant_joints_.empty();
  if (shared)
    share_reactions(y);
  Eigen::Index next = 0;
  for (std::size_t k = 0; k < s_.joints.size(); ++k) {
    const JointData& j = s_.joints[k];
    const joint::Geometry<double> g = joint_geometry<double>(j, ws_.bodies);
    joint::Vector12 load = joint::Vector12::Zero();
    for (const RowData& row : j.rows) {
      const double lambda = shared ? shared_[next++] : y[s_.lambda(row)];
      load += lambda * joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient;
    }
    out_.reactions[k] = joint::reaction(load, j.A, j.B, g);
    subtract(j, load);
  }
  for (std::size_t k = 0; k < s_.couplers.size(); ++k) {
    const CouplerData& c = s_.couplers[k];
    out_.constraints[k] = s_.holds(c) ? y[s_.lambda(c)] : 0.0;
    if (!s_.holds(c))
      continue;
    for (const CouplerData::Term& term : c.terms)
      subtract(s_.joints[s_.motions[term.motion].joint],
               y[s_.lambda(c)] * term.factor * motion_row<double>(s_, ws_, term.motion).gradient);
  }
  for (const SwitchData& element : s_.switches) // friction that slips acts as a force
    if (element.kind == SwitchData::Kind::friction && !s_.holds(element))
      out_.constraints[static_cast<std::size_t>(element.coupler)] =
          s_.signals[static_cast<std::size_t>(element.list)][static_cast<std::size_t>(element.law)];
  for (int m = 0; m < static_cast<int>(s_.motions.size()); ++m) {
    const joint::Row<double> w = motion_row<double>(s_, ws_, m);
    const JointData& j = s_.joints[s_.motions[m].joint];
    out_.motions[m] = {w.value, w.gradient.dot(joint_velocity<double>(j, ws_.bodies))};
  }
}

/// Shares reactions among redundant rows, of which only the sum is known: the smallest multipliers
/// of all rows with the same G^T lambda.
void Observer::share_reactions(const double* y) {
  MatrixX G_T = MatrixX::Zero(s_.n_u, shared_.size());
  VectorX load = VectorX::Zero(s_.n_u);
  Eigen::Index column = 0;
  for (const JointData& j : s_.joints) {
    const joint::Geometry<double> g = joint_geometry<double>(j, ws_.bodies);
    for (const RowData& row : j.rows) {
      const joint::Vector12 gradient =
          joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient;
      for (int side = 0; side < 2; ++side) {
        const int body = side == 0 ? j.A.body : j.B.body;
        if (body < 0)
          continue;
        const BodyData& b = s_.bodies[body];
        for (int k = 0; k < b.n_active; ++k)
          G_T(b.u0 - s_.u0 + k, column) = gradient[6 * side + b.active[k]];
      }
      if (s_.holds(row))
        load += y[s_.lambda(row)] * G_T.col(column);
      ++column;
    }
  }
  shared_ = minimum_norm(G_T, load);
}

/// Subtracts the load of a constraint from the balance of its bodies, and adds its power (nonzero
/// only if a drive moves the constraint).
void Observer::subtract(const JointData& j, const joint::Vector12& load) {
  const joint::Vector12 u = joint_velocity<double>(j, ws_.bodies);
  const auto take = [&](int body, const Vector6& own, const Vector6& velocity) {
    if (body < 0)
      return;
    totals_[body] -= own;
    const double power = own.dot(velocity);
    out_.powers.back() += power;
    if (const int m = s_.bodies[body].mechanism; m >= 0)
      out_.mechanism_constraints[static_cast<std::size_t>(m)] += power;
  };
  take(j.A.body, load.head<6>(), u.head<6>());
  take(j.B.body, load.tail<6>(), u.tail<6>());
}

/// Computes kinetic energies, and the loads of locked coordinates: inertia minus all other loads.
void Observer::observe_energy() {
  for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
    const BodyData& b = s_.bodies[i];
    const BodyState<double>& state = ws_.bodies[i];
    const Vector3 spin = b.inertia * state.w;
    const double kinetic = 0.5 * b.mass * state.v.squaredNorm() + 0.5 * state.w.dot(spin);
    out_.kinetic += kinetic;
    if (b.mechanism >= 0)
      out_.mechanism_kinetic[static_cast<std::size_t>(b.mechanism)] += kinetic;
    Vector6 support = totals_[i];
    support.head<3>() += b.mass * state.v_dot;
    support.tail<3>() += b.inertia * state.w_dot + state.w.cross(spin);
    for (int k = 0; k < b.n_active; ++k)
      support[b.active[k]] = 0.0;
    out_.supports[i] = to_world(state, support);
  }
}

/// Reads the motion at (t, y, y'), and clears the sums.
void Observer::begin(double t, const VectorX& y, const VectorX& yp) {
  unpack<double>(s_, y.data(), yp.data(), ws_.bodies);
  ws_.time = t;
  ws_.past = s_.history ? &s_.history->at(t, true) : nullptr;
  std::fill(totals_.begin(), totals_.end(), Vector6(Vector6::Zero()));
  std::fill(out_.powers.begin(), out_.powers.end(), 0.0);
  out_.mechanism_kinetic.assign(static_cast<std::size_t>(s_.n_mechanisms), 0.0);
  out_.mechanism_constraints.assign(static_cast<std::size_t>(s_.n_mechanisms), 0.0);
  out_.kinetic = out_.kinetic_added_mass = out_.potential = 0.0;
  next_load_ = 0;
  observe_weight();
}

void Observer::observe_powers(double t, const VectorX& y, const VectorX& yp) {
  begin(t, y, yp);
  for_each_list(s_, [&](const auto& list) { observe_loads(list, y.data()); });
}

const Observation& Observer::observe_balance(double t, const VectorX& y, const VectorX& yp) {
  observe_powers(t, y, yp);
  observe_joints(y.data());
  observe_energy();
  return out_;
}

const Observation& Observer::observe(double t, const VectorX& y, const VectorX& yp) {
  begin(t, y, yp);
  own_ = out_.elements.data();
  for_each_list(s_, [&](const auto& list) { observe(list, y.data()); });
  if (in_waves_)
    out_.elevation = in_waves_->elevation(t);
  observe_joints(y.data());
  observe_energy();
  return out_;
}

} // namespace hydrodae::measure
