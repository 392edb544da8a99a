#include "hydrodae/measure/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hydrodae::measure {

Measure::Measure(const system::Regime& system, double t0, const VectorX& y, const VectorX& yp)
    : s_(system), observer_(system), t_(t0), end_(t0), y_(y), yp_(yp) {
  const Observation& o = observer_.observe_balance(t0, y, yp);
  power_ = powers();
  work_ = end_work_ = std::vector<double>(power_.size(), 0.0);
  now_.whole.start = o.kinetic + o.kinetic_added_mass;
  if (s_.n_mechanisms > 1)
    for (double kinetic : o.mechanism_kinetic)
      now_.mechanisms.push_back({0.0, 0.0, kinetic, kinetic});
  take_turns();
  observer_.follow(now_.turns);
  before_ = now_;
}

/// Powers at the nodes of the step from t_ to t, on the solver's interpolant, and the work over it.
void Measure::begin(double t, const Interpolant& at, bool idle) {
  before_ = now_;
  end_ = t;
  const std::size_t last = rule_.nodes.size() - 1;
  powers_.resize(last + 1);
  powers_[0] = power_;
  for (std::size_t node = 1; node <= last; ++node) {
    const double time = node == last ? t : t_ + (t - t_) * rule_.nodes[node];
    at(time, y_, yp_);
    if (idle && node < last)
      observer_.observe_powers(time, y_, yp_);
    else
      observer_.observe_balance(time, y_, yp_);
    powers_[node] = powers();
  }
  end_work_ = work_;
  for (std::size_t node = 0; node <= last; ++node)
    add_work(rule_.weights[node], powers_[node]);
  take_mean(at);
  take_end();
}

/// The work at the time from which means are taken, if that is in this step. Leaves the observer at
/// the end of the step, where it was.
void Measure::take_mean(const Interpolant& at) {
  if (!(mean_from_ > t_ && mean_from_ <= end_))
    return;
  at(mean_from_, y_, yp_);
  observer_.observe_balance(mean_from_, y_, yp_);
  now_.mean_work = work_at(mean_from_);
  at(end_, y_, yp_);
  observer_.observe_balance(end_, y_, yp_);
}

void Measure::begin(double t, std::span<const double> weights, const StageState& stage,
                    const Interpolant& at) {
  if (mean_from_ > t_ && mean_from_ <= t)
    return begin(t, at, true);
  before_ = now_;
  end_ = t;
  powers_.clear();
  end_work_ = work_;
  add_work(weights[0], power_);
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
    end_work_[k] += (end_ - t_) * weight * powers[k];
}

/// The observer is there.
void Measure::take_end() {
  end_power_ = powers();
  take_balance();
  balance_mechanisms();
  now_.mechanism_kinetic = observer_.observation().mechanism_kinetic;
  take_turns();
}

// The power of a force on its bodies is what it does not absorb.
std::vector<Measure::Absorbed> Measure::absorbed() const {
  std::vector<Absorbed> out;
  if (t_ <= mean_from_)
    return out;
  const std::vector<std::string>& components = observer_.observation().components;
  system::for_each_law(
      s_, [&](const system::ElementList& list, std::size_t, const system::PortData& port) {
        if (!list.laws->absorbs)
          return;
        const auto k = static_cast<std::size_t>(
            std::find(components.begin(), components.end(), port.component) - components.begin());
        const double before = now_.mean_work.empty() ? 0.0 : now_.mean_work[k];
        out.push_back({port.component, (before - work_[k]) / (t_ - mean_from_)});
      });
  return out;
}

/// All motions and rotations where the observer is.
void Measure::take_turns() {
  observer_.read(now_.turns);
  now_.turns.time = end_;
}

/// By component; where there are several mechanisms then by load, and of each mechanism's rows.
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

