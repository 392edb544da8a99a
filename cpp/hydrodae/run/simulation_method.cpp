/// Which method makes the steps of a Simulation, how another takes over, and what cuts steps short.

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/integrate/runge_kutta.h"
#include "hydrodae/integrate/stiffness.h"
#include "hydrodae/run/simulation.h"

namespace hydrodae::run {

namespace {

/// Part of a step at its ends where the polynomial through the stages of radau is nearly exact.
constexpr double step_edge = 0.02;

} // namespace

/// By the start, where the method is "auto".
void Simulation::choose_method() {
  if (!find_method(options_.method))
    methods_ = MethodChoice(order_methods(find_traits(regime_, pattern_, options_, y_, yp_)));
  use_method();
}

/// Whatever depends on the method is that of the one at work.
void Simulation::use_method() {
  options_.method = methods_.method();
  approaches_events_ = method_traits(options_.method).coarse_inside || options_.step > 0.0;
}

/// At the last accepted instant; of the next method where this one cannot start there.
void Simulation::make_integrator() {
  for (;;) {
    try {
      integrator_ = integrate::make_integrator(regime_, pattern_, options_, t_, y_, yp_);
      make_closing();
      return;
    } catch (const SolverError& error) {
      if (!methods_.chosen())
        throw;
      methods_.next(methods_.after(error, MethodChange::Cause::stop));
      use_method();
    }
  }
}

void Simulation::renew_integrator() {
  before_start_ += integrator_->statistics();
  make_integrator();
}

/// The method goes on from y_, y'_, which have the layout of the last step.
void Simulation::restart_integrator() {
  if (!integrator_->restart(t_, y_, yp_))
    renew_integrator();
}

/// Samples of formulations that drift show their drift.
void Simulation::make_closing() {
  closing_.reset();
  if (regime_.n_lambda > 0 && regime_.formulation == system::Formulation::stabilised)
    closing_ = std::make_unique<integrate::SampleClosing>(
        regime_, pattern_, !method_traits(options_.method).projects_rates);
}

/// The next method goes on from the last accepted instant. What the guards have seen stays.
void Simulation::change_method(const MethodChange& change) {
  methods_.next(change);
  event_near_ = INFINITY;
  follow_turns();
  use_method();
  renew_integrator();
}

/// Goes back to the start of the last step.
void Simulation::take_back() {
  measure_->take_back();
  t_ = step_start_;
  y_ = y_start_;
  yp_ = yp_start_;
}

/// The first event inside the last step, if any.
std::optional<double> Simulation::locate() {
  if (sources_.empty())
    return std::nullopt;
  const int degree = integrator_->degree() + 1; // of the positions
  // Stops are met to within rounding, on the constraints; the margins of others follow from
  // positions and velocities, which the polynomial of the step gives without solving for loads.
  const auto event = events::locate(sources_, step_start_, t_, degree, switching_ ? at_ : motion_);
  if (!event && switching_) {
    at_(t_, y_, yp_);
    switching_->accept(t_, y_, yp_);
  }
  return event;
}

/// No step may pass over what is known ahead of time, nor over an event that was found.
double Simulation::find_bound() {
  const double stretch = stretch_of_steps();
  const system::Forcing::Limit limit =
      forcing_->limit(measure_->turns(), integrator_->gap(), stretch);
  if (event_near_ - t_ <= step_edge * (t_ - last_start_)) // no sliver of a step
    event_near_ = INFINITY;
  const double step = scene_.solver.step;
  constexpr double too_long = 4.0;
  if (step > too_long * (limit.time - t_))
    throw SolverError(t_, {Reason::step,
                           "the step of " + number_text(step) + " s is too long for " + *limit.by +
                               ", which may be passed over",
                           "",
                           {{"step", step}},
                           rounded_text(limit.time - t_) + " s may do",
                           ""});
  double other = INFINITY; // bounds that no longer step may pass
  if (history_)
    other = t_ + history_->longest_step();
  if (stretch < 1.0) {
    if (options_.max_step > 0.0)
      other = std::min(other, t_ + options_.max_step);
    other = t_ + stretch * (other - t_);
    if (controllers_) { // the step through the whole interval between two instants is split
      const double next = controllers_->next_time(), part = stretch * (next - control_since_);
      if (std::isfinite(part) && next - t_ > part)
        other = std::min(other, t_ + part);
    }
  }
  return std::min({limit.time, event_near_, other});
}

/// Length of the steps over that of the run which this one is to judge, where something but the
/// tolerance bounds them: as the error control would choose it, by the highest order so far (that
/// of ida begins low).
double Simulation::stretch_of_steps() {
  highest_order_ = std::max(highest_order_, integrator_->statistics().last_order);
  return looser_ == 1.0 ? 1.0 : std::pow(looser_, 1.0 / (highest_order_ + 1.0));
}

/// Is a time in the middle of the last step, where the polynomial is of a lower order than the end,
/// so that each event would leave its error? It is that through the stages of radau, or what fixed
/// steps have. A load that begins with the event, as of a rope that is caught and parts, has
/// changed the stages, too.
bool Simulation::inside_of_step(double t) const {
  const double least = step_edge * (t_ - step_start_);
  return approaches_events_ && t - step_start_ > least && t_ - t > least;
}

/// Takes the last step back, and lets the next ones end at the event.
void Simulation::approach(double event) {
  t_ = step_start_;
  event_near_ = event;
  follow_turns();
  y_ = y_start_;
  yp_ = yp_start_;
  restart_integrator();
}

/// A step has failed. Does a load that sets in here ask for tolerances of a larger motion than
/// there was so far? Then the method goes on from the last accepted instant with these.
bool Simulation::begins_to_move() {
  double time = std::abs(t_);
  for (const system::BodyData& b : system_.bodies)
    time = std::max(time, b.time_scale);
  const double later = t_ + 1e-9 * time; // beyond the shortest step that a method tries
  VectorX y = y_, yp = yp_;
  try {
    consistency().restore(later, y, yp);
  } catch (const SolverError&) {
    return false;
  }
  if (!scale_->begin_again(pattern_, later, y, yp))
    return false;
  renew_integrator(); // with a first step of its own: that of the failed one has no length left
  return true;
}

/// Steps that end where something made them end do not count as evidence on the method.
void Simulation::watch_steps(bool event, double end) {
  if (!methods_.more())
    return;
  const double h = t_ - step_start_,
               longest = options_.max_step > 0.0 ? 0.9 * options_.max_step : INFINITY;
  const bool own = !event && t_ < end && t_ < bound_ && h < longest;
  methods_.accept(h, integrate::motion_rate(regime_, y_), own, operations());
}

/// Of all methods so far, as far as they are counted: those of an integrator that is made again,
/// after an event or a saved state, go on from those before.
double Simulation::operations() const {
  const linalg::Statistics s = statistics();
  const auto entries = static_cast<double>(pattern_.row.size());
  return s.factor_work + entries * (linalg::of_residual * static_cast<double>(s.residual_calls) +
                                    linalg::of_jacobian * static_cast<double>(s.jacobian_calls));
}

/// Of one step of explicit_rk: at each stage a residual, and a Jacobian of the mass matrix and the
/// constraint rows alone.
double Simulation::operations_of_explicit_step() const {
  constexpr double evaluations = 13.0; // 12 stages of order 8, and the end of the step
  const system::Regime& s = regime_;
  double entries = 0.0;
  for (Index c = s.u0; c < s.u0 + s.n_u; ++c)
    for (Index k = pattern_.column_start[static_cast<std::size_t>(c)];
         k < pattern_.column_start[static_cast<std::size_t>(c) + 1]; ++k) {
      const Index row = pattern_.row[static_cast<std::size_t>(k)];
      const bool mass =
          pattern_.has_rate[static_cast<std::size_t>(k)] && row >= s.u0 && row < s.u0 + s.n_u;
      entries += mass || (row >= s.lambda0 && row < s.lambda0 + s.n_lambda);
    }
  return evaluations * (linalg::of_residual * static_cast<double>(pattern_.row.size()) +
                        linalg::of_jacobian * entries);
}

/// Another method takes over where it makes the steps with less work.
void Simulation::weigh_methods() {
  if (const auto change = methods_.labours(t_))
    change_method(*change);
  if (const auto change = methods_.returns(t_))
    change_method(*change);
  if (!methods_.weighs())
    return;
  const auto fastest = [&] { return integrate::fastest_rate(regime_, pattern_, t_, y_, yp_); };
  if (const auto change = methods_.weigh(t_, operations_of_explicit_step(), fastest))
    change_method(*change);
}

/// The rule by which the work over the coming step is summed.
void Simulation::choose_quadrature() {
  const int nodes = integrator_->quadrature_nodes();
  if (nodes == quadrature_nodes_)
    return;
  quadrature_nodes_ = nodes;
  const integrate::RungeKutta rule =
      integrate::make_runge_kutta(integrate::Family::lobatto_iiic, nodes);
  measure_->set_quadrature({{rule.c.begin(), rule.c.end()}, {rule.b.begin(), rule.b.end()}});
}

} // namespace hydrodae::run
