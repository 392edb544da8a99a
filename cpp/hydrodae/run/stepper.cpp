#include "hydrodae/run/stepper.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/integrate/runge_kutta.h"
#include "hydrodae/run/followers.h"

namespace hydrodae::run {

namespace {

/// Stopwatch that adds the wall time of its life to a sum [s].
class Watch {
public:
  explicit Watch(double& sum) : sum_(sum) {}
  ~Watch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

/// Problem with the start that its initial events have left; its past begins there.
Problem& begun(Problem& problem, const Instant& start) {
  problem.begin(start);
  return problem;
}

} // namespace

Stepper::Stepper(model::Scene given, double looser)
    : problem_(std::move(given)), now_(problem_.start), bound_(problem_, looser),
      scale_(problem_.regime, problem_.pattern, now_.y, now_.yp, bound_.motion(),
             problem_.scene.sea.ramp, problem_.options.rtol),
      events_(problem_, now_), method_(begun(problem_, now_), now_),
      measure_(problem_.regime, 0.0, now_.y, now_.yp),
      guards_(problem_.regime, problem_.pattern, problem_.options, now_.y) {
  measure_.average_from(problem_.system.has_waves() ? problem_.scene.sea.ramp : 0.0);
  parts_.push_back(std::make_unique<MeasureFollower>(measure_, problem_.regime));
  parts_.push_back(std::make_unique<ScaleFollower>(scale_));
  if (problem_.history)
    parts_.push_back(std::make_unique<HistoryFollower>(*problem_.history));
  for (const std::unique_ptr<Follower>& part : parts_)
    followers_.push_back(part.get());
  followers_.insert(followers_.end(), {&method_, &events_, &guards_});
}

void Stepper::accept(const Step& made) {
  for (Follower* follower : followers_)
    follower->accept(made);
  course_.event_here = made.event;
  if (made.event || (problem_.history && problem_.history->jumps()))
    restart();
}

/// Makes one step that all followers accept, and adds it to the sums. Under "auto" the next method
/// repeats a rejected step.
Step Stepper::take(double end, double next_control) {
  next_control_ = next_control;
  for (;;) {
    const Step made = make_step(end);
    measure_step();
    integrator().interpolate(now_.t, now_.y, now_.yp);
    try {
      for (Follower* follower : followers_)
        follower->judge(made);
      return made;
    } catch (const SolverError& error) {
      if (!method_.choice().more())
        throw;
      measure_.take_back();
      now_ = before_;
      change_method(method_.choice().after(error, MethodChange::Cause::guard));
    }
  }
}

/// Makes one step, which ends early where a stop or dry friction changes.
Step Stepper::make_step(double end) {
  const Watch watch(solver_time_);
  const SolverOptions& options = problem_.options;
  if (const auto change = method_.cheaper(now_))
    change_method(*change);
  for (;;) {
    course_.last_start = course_.step_start;
    course_.step_start = before_.t = now_.t;
    if ((events_.any() && method_.approaches_events()) || method_.choice().more())
      integrator().interpolate(now_.t, before_.y, before_.yp);
    const double bound = bound_of_step(), kink = next_kink();
    try {
      // Fixed steps keep their length, but end at a located event and at jumps of the past.
      const double known = problem_.scene.solver.step > 0.0 ? course_.event_near : INFINITY;
      now_.t = integrator().step(std::min({end, kink, known}), std::min(bound, kink));
    } catch (const SolverError& error) {
      integrator().interpolate(now_.t, now_.y, now_.yp);
      if (begins_to_move())
        continue;
      const SolverError stopped(error.time,
                                guards_.poses().with_remedy(error.halt, now_.t, now_.y, now_.yp));
      if (!method_.choice().chosen())
        throw stopped;
      change_method(method_.choice().after(stopped, MethodChange::Cause::stop));
      continue;
    }
    const std::optional<double> event = events_.locate(course_.step_start, now_, integrator());
    if (event && method_.approaches_events() &&
        StepBound::is_inside(course_.step_start, *event, now_.t)) {
      approach(*event);
      continue;
    }
    cut_ = event && *event < now_.t;
    now_.t = event.value_or(now_.t);
    const double longest = options.max_step > 0.0 ? 0.9 * options.max_step : INFINITY;
    return step(event.has_value(), !event && now_.t < end && now_.t < std::min(bound, kink) &&
                                       now_.t - course_.step_start < longest);
  }
}

Step Stepper::step(bool event, bool own) {
  return {{course_.step_start, now_.t, event, now_.y, now_.yp, measure_.turns()},
          integrator(),
          measure_,
          method_.choice().more(),
          own};
}

double Stepper::bound_of_step() {
  return bound_.find({now_.t, measure_.turns(), integrator(), next_control_}, course_);
}

/// Next jump of the past [s], for a method of the order of the last step.
double Stepper::next_kink() {
  return problem_.history ? problem_.history->next_kink(integrator().statistics().last_order)
                          : INFINITY;
}

/// Undoes the last step, so that the next ones end at the event.
void Stepper::approach(double event) {
  course_.event_near = event;
  now_ = before_;
  events_.follow(measure_.turns());
  method_.restart_at(now_);
}

/// Returns whether a load that sets in here needs tolerances for a larger motion. If so, the method
/// continues from the last accepted instant with them.
bool Stepper::begins_to_move() {
  double time = std::abs(now_.t);
  for (const system::BodyData& b : problem_.system.bodies)
    time = std::max(time, b.time_scale);
  const double later = now_.t + 1e-9 * time; // beyond the shortest step that a method tries
  VectorX y = now_.y, yp = now_.yp;
  if (!events_.restore(later, y, yp) || !scale_.begin_again(problem_.pattern, later, y, yp))
    return false;
  method_.renew(now_); // with a new first step: that of the failed one is almost zero
  return true;
}

/// Continues with the next method from the last accepted instant; the state of the guards is kept.
void Stepper::change_method(const MethodChange& change) {
  course_.event_near = INFINITY;
  events_.follow(measure_.turns());
  method_.change(change, now_);
}

/// Sums the work over the step, with the stages of the method if it can and there are no samples.
void Stepper::measure_step() {
  const auto at = [this](double t, VectorX& y, VectorX& yp) { integrator().look_inside(t, y, yp); };
  const std::span<const double> weights = integrator().stage_weights();
  if (has_samples() || cut_ || weights.empty()) {
    choose_quadrature();
    return measure_.begin(now_.t, at, !weights.empty());
  }
  const auto stage = [this](std::size_t i, VectorX& y, VectorX& yp) {
    return integrator().stage(i, y, yp);
  };
  measure_.begin(now_.t, weights, stage, at);
}

/// Returns whether the step, including its start, contains an output sample. The case alone
/// decides, so that the sums of a run do not depend on the caller.
bool Stepper::has_samples() const {
  constexpr double rounding = 1e-12; // rounding of the times of samples and steps
  const double dt = problem_.scene.output.step;
  return std::ceil(course_.step_start / dt * (1.0 - rounding)) * dt <= now_.t * (1.0 + rounding);
}

/// Chooses the quadrature of the work over the coming step.
void Stepper::choose_quadrature() {
  const int nodes = integrator().quadrature_nodes();
  if (nodes == course_.quadrature_nodes)
    return;
  course_.quadrature_nodes = nodes;
  const integrate::RungeKutta rule =
      integrate::make_runge_kutta(integrate::Family::lobatto_iiic, nodes);
  measure_.set_quadrature({{rule.c.begin(), rule.c.end()}, {rule.b.begin(), rule.b.end()}});
}

/// Continues after an event or a change of inputs, with the rows and loads that now hold.
void Stepper::restart() {
  const Watch watch(solver_time_);
  events_.follow(measure_.turns());
  const std::optional<double> work = events_.settle(now_);
  for (Follower* follower : followers_)
    follower->restart({now_.t, now_.y, now_.yp, work});
  if (now_.t >= problem_.options.end_time)
    return;
  if (events_.switching()) // rows may be added or removed
    method_.renew(now_);
  else
    method_.restart_at(now_);
}

double Stepper::relative_balance_error() const {
  const double exchanged = measure_.whole().exchanged;
  return exchanged > 0.0 ? measure_.relative_balance_error() * exchanged / energy_scale() : 0.0;
}

double Stepper::energy_scale() const {
  return std::max(measure_.whole().exchanged,
                  energy_of_errors(problem_.regime, problem_.options.rtol));
}

void Stepper::finish() {
  const Step last = step(false, false);
  for (Follower* follower : followers_)
    follower->finish(last);
}

State Stepper::state() {
  State out;
  out.time = now_.t;
  out.y = now_.y;
  out.yp = now_.yp;
  out.scene = problem_.fingerprint();
  out.held = problem_.regime.state();
  out.course = course_;
  for (const Follower* follower : followers_)
    follower->save(out);
  return out;
}

void Stepper::require_same(const State& state) {
  problem_.require_same(state.scene);
  if (state.switching.has_value() != (events_.switching() != nullptr) ||
      state.history.has_value() != (problem_.history != nullptr))
    throw Error("the state has other parts than the scene");
}

void Stepper::set(const State& state) {
  before_ = {};
  cut_ = false;
  now_ = {state.time, state.y, state.yp};
  course_ = state.course;
  problem_.regime.set(state.held);
  if (events_.switching())
    system::lay_out(problem_.regime);
  if (now_.y.size() != problem_.regime.n || now_.yp.size() != problem_.regime.n)
    throw Error("the state has other unknowns than the scene");
  problem_.pattern = system::find_pattern(problem_.regime);
  for (Follower* follower : followers_)
    follower->set(state);
  events_.follow(measure_.turns());
}

void Stepper::interpolate(double t, VectorX& y, VectorX& yp) {
  integrator().interpolate(t, y, yp);
  integrate::SampleClosing* closing = method_.closing();
  if (!closing)
    return;
  if (!scale_.at_rest())
    closing->close(t, y);
  if (scale_.at_rest() || method_traits(problem_.options.method).loose_reactions)
    closing->hold(t, y, yp);
}

void Stepper::look(double t, VectorX& y) {
  y = now_.y;
  if (t >= now_.t)
    return;
  VectorX yp(y.size());
  integrator().look_inside(t, y, yp);
}

} // namespace hydrodae::run
