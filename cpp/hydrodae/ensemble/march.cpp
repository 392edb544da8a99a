#include "hydrodae/ensemble/march.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include "hydrodae/core/text.h"
#include "hydrodae/ensemble/lane_model.h"
#include "hydrodae/ensemble/running_sums.h"
#include "hydrodae/integrate/dormand_prince_8.h"
#include "hydrodae/integrate/explicit_steps.h"
#include "hydrodae/linalg/equations.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/session/sea_sample.h"
#include "hydrodae/system/forcing.h"
#include "hydrodae/system/motion_scale.h"

namespace hydrodae::ensemble {

namespace {

using integrate::ExplicitSteps;
using integrate::tableaux::rk8_a;
using integrate::tableaux::rk8_b;
using integrate::tableaux::rk8_c;
using integrate::tableaux::rk8_e3;
using integrate::tableaux::rk8_e5;
using integrate::tableaux::rk8_extra_a;
using integrate::tableaux::rk8_extra_c;

/// Part of the run below which steps do not come to its end in a bearable time: ten million.
constexpr double shortest = 1e-7;

/// Data of one run of the march.
struct Run {
  explicit Run(Start& start)
      : regime(start.regime), forcing(regime, start.scene.solver.end_time, start.scene.output.step),
        scale(start.regime, *start.pattern, start.y, start.yp, forcing.motion(),
              start.scene.sea.ramp, start.scene.solver.rtol),
        guards(run::make_end_guards(regime, start.scene.solver)), y(start.y), yp(start.yp) {}

  const system::Regime& regime;
  system::Forcing forcing;
  system::MotionScale scale;
  std::vector<std::unique_ptr<run::EndGuard>> guards;
  VectorX y, yp; ///< state at the end of the last step
  std::unique_ptr<session::SeaSample> sea;
  std::vector<double> exchanged; ///< energy of each balance [J]
  std::vector<double> sampled;   ///< work of each take-off at the last sample [J]
  std::string left;              ///< reason why it has left the march; empty: it has not
};

class March {
public:
  March(const std::vector<std::unique_ptr<Start>>& starts, const std::vector<Wanted>& wanted);
  std::vector<Outcome> operator()();

private:
  using Column = std::vector<Lanes>; ///< (n,) values of q, u, z

  static std::vector<const system::Regime*>
  regimes_of(const std::vector<std::unique_ptr<Start>>& starts);
  void start_samples();
  double first_step() const;
  void look(std::size_t k, double start);
  double bound();
  void set_stage(const Column& start, double h, std::size_t count, std::span<const double> weights);
  void try_step(double h);
  void combine(double h, std::span<const double> weights);
  Lanes norm();
  bool is_smooth(double h);
  Lanes error(double h);
  void remember(std::size_t stage, double t);
  void look_inside(double t0, double h);
  bool step(double end);
  void accept(double h, double t);
  void add_work(double h);
  void judge_energy(std::size_t k);
  void sample(double t0, double h, const std::vector<Lanes>& work);
  void leave(std::size_t k, const std::string& why);
  bool anyone() const;
  Outcome outcome(std::size_t k) const;

