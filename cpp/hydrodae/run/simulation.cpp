#include "hydrodae/run/simulation.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::run {

Simulation::Simulation(model::Scene given, double looser)
    : steps_(std::move(given), looser), inputs_(find_inputs(steps_.problem().regime)),
      channels_(steps_.problem().regime, steps_.measured(), held_channels(scene(), inputs_)),
      controllers_(scene(), steps_.problem().regime, channels_.all(), inputs_),
      control_(controllers_) {
  steps_.events().add(controllers_.sources());
  steps_.lead(control_);
}

void Simulation::advance(double limit, const Inside& inside) {
  if (finished() || !(limit > time()))
    return;
  require_going();
  ask_controllers();
  row_.clear();
  failed_ = true; // until all followers have accepted the step
  const double end = std::min(limit, steps_.problem().options.end_time);
  const Step made = steps_.take(controllers_.limit(end), controllers_.next_time());
  if (inside)
    inside();
  steps_.accept(made);
  failed_ = false;
}

void Simulation::require_going() const {
  if (failed_)
    throw SolverError(
        time(),
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
  if (!controllers_.is_due(time(), steps_.course().event_here))
    return;
  take_inputs();
  failed_ = true; // until all controllers have answered
  steps_.course().control_since = time();
  if (controllers_.act(time(), steps_.course().event_here, row_now()))
    written_ = true;
  constexpr double far = 100.0; // levers or rad, beyond the range of any device
  if (const VectorX& reached = steps_.scale().reached();
      reached.size() > 0 && reached.maxCoeff() > far)
    if (const std::string why = controllers_.runaway(); !why.empty())
      throw SolverError(time(), {Reason::growth, why});
  steps_.course().event_here = false;
  failed_ = false;
}

/// Updates the accelerations after inputs were written, before the motion continues or is read.
void Simulation::take_inputs() {
  if (!written_)
    return;
  require_going();
  written_ = false;
  row_.clear();
  failed_ = true; // until accelerations are found
  steps_.restart();
  failed_ = false;
}

State Simulation::state() {
  require_going();
  take_inputs();
  State out = steps_.state();
  set(out);
  return out;
}

void Simulation::restore(const State& state) {
  set(state);
  controllers_.restored(time());
}

void Simulation::set(const State& state) {
  steps_.require_same(state);
  failed_ = true; // until all parts are restored
  written_ = false;
  row_.clear();
  steps_.set(state);
  failed_ = false;
}

void Simulation::sample(double t, std::span<double> row) {
  const auto closed = [this](double at, VectorX& y, VectorX& yp) { steps_.interpolate(at, y, yp); };
  channels_.recorder().sample(t, closed, row.first(recorder().width()));
  channels_.fill(counts(), row);
}

Channels::Counts Simulation::counts() const {
  return {steps_.method().integrator().statistics(), switching(), controllers_.held()};
}

/// Values of all channels now.
std::span<const double> Simulation::row_now() {
  std::vector<double>& row = row_;
  if (row.empty()) {
    row.resize(width());
    channels_.recorder().look(steps_.now().y, steps_.now().yp,
                              std::span(row).first(recorder().width()));
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
  if (target.set(time(), value))
    written_ = true;
}

} // namespace hydrodae::run
