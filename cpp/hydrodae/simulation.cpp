#include "hydrodae/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/io/output_place.h"
#include "hydrodae/io/results_file.h"
#include "hydrodae/run_output.h"
#include "hydrodae/solve/consistent_start.h"
#include "hydrodae/solve/energy_guard.h"
#include "hydrodae/solve/equations.h"
#include "hydrodae/solve/equilibrium.h"
#include "hydrodae/solve/guards.h"
#include "hydrodae/solve/integrator.h"
#include "hydrodae/solve/runge_kutta.h"
#include "hydrodae/solve/switching.h"
#include "hydrodae/solve/trust.h"
#include "hydrodae/solve/verification.h"
#include "hydrodae/system/forcing.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/linear_limits.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/recorder.h"

namespace hydrodae {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The scene at a tenth of the tolerance, or at half the step.
model::Scene more_exact(model::Scene scene) {
  scene.solver.rtol *= 0.1;
  if (scene.solver.step > 0.0)
    scene.solver.step *= 0.5;
  return scene;
}

void take(const solve::Statistics& from, RunStatistics& to) {
  to.steps = from.steps;
  to.residual_calls = from.residual_calls;
  to.jacobian_calls = from.jacobian_calls;
  to.newton_iterations = from.newton_iterations;
  to.error_test_failures = from.error_test_failures;
  to.convergence_failures = from.convergence_failures;
}

/// The columns that belong to the solver rather than to the scene.
const std::vector<Channel> solver_channels = {
    {"solver/step", 1, "s", "-", "Length of the step that holds this sample."},
    {"solver/order", 1, "-", "-", "Order of that step."}};

/// Part of a step at its ends where the polynomial through the stages of radau is nearly exact.
constexpr double step_edge = 0.02;

/// One run from the start to the end: the integrator makes steps, the recorder turns them into
/// rows.
class Run {
public:
  /// @param other  run whose samples this one is compared with
  Run(const model::Scene& scene, const std::string& output_path, const Progress& progress,
      solve::Verification* other = nullptr)
      : scene_(scene), progress_(progress), other_(other), started_(Clock::now()),
        options_(scene.solver),
        approaches_events_(scene.solver.method == "radau" && scene.solver.step == 0.0),
        system_(solve::starting_system(scene)), pattern_(system::find_pattern(system_)),
        y_(system::initial_state(system_)) {
    solve::consistent_start(system_, pattern_, y_, yp_);
    system::take_time_scales(system_, y_, yp_);
    forcing_ = std::make_unique<system::Forcing>(system_, scene.solver.end_time, scene.output.step);
    motion_scale_ = std::make_unique<system::MotionScale>(
        system_, pattern_, y_, yp_, forcing_->motion(), scene.sea.ramp, scene.solver.rtol);
    if (!system_.switches.empty()) {
      switching_ = std::make_unique<solve::Switching>(system_, scene.solver.rtol);
      switching_->settle(0.0, y_, yp_);
    }
    formulate(scene.solver);
    begin_history();
    energy_guard_ = std::make_unique<solve::EnergyGuard>(system_, scene.solver);
    if (system_.formulation != system::Formulation::stabilised && !scene.solver.force)
      drift_guard_ = std::make_unique<solve::DriftGuard>(system_);
    if (solve::has_loop(system_) && (energy_guard_->minds_singular_poses() || drift_guard_))
      pose_guard_ = std::make_unique<solve::PoseGuard>(system_, y_);
    if (scene.solver.branch_guard) {
      branch_guard_ = std::make_unique<solve::BranchGuard>(system_);
      if (!branch_guard_->active())
        branch_guard_.reset();
    }
    if (const double allowed = scene.solver.step_guard.value_or(0.02);
        scene.solver.step > 0.0 && allowed > 0.0)
      step_guard_ = std::make_unique<solve::StepGuard>(system_, allowed, scene.solver.end_time);
    integrator_ = solve::make_integrator(system_, pattern_, options_, 0.0, y_, yp_);
    trust_ = std::make_unique<solve::Trust>(system_, pattern_, scene.solver, y_, yp_);
    recorder_ = std::make_unique<system::Recorder>(system_, 0.0, y_, yp_);
    statistics_.mean_power_from = system_.has_waves() ? scene.sea.ramp : 0.0;
    recorder_->average_from(statistics_.mean_power_from);
    linear_limits_ = system::linear_limits(scene, system_);
    std::vector<Channel> channels = recorder_->channels();
    channels.insert(channels.end(), solver_channels.begin(), solver_channels.end());
    const std::vector<Channel> taken = impacts_.channels();
    channels.insert(channels.end(), taken.begin(), taken.end());
    row_.resize(recorder_->width() + solver_channels.size() + impacts_.width());
    if (!output_path.empty())
      file_ =
          std::make_unique<io::ResultsFile>(output_path, channels, header(scene, system_.notes));
    statistics_.unknowns = system_.n;
    statistics_.nonzeros = pattern_.nonzeros();
    statistics_.notes = system_.notes;
    statistics_.setup_time = seconds_since(started_);
  }