  const std::vector<std::unique_ptr<Start>>& starts_;
  const std::size_t count_; ///< number of runs; further lanes repeat the last one
  const model::Scene& scene_;
  LaneModel model_;
  std::vector<Run> runs_;
  const Index n_;
  const double end_, ramp_, rtol_;
  double t_ = 0.0, h_ = 0.0, last_error_ = 1e-4;
  long steps_ = 0, failures_ = 0, calls_ = 0;
  Column y_, y0_, stage_, error_, scales_; ///< `y0_`: at the start of the last step
  std::vector<Lanes> sums_;                ///< by group
  Lanes usual_jump_{0.0};                  ///< see is_smooth
  std::vector<Column> k_; ///< rates of the stages, at the end, and of three stages inside
  std::vector<std::vector<Lanes>>
      powers_;                   ///< powers at each stage and at the end: take-offs, then all loads
  std::vector<Lanes> work_;      ///< integrals of these powers [J]
  std::vector<Lanes> mean_from_; ///< integrals at the end of the ramp [J]
  std::vector<LaneModel::Balance> start_;
  std::vector<Lanes> churned_; ///< integral of |power| of each balance [J]
  long next_sample_ = 0;
  std::vector<double> row_;
  RunningSums sums_of_signals_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

/// Start of each lane; the last one again where there are fewer.
const Start& lane(const std::vector<std::unique_ptr<Start>>& starts, std::size_t k) {
  return *starts[std::min(k, starts.size() - 1)];
}

std::vector<const system::Regime*>
March::regimes_of(const std::vector<std::unique_ptr<Start>>& starts) {
  std::vector<const system::Regime*> out;
  for (std::size_t k = 0; k < width; ++k)
    out.push_back(&lane(starts, k).regime);
  return out;
}

March::March(const std::vector<std::unique_ptr<Start>>& starts, const std::vector<Wanted>& wanted)
    : starts_(starts), count_(std::min<std::size_t>(starts.size(), width)),
      scene_(starts[0]->scene), model_(regimes_of(starts)), n_(model_.size()),
      end_(scene_.solver.end_time), ramp_(starts[0]->system.has_waves() ? scene_.sea.ramp : 0.0),
      rtol_(scene_.solver.rtol), y_(static_cast<std::size_t>(n_)), y0_(y_), stage_(y_), error_(y_),
      scales_(y_), sums_(static_cast<std::size_t>(starts[0]->regime.n_error_groups())),
      k_(polynomial_stages, y_), sums_of_signals_(model_, wanted, ramp_, end_) {
  work_.assign(model_.take_offs().size() + model_.balances().size(), Lanes(0.0));
  powers_.assign(stages + 1, work_);
  runs_.reserve(count_);
  for (std::size_t k = 0; k < count_; ++k)
    runs_.emplace_back(*starts[k]);
  mean_from_ = work_;
  for (std::size_t k = 0; k < width; ++k) {
    const Run& run = runs_[std::min(k, count_ - 1)];
    for (Index i = 0; i < n_; ++i)
      y_[static_cast<std::size_t>(i)].lane[k] = run.y[i];
    model_.accept(static_cast<int>(k), 0.0, run.y, run.yp);
  }
  model_.accelerations(0.0, y_.data(), k_[stages].data());
  remember(stages, 0.0);
  start_ = model_.balances();
  churned_.assign(start_.size(), Lanes(0.0));
  for (Run& run : runs_)
    run.exchanged.assign(start_.size(), 0.0);
  start_samples();
}

/// Work of the take-offs, under the names that the samples of a sea look for.
void March::start_samples() {
  std::vector<Channel> channels;
  for (const std::string& name : model_.take_offs())
    channels.push_back({"energy/work/" + name, 1, "J", "-", ""});
  for (std::size_t k = 0; k < count_; ++k)
    runs_[k].sea = std::make_unique<session::SeaSample>(starts_[k]->scene, channels);
  row_.resize(channels.size());
}

bool March::anyone() const {
  return std::any_of(runs_.begin(), runs_.end(), [](const Run& run) { return run.left.empty(); });
}

void March::leave(std::size_t k, const std::string& why) {
  if (k < count_ && runs_[k].left.empty())
    runs_[k].left = "at t = " + rounded_text(t_) + " s: " + why;
}

/// First step [s], as a run alone begins (ExplicitRk), the shortest of all.
double March::first_step() const {
  double out = INFINITY;
  for (const Run& run : runs_)
    out = std::min(out, linalg::first_step(run.regime, rtol_, run.y, run.yp));
  return out * std::pow(rtol_, 0.2 - 0.5);
}

/// The latest time that a step may reach by what is known of waves and drives ahead [s].
double March::bound() {
  double out = INFINITY;
  for (std::size_t k = 0; k < count_; ++k)
    if (runs_[k].left.empty())
      out = std::min(
          out,
          runs_[k].forcing.limit(model_.turns(static_cast<int>(k)), ExplicitSteps::gap, 1.0).time);
  return scene_.solver.max_step > 0.0 ? std::min(out, t_ + scene_.solver.max_step) : out;
}

/// stage_ = start + h sum_j weights_j k_j
HYDRODAE_WIDE void March::set_stage(const Column& start, double h, std::size_t count,
                                    std::span<const double> weights) {
  for (std::size_t i = 0; i < stage_.size(); ++i) {
    Lanes sum(0.0);
    for (std::size_t j = 0; j < count; ++j)
      if (weights[j] != 0.0)
        sum += Lanes(h * weights[j]) * k_[j][i];
    stage_[i] = start[i] + sum;
  }
}

/// Powers and signals at the state of the last accelerations.
void March::remember(std::size_t stage, double t) {
  sums_of_signals_.see(stage, t, k_[stage].data());
  std::copy(model_.absorbed().begin(), model_.absorbed().end(), powers_[stage].begin());
  auto power = powers_[stage].begin() + std::ssize(model_.absorbed());
  for (const LaneModel::Balance& balance : model_.balances())
    *power++ = balance.power;
}

/// The stages and the end of a step before the projection, in stage_.
void March::try_step(double h) {
  k_[0] = k_[stages];
  powers_[0] = powers_[stages];
  sums_of_signals_.begin_step();
  for (std::size_t i = 1; i < stages; ++i) {
    set_stage(y_, h, i, std::span(rk8_a).subspan(i * stages));
    model_.accelerations(t_ + rk8_c[i] * h, stage_.data(), k_[i].data());
    remember(i, t_ + rk8_c[i] * h);
    ++calls_;
  }
  set_stage(y_, h, stages, rk8_b);
}

/// error_ = h sum_j weights_j k_j
HYDRODAE_WIDE void March::combine(double h, std::span<const double> weights) {
  for (std::size_t i = 0; i < error_.size(); ++i) {
    Lanes e(0.0);
    for (std::size_t j = 0; j < stages; ++j)
      if (weights[j] != 0.0)
        e += Lanes(h * weights[j]) * k_[j][i];
    error_[i] = e;
  }
}

/// Root mean square of error_ in units of the tolerance over each group of bodies, the largest of
/// the groups.
HYDRODAE_WIDE Lanes March::norm() {
  const system::Regime& s = runs_[0].regime;
  std::fill(sums_.begin(), sums_.end(), Lanes(0.0));
  for (std::size_t i = 0; i < error_.size(); ++i) {
    const Lanes e =
        error_[i] /
        (Lanes(rtol_) * (scales_[i] + Lanes(s.relative[static_cast<Index>(i)]) * abs(y_[i])));
    sums_[static_cast<std::size_t>(s.error_group[i])] += e * e;
  }
  Lanes out(0.0);
  for (std::size_t g = 0; g < sums_.size(); ++g)
    for (int k = 0; k < width; ++k) {
      const double mean = sums_[g].lane[k] / s.group_size[static_cast<Index>(g)];
      out.lane[k] = mean <= out.lane[k] ? out.lane[k] : mean; // NaN stays
    }
  return sqrt(out);
}

/// Local error from the two estimates of the method (Hairer, Norsett and Wanner, section II.10).
Lanes March::error(double h) {
  combine(h, rk8_e5);
  const Lanes five = norm();
  combine(h, rk8_e3);
  const Lanes three = norm();
  Lanes out;
  for (int k = 0; k < width; ++k) {
    const double both = std::hypot(five.lane[k], 0.1 * three.lane[k]);
    out.lane[k] = both > 0.0 ? five.lane[k] * five.lane[k] / both : (both == 0.0 ? 0.0 : INFINITY);
  }
  return out;
}

/// Returns whether the accelerations at the end of the step agree with those of the last stage. See
/// ExplicitRk::is_smooth: a slope that changes within the step shows here.
bool March::is_smooth(double h) {
  for (std::size_t i = 0; i < error_.size(); ++i)
    error_[i] = Lanes(h) * (k_[stages][i] - k_[stages - 1][i]);
  const Lanes jump = norm();
  Lanes next = usual_jump_;
  for (std::size_t k = 0; k < count_; ++k)
    if (runs_[k].left.empty() && !ExplicitSteps::is_usual(jump.lane[k], next.lane[k]))
      return false;
  usual_jump_ = next;
  return true;
}

/// Makes one step up to `end` at most; false where no run is left.
bool March::step(double end) {
  constexpr double power = 1.0 / 8.0; ///< exponent of the error that controls the next step
  for (std::size_t i = 0; i < scales_.size(); ++i)
    for (std::size_t k = 0; k < width; ++k)
      scales_[i].lane[k] = runs_[std::min(k, count_ - 1)].regime.scale[static_cast<Index>(i)];
  bool failed = false;
  for (;;) {
    if (!anyone())
      return false;
    const bool fixed = scene_.solver.step > 0.0;
    const double wanted = h_, allowed = (fixed ? end : std::min(end, bound())) - t_;
    double h = std::min(h_, allowed);
    if (allowed - h < 0.1 * h) // no sliver of a step behind it
      h = allowed;
    model_.sound.fill(true);
    try_step(h);
    const Lanes err = fixed ? Lanes(0.0) : error(h);
    double worst = 0.0;
    std::size_t by = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      if (!runs_[k].left.empty())
        continue;
      const double e = model_.sound[k] && std::isfinite(err.lane[k]) ? err.lane[k] : 1e6;
      if (e > worst) {
        worst = e;
        by = k;
      }
    }
    if (fixed && worst > 1.0) {
      leave(by, "its accelerations are not finite");
      continue;
    }
    if (worst > 1.0) {
      ++failures_;
      failed = true;
      h_ = h *
           std::max(ExplicitSteps::least_growth, ExplicitSteps::safety * std::pow(worst, -power));
      if (h_ < shortest * end_)
        leave(by, "its steps become too short for the others");
      continue;
    }
    const double reached = h == end - t_ ? end : t_ + h;
    model_.project(stage_.data());
    model_.accelerations(reached, stage_.data(), k_[stages].data());
    ++calls_;
    remember(stages, reached);
    if (!fixed && !is_smooth(h)) {
      ++failures_;
      failed = true;
      h_ = 0.25 * h;
      k_[stages] = k_[0];
      powers_[stages] = powers_[0];
      sums_of_signals_.reject();
      continue;
    }
    for (std::size_t k = 0; k < count_; ++k)
      if (!model_.sound[k])
        leave(k, "its pose is singular, or its joints do not close");
    accept(h, reached);
    if (fixed) {
      h_ = scene_.solver.step;
      return true;
    }
    h_ = h * ExplicitSteps::growth(worst, power, failed ? 1.0 : ExplicitSteps::most_growth,
                                   last_error_);
    if (h == allowed) // a step that was cut says nothing against longer ones
      h_ = std::max(h_, wanted);
    return true;
  }
}

void March::accept(double h, double t) {
  y0_ = y_;
  y_ = stage_;
  const std::vector<Lanes> before = work_;
  add_work(h);
  sample(t_, h, before);
  const double start = t_;
  t_ = t;
  ++steps_;
  for (std::size_t k = 0; k < count_; ++k) {
    Run& run = runs_[k];
    if (!run.left.empty())
      continue;
    for (Index i = 0; i < n_; ++i) {
      run.y[i] = y_[static_cast<std::size_t>(i)].lane[k];
      run.yp[i] = k_[stages][static_cast<std::size_t>(i)].lane[k];
    }
    model_.accept(static_cast<int>(k), t_, run.y, run.yp);
    run.scale.accept(t_, run.y);
    look(k, start);
  }
  if (sums_of_signals_.looks_inside(start))
    look_inside(start, h);
  sums_of_signals_.add(start, h);
}

/// Signals at the three further stages of the interpolant (ExplicitRk::extend).
void March::look_inside(double t0, double h) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t stage = stages + 1 + i;
    set_stage(y0_, h, stage, std::span(rk8_extra_a).subspan(16 * i));
    const double t = t0 + rk8_extra_c[i] * h;
    model_.accelerations(t, stage_.data(), k_[stage].data());
    sums_of_signals_.see(stage, t, k_[stage].data());
    ++calls_;
  }
}