/// Change of the kinetic energy of each mechanism's bodies minus the work of all loads on them.
void Measure::balance_mechanisms() {
  const Observation& o = observer_.observation();
  const std::size_t loads = o.powers.size(), rows = loads + o.loads.size();
  for (std::size_t m = 0; m < now_.mechanisms.size(); ++m) {
    Balance& b = now_.mechanisms[m];
    b.error = o.mechanism_kinetic[m] - b.start - end_work_[rows + m];
    b.kinetic = std::max(b.kinetic, o.mechanism_kinetic[m]);
    b.exchanged = std::max({b.exchanged, o.mechanism_kinetic[m], std::abs(end_work_[rows + m])});
  }
  for (std::size_t k = 0; k < o.loads.size() && !now_.mechanisms.empty(); ++k) {
    const int m = s_.bodies[static_cast<std::size_t>(o.loads[k].body)].mechanism;
    const element::Work of = o.works[static_cast<std::size_t>(o.loads[k].component)];
    if (m < 0 || of == element::Work::part)
      continue;
    Balance& b = now_.mechanisms[static_cast<std::size_t>(m)];
    b.error -= end_work_[loads + k];
    b.exchanged = std::max(b.exchanged, std::abs(end_work_[loads + k]));
  }
}

std::vector<double> Measure::work_at(double t) const {
  if (!(t > t_ && end_ > t_))
    return work_;
  return t >= end_ || powers_.empty() ? end_work_ : work_inside((t - t_) / (end_ - t_));
}

/// With t = t_ + x h: the integral of the polynomial through the powers at the nodes and at t,
/// where the observer is, h sum_k P_k int_0^x L_k, by Gauss's rule.
std::vector<double> Measure::work_inside(double x) const {
  // Of 5 points on [0, 1]: exact up to degree 9.
  static constexpr std::array<double, 5> places = {0.046910077030668, 0.230765344947158, 0.5,
                                                   0.769234655052842, 0.953089922969332};
  static constexpr std::array<double, 5> weights = {0.118463442528095, 0.239314335249683,
                                                    0.284444444444444, 0.239314335249683,
                                                    0.118463442528095};
  std::vector<double> nodes = rule_.nodes;
  const auto apart = [&](double node) { return std::abs(node - x) > 1e-3; };
  const bool own = std::all_of(nodes.begin(), nodes.end(), apart); // else next to one of them
  if (own)
    nodes.push_back(x);
  const std::vector<double> power = own ? powers() : std::vector<double>();
  std::vector<double> work = work_;
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
      work[k] += (end_ - t_) * weight * P[k];
  }
  return work;
}

double Measure::balance_error(const std::vector<double>& work) const {
  const Observation& o = observer_.observation();
  double total_work = 0.0;
  for (std::size_t k = 0; k < o.powers.size(); ++k)
    // The fluid's kinetic energy is on the left-hand side already; parts are in their whole.
    if (o.works[k] != element::Work::fluid && o.works[k] != element::Work::part)
      total_work += work[k];
  return o.kinetic + o.kinetic_added_mass - now_.whole.start - total_work;
}

/// Of the scene at the end of the step, with the largest values so far.
void Measure::take_balance() {
  const Observation& o = observer_.observation();
  Balance& b = now_.whole;
  const double moving = o.kinetic + o.kinetic_added_mass;
  b.error = balance_error(end_work_);
  b.kinetic = std::max(b.kinetic, moving);
  b.exchanged = std::max(b.exchanged, std::abs(moving));
  for (std::size_t k = 0; k < o.powers.size(); ++k)
    b.exchanged = std::max(b.exchanged, std::abs(end_work_[k]));
  now_.largest_error = std::max(now_.largest_error, std::abs(b.error));
}

void Measure::accept() {
  t_ = end_;
  work_ = end_work_;
  power_ = end_power_;
  observer_.follow(now_.turns);
}

void Measure::restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work) {
  const Observation& o = observer_.observe_balance(t_, y, yp);
  power_ = powers();
  end_ = t_;
  take_turns();
  observer_.follow(now_.turns);
  if (!work)
    return;
  work_[o.powers.size() - 1] += *work; // "constraints"
  // Of one mechanism alone: the water may have passed on a part of the impulse.
  for (std::size_t m = 0; m < now_.mechanisms.size(); ++m)
    work_[o.powers.size() + o.loads.size() + m] +=
        o.mechanism_kinetic[m] - now_.mechanism_kinetic[m];
}

void Measure::remember(Archive& a) {
  a(t_, end_, power_, work_, now_, rule_);
  if (!a.saves()) {
    before_ = now_;
    observer_.follow(now_.turns);
  }
}

} // namespace hydrodae::measure