  /// @param verify  compares the motion with that of a more exact run
  RunStatistics operator()(bool verify) {
    try {
      if (verify)
        own_ = std::make_unique<solve::Verification>(system_);
      statistics_.status = march() ? "completed" : "interrupted";
      if (verify && statistics_.status == "completed" && !this->verify())
        statistics_.status = "interrupted";
      close(statistics_.status == "completed" ? "" : "stopped on request");
    } catch (const std::exception& error) {
      statistics_.status = "failed";
      close(error.what());
      throw;
    }
    return statistics_;
  }

private:
  /// The second run; false when it was asked to stop. Throws SolverError when it does not confirm
  /// the first.
  bool verify() {
    const model::Scene scene = more_exact(scene_);
    const std::string how = scene.solver.step > 0.0
                                ? "step = " + number_text(scene.solver.step) + " s"
                                : "rtol = " + number_text(scene.solver.rtol);
    try {
      Run second(scene, "", progress_, own_.get());
      if (!second.march())
        return false;
    } catch (const SolverError& error) {
      throw SolverError(error.time, "not verified: the second run, with " + how + ", " +
                                        std::string(error.what()));
    }
    const solve::Verification::Difference d = own_->largest();
    statistics_.verified_error = d.error;
    statistics_.verified_error_of = d.body;
    statistics_.verified_error_time = d.time;
    if (const double allowed = scene_.solver.error_guard; allowed > 0.0 && d.error > allowed)
      throw SolverError(d.time, "not verified: a second run, with " + how + ", has " +
                                    in_quotes(d.body) + " off by " + rounded_text(d.error) +
                                    " of the motion at t = " + number_text(d.time) +
                                    " s, more than " + number_text(allowed) +
                                    " (solver.error_guard); a smaller tolerance or step may do");
    return true;
  }

  /// The start is found on the stabilised equations; then the formulation may change.
  void formulate(const model::SolverOptions& options) {
    using system::Formulation;
    static const std::map<std::string, Formulation> formulations = {
        {"stabilised", Formulation::stabilised},
        {"index_2", Formulation::index_2},
        {"index_3", Formulation::index_3},
        {"index_1", Formulation::index_1}};
    system_.formulation = formulations.at(options.formulation);
    if (options.baumgarte_time > 0.0)
      system_.baumgarte_rate = 1.0 / options.baumgarte_time;
    if (system_.formulation != Formulation::stabilised || switching_)
      pattern_ = system::find_pattern(system_);
  }

  /// One step, cut short where a stop or dry friction changes.
  /// @returns whether it ends in such an event
  bool advance() {
    const Clock::time_point before = Clock::now();
    last_start_ = step_start_;
    step_start_ = t_;
    if (switching_ && approaches_events_)
      at_(t_, y_start_, yp_start_);
    limit_step();
    try {
      t_ = integrator_->step();
    } catch (const SolverError& error) {
      throw SolverError(error.time, with_remedy(error.what()));
    }
    std::optional<double> event;
    if (switching_)
      event = switching_->locate(step_start_, t_, quadrature_nodes_ + 2, at_);
    if (event && inside_of_step(*event)) {
      approach(*event);
      statistics_.solver_time += seconds_since(before);
      return advance();
    }
    t_ = event.value_or(t_);
    statistics_.solver_time += seconds_since(before);
    solve::Statistics all = before_events_;
    all += integrator_->statistics();
    take(all, statistics_);
    return event.has_value();
  }