/// The guards of a run alone, and the loads that have no meaning everywhere.
void March::look(std::size_t k, double start) {
  Run& run = runs_[k];
  try {
    for (const std::unique_ptr<run::EndGuard>& guard : run.guards)
      guard->look({start, t_, false, run.y, run.yp, model_.turns(static_cast<int>(k))});
    model_.check(k, t_);
    judge_energy(k);
  } catch (const SolverError& error) {
    leave(k, error.halt.what);
  }
}

/// The work over the step by the stages of the method, as one more unknown.
HYDRODAE_WIDE void March::add_work(double h) {
  for (std::size_t i = 0; i < work_.size(); ++i)
    for (std::size_t j = 0; j < stages; ++j)
      if (rk8_b[j] != 0.0)
        work_[i] += Lanes(h * rk8_b[j]) * powers_[j][i];
  const std::size_t first = model_.take_offs().size();
  for (std::size_t b = 0; b < churned_.size(); ++b)
    churned_[b] += Lanes(0.5 * h) * (abs(powers_[0][first + b]) + abs(powers_[stages][first + b]));
}

/// Kinetic energy gained minus work, of the scene and of each mechanism, against the energy
/// exchanged: as the guard of the energy does for a run alone. What a wrong step exchanges does not
/// count.
void March::judge_energy(std::size_t k) {
  constexpr double more = 10.0; // as often as before the step the exchange is believed
  const double allowed = run::allowed_energy(scene_.solver);
  if (allowed == 0.0)
    return;
  Run& run = runs_[k];
  const std::size_t first = model_.take_offs().size();
  for (std::size_t b = 0; b < start_.size(); ++b) {
    const double kinetic = model_.balances()[b].kinetic.lane[k];
    double now = std::max(kinetic, churned_[b].lane[k]);
    for (std::size_t i = 0; i < first && b == 0; ++i)
      now = std::max(now, std::abs(work_[i].lane[k]));
    const double believed = std::min(now, std::max(more * run.exchanged[b], kinetic));
    run.exchanged[b] = std::max(run.exchanged[b], now);
    const double missing =
        std::abs(kinetic - start_[b].kinetic.lane[k] - work_[first + b].lane[k]) -
        run::energy_of_errors(run.regime, rtol_, static_cast<int>(b) - 1);
    if (!(missing <= allowed * believed))
      leave(k, "energy is missing, " + rounded_text(missing / believed) + " of what was exchanged");
  }
}

