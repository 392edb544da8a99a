#include "hydrodae/run/events.h"

#include "hydrodae/core/error.h"
#include "hydrodae/run/state.h"

namespace hydrodae::run {

RunEvents::RunEvents(Problem& problem, Instant& start) : problem_(problem) {
  if (!problem.system.switches.empty()) {
    switching_ = std::make_unique<events::Switching>(problem.regime, problem.options.rtol);
    switching_->settle(start.t, start.y, start.yp);
  }
  laws_.emplace(problem.regime, start.y);
}

void RunEvents::add(const std::vector<events::Source*>& sources) {
  sources_ = sources;
  for (events::Source* source : laws_->sources())
    sources_.push_back(source);
  if (switching_)
    sources_.push_back(switching_.get());
}

std::optional<double> RunEvents::locate(double start, Instant& end,
                                        integrate::Integrator& integrator) {
  if (sources_.empty())
    return std::nullopt;
  const int degree = integrator.degree() + 1; // degree of the positions
  // Stop contacts are located to rounding, on the constraints. Margins of other events follow from
  // positions and velocities, which the polynomial of the step gives without solving for loads.
  const auto at = [&](double t, VectorX& y, VectorX& yp) {
    switching_ ? integrator.interpolate(t, y, yp) : integrator.follow_motion(t, y, yp);
  };
  const auto event = events::locate(sources_, start, end.t, degree, at);
  if (!event && switching_) {
    integrator.interpolate(end.t, end.y, end.yp);
    switching_->accept(end.t, end.y, end.yp);
  }
  return event;
}

void RunEvents::accept(const Step& step) {
  if (step.event)
    laws_->part(step.end, step.y);
  else
    laws_->accept(step.end, step.y);
}

std::optional<double> RunEvents::settle(Instant& at) {
  laws_->settle(at.t, at.y);
  const std::optional<double> struck =
      switching_ ? switching_->settle(at.t, at.y, at.yp) : consistency().restore(at.t, at.y, at.yp);
  if (struck && laws_->settle(at.t, at.y) && !switching_)
    consistency().restore(at.t, at.y, at.yp);
  if (switching_) // rows may be added or removed
    problem_.pattern = system::find_pattern(problem_.regime);
  return struck;
}

bool RunEvents::restore(double t, VectorX& y, VectorX& yp) {
  try {
    consistency().restore(t, y, yp);
    return true;
  } catch (const SolverError&) {
    return false;
  }
}

statics::Consistency& RunEvents::consistency() {
  if (!consistency_)
    consistency_ = std::make_unique<statics::Consistency>(problem_.regime);
  return *consistency_;
}

void RunEvents::follow(const system::Turns& turns) {
  problem_.regime.nearby = turns.value;
  if (switching_)
    switching_->follow(turns);
}

void RunEvents::save(State& out) const {
  out.kinks = laws_->state();
  if (switching_)
    out.switching = switching_->state();
}

void RunEvents::set(const State& from) {
  laws_->set(from.kinks);
  if (switching_)
    switching_->set(from.switching.value(), from.time, from.y, from.yp);
  consistency_.reset(); // pivots of a new factorisation depend on the state alone
}

} // namespace hydrodae::run