  /// Is a time in the middle of the last step, where the polynomial through the stages of radau is
  /// of a lower order than the end, so that each event would leave its error?
  bool inside_of_step(double t) const {
    const double least = step_edge * (t_ - step_start_);
    return approaches_events_ && t - step_start_ > least && t_ - t > least;
  }

  /// Takes the last step back, and lets the next ones end at the event.
  void approach(double event) {
    before_events_ += integrator_->statistics();
    t_ = step_start_;
    event_near_ = event;
    switching_->follow(recorder_->turns());
    integrator_ = solve::make_integrator(system_, pattern_, options_, t_, y_start_, yp_start_);
  }

  /// No step may pass over what is known ahead of time, nor over an event that was found.
  void limit_step() {
    const system::Forcing::Limit limit = forcing_->limit(recorder_->turns());
    if (event_near_ - t_ <= step_edge * (t_ - last_start_)) // no sliver of a step
      event_near_ = INFINITY;
    integrator_->bound(std::min(limit.time, event_near_));
    const double step = scene_.solver.step;
    constexpr double too_long = 4.0;
    if (step > too_long * (limit.time - t_))
      throw SolverError(t_, "stopped at t = " + number_text(t_) + " s: the step of " +
                                number_text(step) + " s is too long for " + *limit.by +
                                ", which may be passed over; " + rounded_text(limit.time - t_) +
                                " s may do");
  }

  /// Goes on from an event with the rows that hold from now on.
  void restart() {
    const Clock::time_point before = Clock::now();
    at_(t_, y_, yp_);
    switching_->follow(recorder_->turns());
    const std::optional<double> struck = switching_->settle(t_, y_, yp_);
    recorder_->restart(y_, yp_, struck);
    for (std::size_t k = 0; struck && k < system_.switches.size(); ++k)
      if (!switching_->struck()[k].impacts.empty())
        trust_->strike(
            system::moving_body(system_, system::joint_of(system_, system_.switches[k].motion))
                ->mechanism);
    if (history_)
      history_->append(t_, y_, yp_);
    statistics_.events = switching_->events() - 1; // without the start
    if (t_ < scene_.solver.end_time) {
      before_events_ += integrator_->statistics();
      pattern_ = system::find_pattern(system_);
      integrator_ = solve::make_integrator(system_, pattern_, options_, t_, y_, yp_);
      trust_->restart(pattern_, t_, y_, yp_);
    }
    if (drift_guard_)
      drift_guard_ = std::make_unique<solve::DriftGuard>(system_);
    if (pose_guard_)
      pose_guard_ = std::make_unique<solve::PoseGuard>(system_, y_);
    if (branch_guard_)
      branch_guard_->restart();
    statistics_.solver_time += seconds_since(before);
  }

  /// The past of a scene that depends on it begins at the start, and limits the steps.
  void begin_history() {
    if (!system::has_past(system_))
      return;
    const std::string note = system::limit_steps(system_, options_);
    if (!note.empty())
      system_.notes.push_back(note);
    history_ = std::make_unique<system::History>(system_);
    history_->append(0.0, y_, yp_);
    system_.history = history_.get();
  }

  /// Takes the accepted step into the history.
  void remember() {
    if (!history_)
      return;
    at_(t_, y_, yp_);
    history_->append(t_, y_, yp_);
  }

  /// Was the last step at or next to a singular pose? One step of `ida` in four is looked at, since
  /// the way through such a pose takes more; long steps are looked at inside, too.
  bool at_singular_pose() {
    const bool short_steps = scene_.solver.method == "ida";
    if (!pose_guard_ || (short_steps && ++asked_ % 4 != 0))
      return false;
    const int looks = short_steps ? 1 : 6;
    for (int k = 1; k <= looks; ++k) {
      const double t = k == looks ? t_ : step_start_ + (t_ - step_start_) * k / looks;
      at_(t, y_, yp_);
      if (pose_guard_->near_singular(t, y_, yp_))
        return true;
    }
    return false;
  }

