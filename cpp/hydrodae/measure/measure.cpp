#include "hydrodae/measure/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hydrodae::measure {

Measure::Measure(const system::Regime& system, double t0, const VectorX& y, const VectorX& yp)
    : s_(system), observer_(system), y_(y), yp_(yp) {
  state_.t = state_.end = t0;
  const Observation& o = observer_.observe_balance(t0, y, yp);
  state_.power = powers();
  state_.work = end_work_ = std::vector<double>(state_.power.size(), 0.0);
  state_.now.whole.start = o.kinetic + o.kinetic_added_mass;
  if (s_.n_mechanisms > 1)
    for (double kinetic : o.mechanism_kinetic)
      state_.now.mechanisms.push_back({0.0, 0.0, kinetic, kinetic});
  take_turns();
  observer_.follow(state_.now.turns);
  before_ = state_.now;
}

/// Computes powers at the nodes of the step from state_.t to t, on the solver's interpolant, and
/// the work over the step.
void Measure::begin(double t, const Interpolant& at, bool idle) {
  before_ = state_.now;
  state_.end = t;
  const std::size_t last = state_.rule.nodes.size() - 1;
  powers_.resize(last + 1);
  powers_[0] = state_.power;
  for (std::size_t node = 1; node <= last; ++node) {
    const double time = node == last ? t : state_.t + (t - state_.t) * state_.rule.nodes[node];
    at(time, y_, yp_);
    if (idle && node < last)
      observer_.observe_powers(time, y_, yp_);
    else
      observer_.observe_balance(time, y_, yp_);
    powers_[node] = powers();
  }
  end_work_ = state_.work;
  for (std::size_t node = 0; node <= last; ++node)
    add_work(state_.rule.weights[node], powers_[node]);
  take_mean(at);
  take_end();
}

/// Stores the work at the start of the means, if that is in this step. Leaves the observer at the
/// end of the step.
void Measure::take_mean(const Interpolant& at) {
  if (!(mean_from_ > state_.t && mean_from_ <= state_.end))
    return;
  at(mean_from_, y_, yp_);
  observer_.observe_balance(mean_from_, y_, yp_);
  state_.now.mean_work = work_at(mean_from_);
  at(state_.end, y_, yp_);
  observer_.observe_balance(state_.end, y_, yp_);
}

void Measure::begin(double t, std::span<const double> weights, const StageState& stage,
                    const Interpolant& at) {
  if (mean_from_ > state_.t && mean_from_ <= t)
    return begin(t, at, true);
  before_ = state_.now;
  state_.end = t;
  powers_.clear();
  end_work_ = state_.work;
  add_work(weights[0], state_.power);
  for (std::size_t i = 1; i < weights.size(); ++i)
    if (weights[i] != 0.0) {
      const double time = stage(i, y_, yp_);
      observer_.observe_powers(time, y_, yp_);
      add_work(weights[i], powers());
    }
  at(t, y_, yp_);
  observer_.observe_balance(t, y_, yp_);
  take_end();
}

void Measure::add_work(double weight, const std::vector<double>& powers) {
  for (std::size_t k = 0; k < end_work_.size(); ++k)
    end_work_[k] += (state_.end - state_.t) * weight * powers[k];
}

/// Takes powers and energies at the end of the step, where the observer is.
void Measure::take_end() {
  end_power_ = powers();
  take_balance();
  balance_mechanisms();
  state_.now.mechanism_kinetic = observer_.observation().mechanism_kinetic;
  take_turns();
}

// The absorbed power of a force is minus its power on the bodies.
std::vector<Measure::Absorbed> Measure::absorbed() const {
  std::vector<Absorbed> out;
  if (state_.t <= mean_from_)
    return out;
  const std::vector<std::string>& components = observer_.observation().components;
  system::for_each_law(
      s_, [&](const system::ElementList& list, std::size_t, const system::PortData& port) {
        if (!list.laws->absorbs)
          return;
        const auto k = static_cast<std::size_t>(
            std::find(components.begin(), components.end(), port.component) - components.begin());
        const double before = state_.now.mean_work.empty() ? 0.0 : state_.now.mean_work[k];
        out.push_back({port.component, (before - state_.work[k]) / (state_.t - mean_from_)});
      });
  return out;
}

/// Reads all motions and rotations at the observer's state.
void Measure::take_turns() {
  observer_.read(state_.now.turns);
  state_.now.turns.time = state_.end;
}

/// Powers by component; with several mechanisms then by load, and of each mechanism's rows.
std::vector<double> Measure::powers() const {
  const Observation& o = observer_.observation();
  std::vector<double> out = o.powers;
  if (s_.n_mechanisms <= 1)
    return out;
  for (const ComponentLoad& load : o.loads)
    out.push_back(load.power);
  out.insert(out.end(), o.mechanism_constraints.begin(), o.mechanism_constraints.end());
  return out;
}

