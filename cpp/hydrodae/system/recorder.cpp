#include "hydrodae/system/recorder.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::system {

Recorder::Recorder(const Regime& system, double t0, const VectorX& y, const VectorX& yp)
    : s_(system), observer_(system), t_(t0), end_(t0), y_(y), yp_(yp) {
  const Observation& o = observer_.observe(t0, y, yp);
  power_ = powers();
  work_.assign(power_.size(), 0.0);
  energy0_ = o.kinetic + o.kinetic_added_mass;
  if (s_.n_mechanisms > 1)
    for (double kinetic : o.mechanism_kinetic)
      mechanisms_.push_back({0.0, 0.0, kinetic, kinetic});
  take_turns();
  observer_.follow(turns_);
  make_channels();
}

/// Powers at the nodes of the step from t_ to t, on the solver's interpolant, and the work over it.
/// Leaves the observer at t.
void Recorder::begin(double t, const Interpolant& at) {
  before_.whole = whole_;
  before_.mechanisms = mechanisms_;
  before_.turns = turns_;
  before_.mean_work = mean_work_;
  before_.kinetic = end_kinetic_;
  end_ = t;
  const double h = end_ - t_;
  const std::size_t last = rule_.nodes.size() - 1;
  powers_.resize(last + 1);
  powers_[0] = power_;
  for (std::size_t node = 1; node <= last; ++node) {
    const double time = node == last ? t : t_ + h * rule_.nodes[node];
    at(time, y_, yp_);
    observer_.observe(time, y_, yp_);
    powers_[node] = powers();
  }
  end_work_ = work_;
  for (std::size_t node = 0; node <= last; ++node)
    for (std::size_t k = 0; k < work_.size(); ++k)
      end_work_[k] += h * rule_.weights[node] * powers_[node][k];
  if (mean_from_ > t_ && mean_from_ <= t) {
    at(mean_from_, y_, yp_);
    observer_.observe(mean_from_, y_, yp_);
    mean_work_ = work_at((mean_from_ - t_) / h);
    at(t, y_, yp_);
    observer_.observe(t, y_, yp_);
  }
  whole_.balance_error = balance(end_work_);
  balance_mechanisms();
  end_kinetic_ = observer_.observation().mechanism_kinetic;
  take_turns();
}

// The power of a force on its bodies is what it does not absorb.
std::vector<Recorder::Absorbed> Recorder::absorbed() const {
  std::vector<Absorbed> out;
  if (t_ <= mean_from_)
    return out;
  const std::vector<std::string>& components = observer_.observation().components;
  for_each_law(s_, [&](const ElementList& list, std::size_t, const PortData& port) {
    if (!list.laws->absorbs)
      return;
    const auto k = static_cast<std::size_t>(
        std::find(components.begin(), components.end(), port.component) - components.begin());
    const double before = mean_work_.empty() ? 0.0 : mean_work_[k];
    out.push_back({port.component, (before - work_[k]) / (t_ - mean_from_)});
  });
  return out;
}

/// All motions and rotations where the observer is.
void Recorder::take_turns() {
  observer_.read(turns_);
  turns_.time = end_;
}

/// By component; where there are several mechanisms then by load, and of each mechanism's rows.
std::vector<double> Recorder::powers() const {
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
void Recorder::balance_mechanisms() {
  const Observation& o = observer_.observation();
  const std::size_t loads = o.powers.size(), rows = loads + o.loads.size();
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    Balance& b = mechanisms_[m];
    b.error = o.mechanism_kinetic[m] - b.start - end_work_[rows + m];
    b.kinetic = std::max(b.kinetic, o.mechanism_kinetic[m]);
    b.exchanged = std::max({b.exchanged, o.mechanism_kinetic[m], std::abs(end_work_[rows + m])});
  }
  for (std::size_t k = 0; k < o.loads.size() && !mechanisms_.empty(); ++k) {
    const int m = s_.bodies[static_cast<std::size_t>(o.loads[k].body)].mechanism;
    const element::Work of = o.works[static_cast<std::size_t>(o.loads[k].component)];
    if (m < 0 || of == element::Work::part)
      continue;
    Balance& b = mechanisms_[static_cast<std::size_t>(m)];
    b.error -= end_work_[loads + k];
    b.exchanged = std::max(b.exchanged, std::abs(end_work_[loads + k]));
  }
}