  /// What to do about a step that cannot be made next to a singular pose, behind the first line.
  std::string with_remedy(std::string text) {
    at_(t_, y_, yp_);
    if (!pose_guard_ || !pose_guard_->near_singular(t_, y_, yp_))
      return text;
    const std::string& method = scene_.solver.method;
    const std::string remedy =
        method == "radau" || method == "explicit_rk"
            ? "; it is next to a singular pose (a dead point, or bars in line), where the motion "
              "may "
              "have no unique way on: a smaller rtol, or a little friction, may help"
            : "; it is next to a singular pose (a dead point, or bars in line): solver.method = "
              "\"radau\" or \"explicit_rk\" passes such poses";
    return text.insert(std::min(text.find('\n'), text.size()), remedy);
  }

  /// The rule by which the work over the coming step is summed.
  void choose_quadrature() {
    const int nodes = integrator_->quadrature_nodes();
    if (nodes == quadrature_nodes_)
      return;
    quadrature_nodes_ = nodes;
    const solve::RungeKutta rule = solve::make_runge_kutta(solve::Family::lobatto_iiic, nodes);
    recorder_->set_quadrature({{rule.c.begin(), rule.c.end()}, {rule.b.begin(), rule.b.end()}});
  }

  void check_energy() {
    energy_guard_->check(
        t_, *recorder_, [this] { return at_singular_pose(); },
        [this] {
          VectorX reactions = VectorX::Zero(system_.n);
          at_(t_, y_, yp_);
          for (Index i = system_.lambda0; i < system_.mu0; ++i)
            reactions[i] = y_[i] / system_.scale[i];
          return system_.n_lambda == 0 ? std::string()
                                       : "\n  largest reactions, relative to the weights: " +
                                             solve::worst(reactions, system_.names);
        });
  }

  /// The tolerances follow the motion; the error that has piled up is judged against it.
  void check_trust(bool event) {
    at_(t_, y_, yp_);
    motion_scale_->accept(t_, y_);
    trust_->accept(t_, *integrator_, motion_scale_->reached(), y_, event, *recorder_);
  }

  /// The other witnesses: fixed steps too long, constraints that drift, velocities that jump.
  void check_motion() {
    if (step_guard_) {
      const solve::Statistics s = integrator_->statistics();
      step_guard_->check(t_, s.last_step, s.last_order, integrator_->local_error());
    }
    if (!drift_guard_ && !branch_guard_)
      return;
    at_(t_, y_, yp_);
    if (branch_guard_)
      branch_guard_->check(t_, y_);
    if (!drift_guard_)
      return;
    drift_guard_->check(t_, y_, yp_);
    if (drift_guard_->misses_singular_poses() && at_singular_pose())
      drift_guard_->fail_at_singular_pose(t_);
  }

  /// Steps until the end; false when the progress callback asked to stop.
  bool march() {
    const double end = scene_.solver.end_time, dt = scene_.output.step;
    const auto samples = static_cast<long>(std::floor(end / dt * (1.0 + 1e-12)));
    if (!sample(0.0))
      return false;
    long next = 1, steps_since_asked = 0;
    while (t_ < end) {
      const bool event = advance();
      choose_quadrature();
      recorder_->begin(t_, at_);
      for (; next <= samples && static_cast<double>(next) * dt <= t_ * (1.0 + 1e-14); ++next)
        if (!sample(std::min(static_cast<double>(next) * dt, t_)))
          return false;
      recorder_->accept();
      check_energy();
      check_motion();
      check_trust(event);
      remember();
      if (file_)
        file_->flush_if_due();
      if (event)
        restart();
      // Between samples that are far apart in steps, a request to stop is heard as well.
      if (++steps_since_asked >= 1000 && progress_) {
        steps_since_asked = 0;
        if (!progress_(t_, end))
          return false;
      }
    }
    energy_guard_->finish(t_, *recorder_);
    return true;
  }