/// Balance of each mechanism: change of its kinetic energy minus the work of all loads on it.
void Measure::balance_mechanisms() {
  const Observation& o = observer_.observation();
  const std::size_t loads = o.powers.size(), rows = loads + o.loads.size();
  for (std::size_t m = 0; m < state_.now.mechanisms.size(); ++m) {
    Balance& b = state_.now.mechanisms[m];
    b.error = o.mechanism_kinetic[m] - b.start - end_work_[rows + m];
    b.kinetic = std::max(b.kinetic, o.mechanism_kinetic[m]);
    b.exchanged = std::max({b.exchanged, o.mechanism_kinetic[m], std::abs(end_work_[rows + m])});
  }
  for (std::size_t k = 0; k < o.loads.size() && !state_.now.mechanisms.empty(); ++k) {
    const int m = s_.bodies[static_cast<std::size_t>(o.loads[k].body)].mechanism;
    const element::Work of = o.works[static_cast<std::size_t>(o.loads[k].component)];
    if (m < 0 || of == element::Work::part)
      continue;
    Balance& b = state_.now.mechanisms[static_cast<std::size_t>(m)];
    b.error -= end_work_[loads + k];
    b.exchanged = std::max(b.exchanged, std::abs(end_work_[loads + k]));
  }
}

std::vector<double> Measure::work_at(double t) const {
  if (!(t > state_.t && state_.end > state_.t))
    return state_.work;
  return t >= state_.end || powers_.empty() ? end_work_
                                            : work_inside((t - state_.t) / (state_.end - state_.t));
}

/// Work at t = state_.t + x h: integral of the polynomial through the powers at the nodes and at t,
/// where the observer is, h sum_k P_k int_0^x L_k, by Gauss's rule.
std::vector<double> Measure::work_inside(double x) const {
  // Gauss rule of 5 points on [0, 1], exact up to degree 9.
  static constexpr std::array<double, 5> places = {0.046910077030668, 0.230765344947158, 0.5,
                                                   0.769234655052842, 0.953089922969332};
  static constexpr std::array<double, 5> weights = {0.118463442528095, 0.239314335249683,
                                                    0.284444444444444, 0.239314335249683,
                                                    0.118463442528095};
  std::vector<double> nodes = state_.rule.nodes;
  const auto apart = [&](double node) { return std::abs(node - x) > 1e-3; };
  const bool own = std::all_of(nodes.begin(), nodes.end(), apart); // otherwise next to a node
  if (own)
    nodes.push_back(x);
  const std::vector<double> power = own ? powers() : std::vector<double>();
  std::vector<double> work = state_.work;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    double sum = 0.0, apart_from_j = 1.0;
    for (std::size_t k = 0; k < places.size(); ++k) {
      double value = x * weights[k];
      for (std::size_t i = 0; i < nodes.size(); ++i)
        value *= i == j ? 1.0 : x * places[k] - nodes[i];
      sum += value;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      apart_from_j *= i == j ? 1.0 : nodes[j] - nodes[i];
    const double weight = sum / apart_from_j;
    const std::vector<double>& P = j < powers_.size() ? powers_[j] : power;
    for (std::size_t k = 0; k < work.size(); ++k)
      work[k] += (state_.end - state_.t) * weight * P[k];
  }
  return work;
}

double Measure::balance_error(const std::vector<double>& work) const {
  const Observation& o = observer_.observation();
  double total_work = 0.0;
  for (std::size_t k = 0; k < o.powers.size(); ++k)
    // The kinetic energy of the fluid is on the left side already; parts belong to their whole.
    if (o.works[k] != element::Work::fluid && o.works[k] != element::Work::part)
      total_work += work[k];
  return o.kinetic + o.kinetic_added_mass - state_.now.whole.start - total_work;
}

/// Takes the balance of the scene at the end of the step, with the largest values so far.
void Measure::take_balance() {
  const Observation& o = observer_.observation();
  Balance& b = state_.now.whole;
  const double moving = o.kinetic + o.kinetic_added_mass;
  b.error = balance_error(end_work_);
  b.kinetic = std::max(b.kinetic, moving);
  b.exchanged = std::max(b.exchanged, std::abs(moving));
  for (std::size_t k = 0; k < o.powers.size(); ++k)
    b.exchanged = std::max(b.exchanged, std::abs(end_work_[k]));
  state_.now.largest_error = std::max(state_.now.largest_error, std::abs(b.error));
}

void Measure::accept() {
  state_.t = state_.end;
  state_.work = end_work_;
  state_.power = end_power_;
  observer_.follow(state_.now.turns);
}

void Measure::restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work) {
  const Observation& o = observer_.observe_balance(state_.t, y, yp);
  state_.power = powers();
  state_.end = state_.t;
  take_turns();
  observer_.follow(state_.now.turns);
  if (!work)
    return;
  state_.work[o.powers.size() - 1] += *work; // "constraints"
  // Only for a single mechanism: otherwise the water may transmit a part of the impulse.
  for (std::size_t m = 0; m < state_.now.mechanisms.size(); ++m)
    state_.work[o.powers.size() + o.loads.size() + m] +=
        o.mechanism_kinetic[m] - state_.now.mechanism_kinetic[m];
}

void Measure::set(State state) {
  state_ = std::move(state);
  before_ = state_.now;
  observer_.follow(state_.now.turns);
}

} // namespace hydrodae::measure
