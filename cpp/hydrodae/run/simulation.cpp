#include "hydrodae/run/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::run {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The columns that belong to the solver rather than to the scene.
const std::vector<Channel> solver_channels = {
    {"solver/step", 1, "s", "-", "Length of the step that holds this sample."},
    {"solver/order", 1, "-", "-", "Order of that step."}};

} // namespace

Simulation::Start Simulation::begin(const model::Scene& scene) {
  Start start{statics::starting_system(scene), {}, {}, {}};
  const system::Regime regime(start.system);
  start.pattern = system::find_pattern(regime);
  start.y = system::initial_state(regime);
  statics::consistent_start(regime, start.pattern, start.y, start.yp);
  system::take_time_scales(start.system, start.y, start.yp);
  return start;
}

Simulation::Simulation(model::Scene scene, double looser)
    : Simulation(begin(scene), std::move(scene), looser) {}

Simulation::Simulation(Start start, model::Scene&& scene, double looser)
    : scene_(std::move(scene)), looser_(looser), options_(scene_.solver),
      system_(std::move(start.system)), pattern_(std::move(start.pattern)), y_(std::move(start.y)),
      yp_(std::move(start.yp)), notes_(system_.notes), inputs_(find_inputs(regime_)) {
  forcing_ = std::make_unique<system::Forcing>(regime_, options_.end_time, scene_.output.step);
  scale_ = std::make_unique<system::MotionScale>(regime_, pattern_, y_, yp_, forcing_->motion(),
                                                 scene_.sea.ramp, options_.rtol);
  if (!system_.switches.empty()) {
    switching_ = std::make_unique<events::Switching>(regime_, options_.rtol);
    switching_->settle(0.0, y_, yp_);
  }
  law_events_ = std::make_unique<events::LawEvents>(regime_, y_);
  formulate();
  begin_history();
  choose_method();
  make_integrator();
  measure_ = std::make_unique<measure::Measure>(regime_, 0.0, y_, yp_);
  recorder_ = std::make_unique<observe::Recorder>(regime_, *measure_);
  measure_->average_from(system_.has_waves() ? scene_.sea.ramp : 0.0);
  guards_ = std::make_unique<Guards>(regime_, pattern_, options_, y_);
  make_channels();
  find_sources();
}

void Simulation::find_sources() {
  if (controllers_)
    sources_ = controllers_->sources();
  for (events::Source* source : law_events_->sources())
    sources_.push_back(source);
  if (switching_)
    sources_.push_back(switching_.get());
}

/// The start is found on the stabilised equations; then the formulation may change.
void Simulation::formulate() {
  using system::Formulation;
  static const std::map<std::string, Formulation> formulations = {
      {"stabilised", Formulation::stabilised},
      {"index_2", Formulation::index_2},
      {"index_3", Formulation::index_3},
      {"index_1", Formulation::index_1}};
  regime_.formulation = formulations.at(options_.formulation);
  if (options_.baumgarte_time > 0.0)
    regime_.baumgarte_rate = 1.0 / options_.baumgarte_time;
  if (regime_.formulation != Formulation::stabilised || switching_)
    pattern_ = system::find_pattern(regime_);
}

/// The past of a scene that depends on it begins at the start, and limits the steps.
void Simulation::begin_history() {
  if (!system::has_past(system_))
    return;
  const std::string note = system::limit_steps(system_, options_);
  if (!note.empty())
    notes_.push_back(note);
  history_ = std::make_unique<system::History>(regime_, options_);
  history_->append(0.0, y_, yp_);
  regime_.history = history_.get();
}

void Simulation::make_channels() {
  channels_ = recorder_->channels();
  channels_.insert(channels_.end(), solver_channels.begin(), solver_channels.end());
  const std::vector<Channel> taken = impacts_.channels();
  channels_.insert(channels_.end(), taken.begin(), taken.end());
  width_ = recorder_->width() + solver_channels.size() + impacts_.width();
  if (scene_.controllers.empty())
    return;
  const std::vector<Channel> held = held_channels(scene_, inputs_);
  channels_.insert(channels_.end(), held.begin(), held.end());
  width_ += held.size();
  controllers_ = std::make_unique<Controllers>(scene_, regime_, channels_, inputs_);
}

linalg::Statistics Simulation::statistics() const {
  linalg::Statistics all = before_start_;
  const linalg::Statistics now = integrator_->statistics();
  all += now;
  all.last_step = now.last_step;
  all.last_order = now.last_order;
  return all;
}

void Simulation::advance(double limit, const Inside& inside) {
  if (finished() || !(limit > t_))
    return;
  require_going();
  take_control();
  take_inputs();
  if (controllers_ && controllers_->is_due(t_, event_here_)) { // what was written has made it so
    take_control();
    take_inputs();
  }
  now_.clear();
  failed_ = true; // until the step is accepted by all
  const double last = std::min(limit, options_.end_time);
  const double end = controllers_ ? controllers_->limit(last) : last;
  const bool event = take_step(end);
  if (controllers_)
    controllers_->accept(t_, y_, yp_);
  if (inside)
    inside();
  measure_->accept();
  regime_.nearby = measure_->turns().value;
  scale_->accept(t_, y_);
  if (history_)
    history_->append(t_, y_, yp_, motion_, integrator_->degree());
  watch_steps(event, end);
  event_here_ = event;
  if (event)
    law_events_->part(t_, y_);
  else
    law_events_->accept(t_, y_);
  if (event || (history_ && history_->jumps()))
    restart();
  failed_ = false;
}

