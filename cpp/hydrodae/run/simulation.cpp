#include "hydrodae/run/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
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

Simulation::Simulation(model::Scene given, double looser)
    : problem_(std::move(given)), inputs_(find_inputs(problem_.regime)), now_(problem_.start),
      bound_(problem_, looser), scale_(problem_.regime, problem_.pattern, now_.y, now_.yp,
                                       bound_.motion(), scene().sea.ramp, problem_.options.rtol),
      events_(problem_, now_), method_(begun(problem_, now_), now_),
      measure_(problem_.regime, 0.0, now_.y, now_.yp),
      guards_(problem_.regime, problem_.pattern, problem_.options, now_.y),
      channels_(problem_.regime, measure_, held_channels(scene(), inputs_)),
      controllers_(scene(), problem_.regime, channels_.all(), inputs_) {
  measure_.average_from(system().has_waves() ? scene().sea.ramp : 0.0);
  events_.add(controllers_.sources());
  parts_.push_back(std::make_unique<ControlFollower>(controllers_));
  parts_.push_back(std::make_unique<MeasureFollower>(measure_, problem_.regime));
  parts_.push_back(std::make_unique<ScaleFollower>(scale_));
  if (problem_.history)
    parts_.push_back(std::make_unique<HistoryFollower>(*problem_.history));
  for (const std::unique_ptr<Follower>& part : parts_)
    followers_.push_back(part.get());
  followers_.insert(followers_.end(), {&method_, &events_, &guards_});
}

void Simulation::advance(double limit, const Inside& inside) {
  if (finished() || !(limit > now_.t))
    return;
  require_going();
  ask_controllers();
  standing_.row.clear();
  standing_.failed = true; // until all followers have accepted the step
  const Step made = take_step(controllers_.limit(std::min(limit, problem_.options.end_time)));
  if (inside)
    inside();
  for (Follower* follower : followers_)
    follower->accept(made);
  course_.event_here = made.event;
  if (made.event || (problem_.history && problem_.history->jumps()))
    restart();
  standing_.failed = false;
}

void Simulation::require_going() const {
  if (standing_.failed)
    throw SolverError(
        now_.t,
        {Reason::state, "the run has stopped; it goes on from a state that is restored only"});
}

/// Samples the due controllers and applies their outputs; twice, because a new output may make one
/// due.
void Simulation::ask_controllers() {
  for (int k = 0; k < 2; ++k) {
    take_control();
    take_inputs();
  }
}

void Simulation::take_control() {
  if (!controllers_.is_due(now_.t, course_.event_here))
    return;
  take_inputs();
  standing_.failed = true; // until all controllers have answered
  course_.control_since = now_.t;
  if (controllers_.act(now_.t, course_.event_here, row_now()))
    standing_.written = true;
  constexpr double far = 100.0; // levers or rad, beyond the range of any device
  if (const VectorX& reached = scale_.reached(); reached.size() > 0 && reached.maxCoeff() > far)
    if (const std::string why = controllers_.runaway(); !why.empty())
      throw SolverError(now_.t, {Reason::growth, why});
  course_.event_here = false;
  standing_.failed = false;
}

/// Updates the accelerations after inputs were written, before the motion continues or is read.
void Simulation::take_inputs() {
  if (!standing_.written)
    return;
  require_going();
  standing_.written = false;
  standing_.row.clear();
  standing_.failed = true; // until accelerations are found
  restart();
  standing_.failed = false;
}

/// Makes one step that all followers accept, and adds it to the sums. Under "auto" the next method
/// repeats a rejected step.
Step Simulation::take_step(double end) {
  for (;;) {
    const Step made = make_step(end);
    measure_step();
    integrator().interpolate(now_.t, now_.y, now_.yp);
    try {
      for (Follower* follower : followers_)
        follower->judge(made);
      return made;
    } catch (const SolverError& error) {
      if (!methods().more())
        throw;
      measure_.take_back();
      now_ = standing_.before;
      change_method(methods().after(error, MethodChange::Cause::guard));
    }
  }
}

