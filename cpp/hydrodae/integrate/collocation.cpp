#include "hydrodae/integrate/collocation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/integrate/driven_rows.h"
#include "hydrodae/integrate/stage_solver.h"
#include "hydrodae/linalg/saddle_point.h"

namespace hydrodae::integrate {

namespace {

/// Stage numbers of radau with variable order: order 5 to 13
constexpr int fewest = 3, most_stages = 7;

int stages_of(Family family, int order) {
  switch (family) {
  case Family::radau_iia:
    return order == 0 ? fewest : (order + 1) / 2;
  case Family::gauss:
    return order == 0 ? 3 : order / 2;
  case Family::lobatto_iiic:
    break;
  }
  return order == 0 ? 3 : order / 2 + 1;
}

class Collocation : public Integrator {
public:
  Collocation(Family family, const system::Regime& system, const system::Pattern& pattern,
              const SolverOptions& options, double t0, const VectorX& y, const VectorX& yp)
      : s_(system), pattern_(linalg::condensed(system, pattern)),
        e_(system, pattern_, options.rtol), family_(family), fixed_(options.step > 0.0),
        chooses_order_(options.order == 0 && !fixed_),
        project_(family_ == Family::gauss && system.formulation == system::Formulation::stabilised),
        max_step_(options.max_step > 0.0 ? options.max_step : options.end_time),
        guard_(t0, options.end_time, e_.time_scale()), now_{t0, y, yp, VectorX(system.n)},
        last_(system), solver_(e_, now_, last_), driven_(system), error_(system.n),
        v_(VectorX::Zero(system.n)), guess_(system.n) {
    use(stages_of(family_, options.order));
    if (project_)
      saddle_.emplace(e_);
    // The first step keeps the rounding of the multipliers, eps / h, below the tolerance.
    state_.h = fixed_ ? options.step
                      : std::min(max_step_, 3.0 * linalg::first_step(system, options.rtol, y, yp));
    state_.reach = t0 + state_.h;
    e_.accept(now_.t, now_.y, now_.yp);
  }

  double step(double end, double bound) override;
  bool restart(double t, const VectorX& y, const VectorX& yp) override;
  void interpolate(double t, VectorX& y, VectorX& yp) override;
  linalg::Statistics statistics() const override { return e_.statistics; }
  double gap() const override { return gap_; }
  int degree() const override { return last_.rk().stages; }
  int quadrature_nodes() const override { return newton_->rk().stages + 2; }
  Memory state() const override;
  void set(const Memory& state) override;

private:
  void use(int stages);
  double error(double h, bool refine);
  double drive_error(double h);
  void accept(double h);
  void choose_order(double error, bool cut);
  [[noreturn]] void fail(Reason reason, const std::string& what);