/// Work of the take-offs at the times of the output within the step, by the cubic polynomial
/// through works and powers at its ends: the intervals of means need no more. Where both powers
/// have one sign, the work does not turn back: intervals of a mean whose power keeps its sign are
/// ratios (math/sampling.h).
void March::sample(double t0, double h, const std::vector<Lanes>& before) {
  const double dt = scene_.output.step;
  for (; static_cast<double>(next_sample_) * dt <= (t0 + h) * (1.0 + 1e-14); ++next_sample_) {
    const double t = std::min(static_cast<double>(next_sample_) * dt, t0 + h), x = (t - t0) / h,
                 z = 1.0 - x;
    const double by_end = x * x * (3.0 - 2.0 * x);
    for (std::size_t k = 0; k < count_; ++k) {
      std::vector<double>& sampled = runs_[k].sampled;
      sampled.resize(row_.size());
      for (std::size_t i = 0; i < row_.size(); ++i) {
        const double first = before[i].lane[k], last = work_[i].lane[k], p0 = powers_[0][i].lane[k],
                     p1 = powers_[stages][i].lane[k];
        double work = (1.0 - by_end) * first + by_end * last + h * x * z * (z * p0 - x * p1);
        if (p0 * p1 >= 0.0) { // the integral of a step may turn back by its error
          const double sign = p0 + p1 < 0.0 ? -1.0 : 1.0,
                       least = std::max(sign * first, sign * sampled[i]);
          work = sign * std::clamp(sign * work, least, std::max(sign * last, least));
        }
        sampled[i] = work;
        row_[i] = -work;
      }
      runs_[k].sea->take(t, ramp_, row_);
    }
  }
}