/// Makes one step, which ends early where a stop or dry friction changes.
Step Simulation::make_step(double end) {
  const Watch watch(standing_.solver_time);
  const SolverOptions& options = problem_.options;
  if (const auto change = method_.cheaper(now_))
    change_method(*change);
  for (;;) {
    course_.last_start = course_.step_start;
    course_.step_start = standing_.before.t = now_.t;
    if ((events_.any() && method_.approaches_events()) || methods().more())
      integrator().interpolate(now_.t, standing_.before.y, standing_.before.yp);
    const double bound = bound_of_step(), kink = next_kink();
    try {
      // Fixed steps keep their length, but end at a located event and at jumps of the past.
      const double known = scene().solver.step > 0.0 ? course_.event_near : INFINITY;
      now_.t = integrator().step(std::min({end, kink, known}), std::min(bound, kink));
    } catch (const SolverError& error) {
      integrator().interpolate(now_.t, now_.y, now_.yp);
      if (begins_to_move())
        continue;
      const SolverError stopped(error.time,
                                guards_.poses().with_remedy(error.halt, now_.t, now_.y, now_.yp));
      if (!methods().chosen())
        throw stopped;
      change_method(methods().after(stopped, MethodChange::Cause::stop));
      continue;
    }
    const std::optional<double> event = events_.locate(course_.step_start, now_, integrator());
    if (event && method_.approaches_events() &&
        StepBound::is_inside(course_.step_start, *event, now_.t)) {
      approach(*event);
      continue;
    }
    standing_.cut = event && *event < now_.t;
    now_.t = event.value_or(now_.t);
    const double longest = options.max_step > 0.0 ? 0.9 * options.max_step : INFINITY;
    return step(event.has_value(), !event && now_.t < end && now_.t < std::min(bound, kink) &&
                                       now_.t - course_.step_start < longest);
  }
}

Step Simulation::step(bool event, bool own) {
  return {{course_.step_start, now_.t, event, now_.y, now_.yp, measure_.turns()},
          integrator(),
          measure_,
          methods().more(),
          own};
}

double Simulation::bound_of_step() {
  return bound_.find({now_.t, measure_.turns(), integrator(), controllers_.next_time()}, course_);
}

/// Next jump of the past [s], for a method of the order of the last step.
double Simulation::next_kink() {
  return problem_.history ? problem_.history->next_kink(integrator().statistics().last_order)
                          : INFINITY;
}

/// Undoes the last step, so that the next ones end at the event.
void Simulation::approach(double event) {
  course_.event_near = event;
  now_ = standing_.before;
  events_.follow(measure_.turns());
  method_.restart_at(now_);
}

/// Returns whether a load that sets in here needs tolerances for a larger motion. If so, the method
/// continues from the last accepted instant with them.
bool Simulation::begins_to_move() {
  double time = std::abs(now_.t);
  for (const system::BodyData& b : system().bodies)
    time = std::max(time, b.time_scale);
  const double later = now_.t + 1e-9 * time; // beyond the shortest step that a method tries
  VectorX y = now_.y, yp = now_.yp;
  if (!events_.restore(later, y, yp) || !scale_.begin_again(problem_.pattern, later, y, yp))
    return false;
  method_.renew(now_); // with a new first step: that of the failed one is almost zero
  return true;
}

/// Continues with the next method from the last accepted instant; the state of the guards is kept.
void Simulation::change_method(const MethodChange& change) {
  course_.event_near = INFINITY;
  events_.follow(measure_.turns());
  method_.change(change, now_);
}