void Simulation::require_going() const {
  if (failed_)
    throw SolverError(
        t_, {Reason::state, "the run has stopped; it goes on from a state that is restored only"});
}

/// One step that no guard proves wrong, and what it adds to the sums. Under "auto" the next
/// method makes a step that is.
/// @returns whether it ends in an event
bool Simulation::take_step(double end) {
  for (;;) {
    const Clock::time_point before = Clock::now();
    const bool event = make_step(end);
    solver_time_ += seconds_since(before);
    measure_step();
    at_(t_, y_, yp_);
    if (closing_)
      closing_->accept(t_, y_, yp_);
    try {
      guards_->accept(last_step(event));
      return event;
    } catch (const SolverError& error) {
      if (!methods_.more())
        throw;
      take_back();
      change_method(methods_.after(error, MethodChange::Cause::guard));
    }
  }
}

/// Does the step, its start among it, hold an output sample? By the case alone, so that the sums of
/// a run are the same whoever drives it.
bool Simulation::has_samples() const {
  constexpr double rounding = 1e-12; // of the times of samples and steps
  const double dt = scene_.output.step;
  return std::ceil(step_start_ / dt * (1.0 - rounding)) * dt <= t_ * (1.0 + rounding);
}

/// The work over the step: by the stages of the method, if it can and there are no samples.
void Simulation::measure_step() {
  const std::span<const double> weights = integrator_->stage_weights();
  if (!has_samples() && !cut_ && !weights.empty()) {
    measure_->begin(t_, weights, stage_, inside_);
    return;
  }
  choose_quadrature();
  measure_->begin(t_, inside_, !weights.empty());
}

Step Simulation::last_step(bool event) {
  return {step_start_, t_, event, y_, yp_, *integrator_, *measure_, methods_.more()};
}

/// One step, cut short where a stop or dry friction changes.
/// @returns whether it ends in such an event
bool Simulation::make_step(double end) {
  weigh_methods();
  for (;;) {
    last_start_ = step_start_;
    step_start_ = t_;
    if ((!sources_.empty() && approaches_events_) || methods_.more())
      at_(t_, y_start_, yp_start_);
    const double kink =
        history_ ? history_->next_kink(integrator_->statistics().last_order) : INFINITY;
    bound_ = std::min(find_bound(), kink);
    try {
      // Fixed steps keep their length whatever is known ahead, but end at an event that was found,
      // and where the past jumps.
      const double known = std::min(kink, scene_.solver.step > 0.0 ? event_near_ : INFINITY);
      t_ = integrator_->step(std::min(end, known), bound_);
    } catch (const SolverError& error) {
      at_(t_, y_, yp_);
      if (begins_to_move())
        continue;
      const SolverError stopped(error.time, guards_->poses().with_remedy(error.halt, t_, y_, yp_));
      if (!methods_.chosen())
        throw stopped;
      change_method(methods_.after(stopped, MethodChange::Cause::stop));
      continue;
    }
    const std::optional<double> event = locate();
    if (!event || !inside_of_step(*event)) {
      cut_ = event && *event < t_;
      t_ = event.value_or(t_);
      return event.has_value();
    }
    approach(*event);
  }
}

/// Goes on from an event, or with other inputs, by the rows and loads that hold from now on.
void Simulation::restart() {
  const Clock::time_point before = Clock::now();
  std::optional<double> struck;
  follow_turns();
  law_events_->settle(t_, y_);
  if (switching_)
    struck = switching_->settle(t_, y_, yp_);
  else
    struck = consistency().restore(t_, y_, yp_);
  if (struck && law_events_->settle(t_, y_) && !switching_)
    consistency().restore(t_, y_, yp_);
  measure_->restart(y_, yp_, struck);
  if (history_)
    history_->append(t_, y_, yp_);
  if (!finished()) {
    if (switching_) { // rows come and go
      pattern_ = system::find_pattern(regime_);
      renew_integrator();
    } else {
      restart_integrator();
    }
    guards_->restart(y_);
  }
  solver_time_ += seconds_since(before);
}

statics::Consistency& Simulation::consistency() {
  if (!consistency_)
    consistency_ = std::make_unique<statics::Consistency>(regime_);
  return *consistency_;
}

/// What is made from now on knows on which turn the angles are.
void Simulation::follow_turns() {
  const system::Turns& turns = measure_->turns();
  regime_.nearby = turns.value;
  if (switching_)
    switching_->follow(turns);
}

void Simulation::finish() { guards_->finish(last_step(false)); }

double Simulation::relative_balance_error() const {
  const double exchanged = measure_->whole().exchanged;
  return exchanged > 0.0 ? measure_->relative_balance_error() * exchanged / energy_scale() : 0.0;
}

double Simulation::energy_scale() const {
  return std::max(measure_->whole().exchanged, energy_of_errors(regime_, options_.rtol));
}

} // namespace hydrodae::run
