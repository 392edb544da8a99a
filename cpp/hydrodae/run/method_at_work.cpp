#include "hydrodae/run/method_at_work.h"

#include "hydrodae/core/error.h"
#include "hydrodae/integrate/stiffness.h"
#include "hydrodae/run/state.h"

namespace hydrodae::run {

MethodAtWork::MethodAtWork(Problem& problem, const Instant& start)
    : problem_(problem), choice_(problem.options.method) {
  if (!find_method(problem.options.method))
    choice_ = MethodChoice(order_methods(
        find_traits(problem.regime, problem.pattern, problem.options, start.y, start.yp)));
  make(start);
}

void MethodAtWork::use() { problem_.options.method = choice_.method(); }

bool MethodAtWork::approaches_events() const {
  return method_traits(problem_.options.method).coarse_inside || problem_.options.step > 0.0;
}

/// Makes the integrator, or that of the next method if this one cannot start. Samples of drifting
/// formulations are not closed, so that they show the drift.
void MethodAtWork::make(const Instant& at) {
  const system::Regime& regime = problem_.regime;
  for (;;) {
    use();
    try {
      integrator_ =
          integrate::make_integrator(regime, problem_.pattern, problem_.options, at.t, at.y, at.yp);
      break;
    } catch (const SolverError& error) {
      if (!choice_.chosen())
        throw;
      choice_.next(choice_.after(error, MethodChange::Cause::stop));
    }
  }
  closing_.reset();
  if (regime.n_lambda > 0 && regime.formulation == system::Formulation::stabilised)
    closing_ = std::make_unique<integrate::SampleClosing>(
        regime, problem_.pattern, !method_traits(problem_.options.method).projects_rates);
}

void MethodAtWork::renew(const Instant& at) {
  before_ += integrator_->statistics();
  make(at);
}

void MethodAtWork::restart_at(const Instant& at) {
  if (!integrator_->restart(at.t, at.y, at.yp))
    renew(at);
}

void MethodAtWork::change(const MethodChange& change, const Instant& at) {
  choice_.next(change);
  renew(at);
}

std::optional<MethodChange> MethodAtWork::cheaper(const Instant& at) {
  if (!choice_.weighs())
    return std::nullopt;
  return choice_.weigh(at.t, operations_of_explicit_step(), [&] {
    return integrate::fastest_rate(problem_.regime, problem_.pattern, at.t, at.y, at.yp);
  });
}

void MethodAtWork::judge(const Step& step) {
  if (closing_)
    closing_->accept(step.end, step.y, step.yp);
}

void MethodAtWork::accept(const Step& step) {
  if (choice_.more())
    choice_.accept(step.end - step.start, step.own, operations());
}

linalg::Statistics MethodAtWork::statistics() const {
  linalg::Statistics all = before_;
  const linalg::Statistics now = integrator_->statistics();
  all += now;
  all.last_step = now.last_step;
  all.last_order = now.last_order;
  return all;
}

/// Operations of all methods so far. The counts of an integrator that is made again, after an event
/// or a saved state, continue.
double MethodAtWork::operations() const {
  const linalg::Statistics s = statistics();
  const auto entries = static_cast<double>(problem_.pattern.row.size());
  return s.factor_work + entries * (linalg::of_residual * static_cast<double>(s.residual_calls) +
                                    linalg::of_jacobian * static_cast<double>(s.jacobian_calls));
}

/// Operations of one step of explicit_rk: for each stage a residual, and a Jacobian of the mass
/// matrix and the constraint rows.
double MethodAtWork::operations_of_explicit_step() const {
  constexpr double evaluations = 13.0; // 12 stages of order 8, and the end of the step
  const system::Regime& s = problem_.regime;
  const system::Pattern& pattern = problem_.pattern;
  double entries = 0.0;
  for (Index c = s.u0; c < s.u0 + s.n_u; ++c)
    for (Index k = pattern.column_start[static_cast<std::size_t>(c)];
         k < pattern.column_start[static_cast<std::size_t>(c) + 1]; ++k) {
      const Index row = pattern.row[static_cast<std::size_t>(k)];
      const bool mass =
          pattern.has_rate[static_cast<std::size_t>(k)] && row >= s.u0 && row < s.u0 + s.n_u;
      entries += mass || (row >= s.lambda0 && row < s.lambda0 + s.n_lambda);
    }
  return evaluations * (linalg::of_residual * static_cast<double>(pattern.row.size()) +
                        linalg::of_jacobian * entries);
}

/// Saves the total counts, those of this integrator included.
void MethodAtWork::save(State& out) const {
  out.done = statistics();
  out.methods = choice_.state();
  out.method = integrator_->state();
}

/// Restores the counts; the pattern and the rows of the regime must be those of the state.
void MethodAtWork::set(const State& from) {
  before_ = from.done;
  choice_.set(from.methods);
  make({from.time, from.y, from.yp});
  integrator_->set(from.method);
}

} // namespace hydrodae::run