Outcome March::outcome(std::size_t k) const {
  const Run& run = runs_[k];
  if (!run.left.empty())
    return {std::nullopt, run.left, {}};
  RunStatistics s;
  s.status = "completed";
  s.method = "explicit_rk in lanes";
  s.steps = steps_;
  s.residual_calls = calls_;
  s.error_test_failures = failures_;
  s.end_time = t_;
  s.at_rest = run.scale.at_rest();
  s.accuracy.missing = "solver.accuracy = \"none\"";
  s.unknowns = run.regime.n;
  s.mean_power_from = ramp_;
  for (std::size_t i = 0; i < model_.take_offs().size() && t_ > ramp_; ++i)
    s.mean_power.emplace_back(model_.take_offs()[i],
                              (work_[i].lane[k] - mean_from_[i].lane[k]) / (t_ - ramp_));
  run.sea->write(s);
  s.wall_time = s.solver_time =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count() /
      static_cast<double>(count_);
  return {s, "", sums_of_signals_.of(k)};
}

std::vector<Outcome> March::operator()() {
  const SolverOptions& options = scene_.solver;
  h_ = options.step > 0.0
           ? options.step
           : std::min(options.max_step > 0.0 ? options.max_step : end_, first_step());
  const auto stop = [&] {
    const double next = sums_of_signals_.next_stop(t_);
    return t_ < ramp_ ? std::min(ramp_, next) : next;
  };
  while (t_ < end_ && step(stop()))
    if (t_ == ramp_)
      mean_from_ = work_;
  std::vector<Outcome> out;
  for (std::size_t k = 0; k < count_; ++k)
    out.push_back(outcome(k));
  return out;
}

} // namespace

std::vector<Outcome> march(const std::vector<std::unique_ptr<Start>>& starts,
                           const std::vector<Wanted>& wanted) {
  return March(starts, wanted)();
}

} // namespace hydrodae::ensemble