  bool sample(double t) {
    recorder_->sample(t, at_, row_);
    system::watch(linear_limits_, t, recorder_->bodies());
    const solve::Statistics s = integrator_->statistics();
    std::size_t column = recorder_->width();
    row_[column++] = s.last_step;
    row_[column++] = s.last_order;
    impacts_.fill(switching_.get(), row_.data() + column);
    if (own_)
      own_->keep(t, recorder_->bodies());
    if (other_)
      other_->compare(recorder_->bodies());
    if (file_)
      file_->append(t, row_);
    statistics_.end_time = t;
    return !progress_ || progress_(t, scene_.solver.end_time);
  }

  void close(const std::string& message) {
    statistics_.wall_time = seconds_since(started_);
    const solve::Trust::Estimate estimate = trust_->estimate(motion_scale_->reached());
    statistics_.estimated_error = estimate.error;
    statistics_.estimated_error_of = estimate.body;
    statistics_.estimated_error_time = estimate.time;
    for (const std::string& note : motion_scale_->notes())
      statistics_.notes.push_back(note);
    const std::vector<std::string> limits = system::notes(linear_limits_);
    statistics_.notes.insert(statistics_.notes.end(), limits.begin(), limits.end());
    for (const system::Recorder::Absorbed& pto : recorder_->absorbed())
      statistics_.mean_power.emplace_back(pto.name, pto.mean_power);
    if (!file_)
      return;
    io::Attributes all = attributes(statistics_, scene_, recorder_->relative_balance_error());
    all["beyond_linear_theory"] = lines_of(limits);
    impacts_.write(switching_.get(), *file_);
    file_->close(statistics_.status, message, all);
  }

  const model::Scene& scene_;
  const Progress& progress_;
  solve::Verification* other_;               ///< run to compare with
  std::unique_ptr<solve::Verification> own_; ///< where this run is to be verified
  Clock::time_point started_;
  model::SolverOptions options_; ///< of the scene, steps limited to what a history carries
  bool approaches_events_;       ///< with steps that end there
  system::System system_;
  system::Pattern pattern_;
  VectorX y_, yp_;
  ImpactOutput impacts_{system_};
  std::unique_ptr<solve::Switching> switching_; ///< where stops or dry friction are
  solve::Statistics before_events_;             ///< of the integrators before the last event
  std::unique_ptr<system::History> history_;    ///< where loads depend on the past
  std::unique_ptr<solve::Integrator> integrator_;
  std::unique_ptr<solve::DriftGuard> drift_guard_;   ///< where the formulation lets gaps grow
  std::unique_ptr<solve::StepGuard> step_guard_;     ///< of fixed steps
  std::unique_ptr<solve::BranchGuard> branch_guard_; ///< where loops may be singular
  std::unique_ptr<solve::PoseGuard> pose_guard_;     ///< where energy or gaps matter there
  std::unique_ptr<solve::EnergyGuard> energy_guard_;
  std::unique_ptr<system::Forcing> forcing_;          ///< limits the steps
  std::unique_ptr<system::MotionScale> motion_scale_; ///< adapts the tolerances
  std::unique_ptr<solve::Trust> trust_;
  std::unique_ptr<system::Recorder> recorder_;
  system::LinearLimits linear_limits_;
  std::unique_ptr<io::ResultsFile> file_;
  std::vector<double> row_;
  RunStatistics statistics_;
  double t_ = 0.0, step_start_ = 0.0, last_start_ = 0.0;
  double event_near_ = INFINITY; ///< where the next steps end [s]
  VectorX y_start_, yp_start_;   ///< at the start of the step
  long asked_ = 0;               ///< times that a singular pose would have mattered
  int quadrature_nodes_ = 3;
  system::Recorder::Interpolant at_ = [this](double t, VectorX& y, VectorX& yp) {
    integrator_->interpolate(t, y, yp);
  };
};

} // namespace

RunStatistics simulate(const model::Scene& scene, const std::string& output_path,
                       const Progress& progress, bool verify) {
  if (!output_path.empty())
    io::check_output(output_path, {scene.path, scene.database ? scene.database->path : ""});
  return Run(scene, output_path, progress)(verify);
}

} // namespace hydrodae