/// Work until t = t_ + x h, where the observer is: the integral of the polynomial through the
/// powers at the nodes and at t, h sum_k P_k int_0^x L_k, by the rule itself on [0, x].
std::vector<double> Recorder::work_at(double x) const {
  if (x <= 0.0)
    return work_;
  std::vector<double> nodes = rule_.nodes;
  const auto apart = [&](double node) { return std::abs(node - x) > 1e-3; };
  const bool own = std::all_of(nodes.begin(), nodes.end(), apart); // else next to one of them
  if (own)
    nodes.push_back(x);
  const std::vector<double> power = powers();
  std::vector<double> work = work_;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    double weight = 0.0;
    for (std::size_t node = 0; node < rule_.nodes.size(); ++node) {
      double value = x * rule_.weights[node];
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (i != j)
          value *= (x * rule_.nodes[node] - nodes[i]) / (nodes[j] - nodes[i]);
      weight += value;
    }
    const std::vector<double>& P = j < powers_.size() ? powers_[j] : power;
    for (std::size_t k = 0; k < work.size(); ++k)
      work[k] += (end_ - t_) * weight * P[k];
  }
  return work;
}

/// Change of the kinetic energies minus the work of all forces; keeps the largest.
double Recorder::balance(const std::vector<double>& work) {
  const Observation& o = observer_.observation();
  const double moving = o.kinetic + o.kinetic_added_mass;
  double total_work = 0.0, exchanged = std::abs(moving);
  for (std::size_t k = 0; k < o.powers.size(); ++k) {
    // The fluid's kinetic energy is on the left-hand side already; parts are in their whole.
    if (o.works[k] != element::Work::fluid && o.works[k] != element::Work::part)
      total_work += work[k];
    exchanged = std::max(exchanged, std::abs(work[k]));
  }
  const double error = moving - energy0_ - total_work;
  whole_.largest_kinetic = std::max(whole_.largest_kinetic, moving);
  whole_.largest_energy = std::max(whole_.largest_energy, exchanged);
  whole_.largest_error = std::max(whole_.largest_error, std::abs(error));
  return error;
}

void Recorder::accept() {
  t_ = end_;
  work_ = end_work_;
  power_ = powers_.back();
  observer_.follow(turns_);
}

void Recorder::take_back() {
  end_ = t_;
  whole_ = before_.whole;
  mechanisms_ = before_.mechanisms;
  turns_ = before_.turns;
  mean_work_ = before_.mean_work;
  end_kinetic_ = before_.kinetic;
}

void Recorder::restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work) {
  const Observation& o = observer_.observe(t_, y, yp);
  power_ = powers();
  end_ = t_;
  take_turns();
  observer_.follow(turns_);
  if (!work)
    return;
  work_[o.powers.size() - 1] += *work; // "constraints"
  // Of one mechanism alone: the water may have passed on a part of the impulse.
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    work_[o.powers.size() + o.loads.size() + m] += o.mechanism_kinetic[m] - end_kinetic_[m];
}

void Recorder::sample(double t, const Interpolant& at, std::span<double> row) {
  if (end_ > t_) // else the start of the run
    at(t, y_, yp_);
  observer_.observe(t, y_, yp_);
  fill(t, row, work_at(end_ > t_ ? (t - t_) / (end_ - t_) : 0.0));
}

void Recorder::look(const VectorX& y, const VectorX& yp, std::span<double> row) {
  const Whole before = whole_;
  y_ = y;
  yp_ = yp;
  observer_.observe(t_, y_, yp_);
  fill(t_, row, work_);
  whole_ = before;
}

double Recorder::relative_balance_error() const {
  return whole_.largest_energy > 0.0 ? whole_.largest_error / whole_.largest_energy : 0.0;
}

void Recorder::remember(Archive& a) {
  a(t_, end_, power_, work_, turns_, end_kinetic_, mechanisms_, energy0_, whole_, rule_,
    mean_work_);
  if (!a.saves())
    observer_.follow(turns_);
}

} // namespace hydrodae::system