/// Sums the work over the step, with the stages of the method if it can and there are no samples.
void Simulation::measure_step() {
  const auto at = [this](double t, VectorX& y, VectorX& yp) { integrator().look_inside(t, y, yp); };
  const std::span<const double> weights = integrator().stage_weights();
  if (has_samples() || standing_.cut || weights.empty()) {
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
bool Simulation::has_samples() const {
  constexpr double rounding = 1e-12; // rounding of the times of samples and steps
  const double dt = scene().output.step;
  return std::ceil(course_.step_start / dt * (1.0 - rounding)) * dt <= now_.t * (1.0 + rounding);
}

/// Chooses the quadrature of the work over the coming step.
void Simulation::choose_quadrature() {
  const int nodes = integrator().quadrature_nodes();
  if (nodes == course_.quadrature_nodes)
    return;
  course_.quadrature_nodes = nodes;
  const integrate::RungeKutta rule =
      integrate::make_runge_kutta(integrate::Family::lobatto_iiic, nodes);
  measure_.set_quadrature({{rule.c.begin(), rule.c.end()}, {rule.b.begin(), rule.b.end()}});
}

/// Continues after an event or a change of inputs, with the rows and loads that now hold.
void Simulation::restart() {
  const Watch watch(standing_.solver_time);
  events_.follow(measure_.turns());
  const std::optional<double> work = events_.settle(now_);
  for (Follower* follower : followers_)
    follower->restart({now_.t, now_.y, now_.yp, work});
  if (finished())
    return;
  if (events_.switching()) // rows may be added or removed
    method_.renew(now_);
  else
    method_.restart_at(now_);
}

void Simulation::finish() {
  const Step last = step(false, false);
  for (Follower* follower : followers_)
    follower->finish(last);
}

double Simulation::relative_balance_error() const {
  const double exchanged = measure_.whole().exchanged;
  return exchanged > 0.0 ? measure_.relative_balance_error() * exchanged / energy_scale() : 0.0;
}

double Simulation::energy_scale() const {
  return std::max(measure_.whole().exchanged, energy_of_errors(regime(), problem_.options.rtol));
}

State Simulation::state() {
  require_going();
  take_inputs();
  State out;
  out.time = now_.t;
  out.y = now_.y;
  out.yp = now_.yp;
  out.scene = problem_.fingerprint();
  out.held = regime().state();
  out.course = course_;
  for (const Follower* follower : followers_)
    follower->save(out);
  set(out);
  return out;
}

void Simulation::restore(const State& state) {
  set(state);
  controllers_.restored(now_.t);
}

void Simulation::set(const State& state) {
  problem_.require_same(state.scene);
  if (state.switching.has_value() != (switching() != nullptr) ||
      state.history.has_value() != (problem_.history != nullptr))
    throw Error("the state has other parts than the scene");
  // failed until all parts are restored
  standing_ = {{}, false, false, true, {}, standing_.solver_time};
  now_ = {state.time, state.y, state.yp};
  course_ = state.course;
  problem_.regime.set(state.held);
  if (switching())
    system::lay_out(problem_.regime);
  if (now_.y.size() != regime().n || now_.yp.size() != regime().n)
    throw Error("the state has other unknowns than the scene");
  problem_.pattern = system::find_pattern(regime());
  for (Follower* follower : followers_)
    follower->set(state);
  events_.follow(measure_.turns());
  standing_.failed = false;
}

void Simulation::sample(double t, std::span<double> row) {
  integrate::SampleClosing* closing = method_.closing();
  const bool loose = method_traits(problem_.options.method).loose_reactions;
  const auto closed = [&](double at, VectorX& y, VectorX& yp) {
    integrator().interpolate(at, y, yp);
    if (!closing)
      return;
    if (!at_rest())
      closing->close(at, y);
    if (at_rest() || loose)
      closing->hold(at, y, yp);
  };
  channels_.recorder().sample(t, closed, row.first(recorder().width()));
  channels_.fill(counts(), row);
}

void Simulation::look(double t, VectorX& y) {
  y = now_.y;
  if (t >= now_.t)
    return;
  VectorX yp(y.size());
  integrator().look_inside(t, y, yp);
}

Channels::Counts Simulation::counts() const {
  return {method_.integrator().statistics(), switching(), controllers_.held()};
}

/// Values of all channels now.
std::span<const double> Simulation::row_now() {
  std::vector<double>& row = standing_.row;
  if (row.empty()) {
    row.resize(width());
    channels_.recorder().look(now_.y, now_.yp, std::span(row).first(recorder().width()));
    channels_.fill(counts(), row);
  }
  return row;
}

std::span<const double> Simulation::read(const std::string& channel) {
  take_inputs();
  return channels_.find(channel, row_now());
}

void Simulation::write(const std::string& input, double value) {
  Input& target = input_named(inputs_, input);
  for (const model::Controller& c : scene().controllers)
    for (const std::string& output : c->outputs)
      if (signal_of(output).name == target.name)
        throw CaseError("input " + in_quotes(input) + " is what controller " + in_quotes(c->name) +
                        " of the case writes; expected one that no controller holds");
  check_value(target, value);
  if (target.set(now_.t, value))
    standing_.written = true;
}

} // namespace hydrodae::run