  const system::Regime& s_;
  const system::Pattern pattern_; ///< pattern of Newton's matrix
  linalg::Equations e_;
  const Family family_;
  const bool fixed_, chooses_order_, project_;
  const double max_step_;
  double end_ = 0.0;                          ///< latest end of the present step [s]
  std::optional<linalg::SaddlePoint> saddle_; ///< matrix for the projection of the end of a step
  linalg::ProgressGuard guard_;
  std::map<int, std::unique_ptr<StageNewton>> methods_; ///< Newton's iterations by number of stages
  StageNewton* newton_ = nullptr;
  CollocationState state_;          ///< state without that of the parts below
  StageSolver::Start now_, before_; ///< ends of the last step and the one before, for a failed step
  StagePolynomial last_;
  StageSolver solver_;
  MatrixX rates_; ///< rates of the stages
  const DrivenRows driven_;
  VectorX error_, v_, guess_;
  VectorX nodes_;    ///< nodes of the interpolant on [0, 1]
  double gap_ = 1.0; ///< see `gap`
};

void Collocation::use(int stages) {
  std::unique_ptr<StageNewton>& entry = methods_[stages];
  if (!entry)
    entry = std::make_unique<StageNewton>(e_, make_runge_kutta(family_, stages));
  newton_ = entry.get();
  solver_.use(*newton_);
  nodes_ = newton_->rk().c;
  gap_ = fixed_ ? 1.0 : largest_gap({nodes_.begin(), nodes_.end()});
  if (family_ != Family::lobatto_iiic) {
    nodes_.conservativeResize(stages + 1);
    nodes_[stages] = 0.0;
  }
  state_.since_change = state_.slack = 0;
  state_.last_h = 0.0; // the last error belongs to another method
}

void Collocation::fail(Reason reason, const std::string& what) {
  throw SolverError(now_.t, {reason,
                             what + ", last step " + number_text(state_.h) + " s",
                             "",
                             {{"step", state_.h}},
                             "",
                             e_.diagnosis(now_.t, now_.y, now_.yp)});
}

/// Local error in units of the tolerance: (J + B / (gamma0 h))^-1 (B v + f(t0, y0)) with v = sum
/// error_i Z_i / (gamma0 h); a second time from y0 + error if it would reject the step.
double Collocation::error(double h, bool refine) {
  const RungeKutta& rk = newton_->rk();
  if (solver_.was_full()) { // the start or end may be singular
    const int middle = rk.stages / 2;
    MatrixX rate;
    newton_->rates(h, solver_.stages(), rate);
    e_.jacobian(now_.t + rk.c[middle] * h, now_.y + solver_.stages().col(middle), rate.col(middle));
    if (!newton_->factorise(h))
      return 0.0; // judged by the next steps
  }
  v_ = -solver_.stages() * rk.error / (rk.gamma0 * h);
  VectorX at = now_.y;
  double size = 0.0;
  for (int pass = 0; pass < (refine ? 2 : 1); ++pass) {
    if (!e_.residual(now_.t, at, v_, error_))
      return HUGE_VAL;
    // The start meets the constraints: their residual is an error of Newton's iteration.
    if (s_.formulation != system::Formulation::index_1)
      error_.tail(s_.n - s_.lambda0).setZero();
    newton_->solve_real(error_);
    error_ = -error_;
    size = e_.norm(now_.w, error_);
    if (size < 1.0)
      break;
    at.head(s_.lambda0) = (now_.y + error_).head(s_.lambda0);
  }
  return std::max(size, 1e-10);
}

/// Error of the polynomial in driven constraints between its stages, in units of the tolerance.
double Collocation::drive_error(double h) {
  const RungeKutta& rk = newton_->rk();
  double size = 0.0;
  const double last = rk.stages > 1 ? rk.c[rk.stages - 2] : 0.0;
  for (const double x : {0.5 * rk.c[0], 0.5 * (last + 1.0)}) {
    evaluate_stages(s_, rk, now_.y, solver_.stages(), x, guess_);
    v_.setZero();
    if (!e_.residual(now_.t + x * h, guess_, v_, error_))
      return HUGE_VAL;
    size = std::max(size, driven_.largest(error_) / e_.rtol);
  }
  return size;
}

void Collocation::accept(double h) {
  const RungeKutta& rk = newton_->rk();
  if (project_)
    before_ = now_;
  newton_->rates(h, solver_.stages(), rates_);
  last_.set_method(rk);
  last_.accept(now_.t, h, now_.y, solver_.stages(), rates_);
  now_.t = end_ - now_.t <= h ? end_ : now_.t + h;
  if (rk.stiffly_accurate()) {
    now_.y += solver_.stages().col(rk.stages - 1);
    now_.yp = rates_.col(rk.stages - 1);
  } else {
    VectorX at_end(s_.n);
    last_.evaluate(1.0, at_end);
    now_.y.head(s_.lambda0) += (solver_.stages() * rk.end).head(s_.lambda0);
    now_.y.tail(s_.n - s_.lambda0) = at_end.tail(s_.n - s_.lambda0);
    last_.evaluate_rates(1.0, now_.yp);
    if (project_ &&
        (!saddle_->accelerations(now_.t, now_.y, now_.yp) || !saddle_->project(now_.t, now_.y) ||
         !saddle_->accelerations(now_.t, now_.y, now_.yp))) {
      now_ = before_;
      last_.clear(); // no last step to extrapolate
      fail(Reason::drift, "the constraints cannot be met at the end of the step");
    }
  }
  e_.accept(now_.t, now_.y, now_.yp);
  if (nodes_.size() <= 2)
    last_.end_at(now_.y);
  solver_.next_step();
  ++e_.statistics.steps;
  e_.statistics.last_step = h;
  e_.statistics.last_order = rk.order;
}

/// Chooses the number of stages. It rises if Newton contracts at once (Hairer and Wanner 1999). It
/// falls if Newton, not the error, limits the steps for long; two stages change the error about 300
/// times. A step cut short by waves or an end needs no more stages, and fewer if the error allows.
void Collocation::choose_order(double error, bool cut) {
  constexpr double up = 0.02, down = 0.1, little = 1e-3;
  if (!chooses_order_ || solver_.was_full())
    return;
  ++state_.since_change;
  state_.slack = (solver_.contraction() >= down || cut) && error <= little ? state_.slack + 1 : 0;
  const int stages = newton_->rk().stages;
  if (solver_.contraction() <= up && stages < most_stages && state_.since_change >= 10 && !cut)
    use(stages + 2);
  // larger steps pass a singular pose in fewer steps
  else if (state_.slack >= 20 && stages > fewest)
    use(stages - 2);
}

double Collocation::step(double end, double bound) {
  constexpr double safety = 0.9, most_growth = 5.0, most_cut = 0.125;
  constexpr double newton_cut = 0.4, aim = 0.25; // growth of the step; aim of Newton's contraction
  end_ = end;
  bool rejected = last_.empty();
  double hopeless = HUGE_VAL; // shortest step for which simplified Newton fails
  for (;;) {
    const double left = end_ - now_.t, bounded = fixed_ ? HUGE_VAL : bound - now_.t,
                 wanted = state_.h;
    auto fitted = [&](double h) { return std::min(left - h < 0.01 * h ? left : h, bounded); };
    double h = fitted(state_.h);
    if (h < 1e-13 * std::max(std::abs(now_.t), e_.time_scale()) && h < left)
      fail(Reason::step,
           "Newton's iteration does not converge, or the local error stays too large, however "
           "short the step");
    e_.weights(now_.y, now_.w);
    // Shorter steps help simplified Newton, but shrink without end near a singular pose. Full
    // Newton there takes the step that the error allows, at the cost of about 2 s of the short
    // ones.
    const double allowed = std::min({state_.reach, end_, fixed_ ? end_ : bound}) - now_.t;
    const double shortest = fixed_ ? 0.0 : allowed / (2.0 * newton_->rk().stages);
    bool solved = h >= shortest && h < hopeless && solver_.simplified(h);
    if (!solved && !fixed_ && newton_cut * h >= shortest) {
      hopeless = std::min(hopeless, h);
      state_.h = newton_cut * h;
      rejected = true;
      continue;
    }
    if (!solved) {
      h = fixed_ ? h : fitted(std::max(h, allowed));
      solved = solver_.full(h);
    }
    if (!solved) {
      ++e_.statistics.convergence_failures;
      if (fixed_)
        fail(Reason::step,
             "Newton's iteration does not converge at the fixed step, simplified or full");
      state_.h = std::min(state_.h, 0.7 * h);
      state_.reach = now_.t + 0.7 * h;
      rejected = true;
      continue;
    }
    if (fixed_) {
      accept(h);
      return now_.t;
    }
    double err = error(h, rejected);
    if (!driven_.empty())
      err = std::max(err, drive_error(h));
    const double power = 1.0 / (newton_->rk().stages + 1);
    double grow = std::clamp(safety * std::pow(err, -power), most_cut, most_growth);
    if (!(err < 1.0)) {
      ++e_.statistics.error_test_failures;
      state_.h = h * (std::isfinite(err) ? std::min(grow, 0.9) : most_cut);
      state_.reach = now_.t + state_.h;
      rejected = true;
      continue;
    }
    const double next_reach = now_.t + h + std::min(max_step_, h * grow);
    if (state_.last_h > 0.0) // predictive control of Gustafsson
      grow = std::min(grow, std::clamp(h / state_.last_h *
                                           std::pow(err * err / state_.last_error, -power) * safety,
                                       most_cut, most_growth));
    if (rejected)
      grow = std::min(grow, 1.0);
    if (!solver_.was_full()) // the contraction grows with the square of the step
      grow = std::min(grow, std::max(std::sqrt(aim / solver_.contraction()), 0.3));
    state_.last_h = h;
    state_.last_error = std::max(err, 1e-2);
    accept(h);
    state_.reach = std::max(state_.reach, next_reach);
    if (!(grow >= 1.0 && grow <= 1.2 &&
          solver_.contraction() <= 1e-3)) // otherwise the matrices are used again
      state_.h = std::min(max_step_, h * grow);
    else
      state_.h = h;
    if (h == left) // a shortened step is no evidence against longer ones
      state_.h = std::max(state_.h, wanted);
    choose_order(err, h < wanted);
    guard_.after_step(now_.t, [&] { return e_.diagnosis(now_.t, now_.y, now_.yp); });
    return now_.t;
  }
}

/// Restarts with the same number of stages; more are tried if there is time between two restarts.
bool Collocation::restart(double t, const VectorX& y, const VectorX& yp) {
  now_.t = t;
  now_.y = y;
  now_.yp = yp;
  last_.clear();
  state_.last_h = 0.0;
  state_.last_error = 1.0;
  state_.since_change = state_.slack = 0;
  solver_.next_step();
  state_.reach = t + state_.h;
  e_.accept(now_.t, now_.y, now_.yp);
  return true;
}

void Collocation::interpolate(double t, VectorX& y, VectorX& yp) {
  if (last_.empty() || t >= now_.t) {
    y = now_.y;
    yp = now_.yp;
    return;
  }
  const double x = last_.place(t);
  last_.evaluate(x, y);
  last_.evaluate_rates(x, yp);
  if (nodes_.size() <= 2)
    last_.between_ends(x, now_.y, y);
}

Memory Collocation::state() const {
  CollocationState out = state_;
  out.stages = newton_->rk().stages;
  out.polynomial = last_.state();
  out.solver = solver_.state();
  out.made = {e_.statistics.last_step, e_.statistics.last_order};
  out.guard = guard_.state();
  return out;
}

void Collocation::set(const Memory& state) {
  const auto& from = memory_of<CollocationState>(state);
  last_.set(from.polynomial);
  if (last_.stages() > 0) { // the last step may have had another order
    use(last_.stages());
    last_.set_method(newton_->rk());
  }
  use(from.stages);
  solver_.set(from.solver);
  e_.statistics.last_step = from.made.length;
  e_.statistics.last_order = from.made.order;
  guard_.set(from.guard);
  state_ = from;
}

} // namespace

std::unique_ptr<Integrator> make_radau(const system::Regime& system, const system::Pattern& pattern,
                                       const SolverOptions& options, double t0, const VectorX& y,
                                       const VectorX& yp) {
  return std::make_unique<Collocation>(Family::radau_iia, system, pattern, options, t0, y, yp);
}

std::unique_ptr<Integrator> make_gauss(const system::Regime& system, const system::Pattern& pattern,
                                       const SolverOptions& options, double t0, const VectorX& y,
                                       const VectorX& yp) {
  return std::make_unique<Collocation>(Family::gauss, system, pattern, options, t0, y, yp);
}

std::unique_ptr<Integrator> make_lobatto_iiic(const system::Regime& system,
                                              const system::Pattern& pattern,
                                              const SolverOptions& options, double t0,
                                              const VectorX& y, const VectorX& yp) {
  return std::make_unique<Collocation>(Family::lobatto_iiic, system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::integrate
