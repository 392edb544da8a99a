#include "hydrodae/integrate/stage_solver.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::integrate {

void StageSolver::use(StageNewton& newton) {
  newton_ = &newton;
  factored_ = 0.0;
}

/// Initial guess of the stages: the last step's polynomial, or a straight line.
void StageSolver::start_values(double h, bool extrapolate) {
  const RungeKutta& rk = newton_->rk();
  stages_.resize(e_.system.n, rk.stages);
  if (extrapolate) {
    for (int i = 0; i < rk.stages; ++i) {
      last_.evaluate(1.0 + rk.c[i] * h / last_.length(), guess_);
      stages_.col(i) = guess_ - from_.y;
    }
    return;
  }
  for (int i = 0; i < rk.stages; ++i) {
    stages_.col(i) = rk.c[i] * h * from_.yp;
    stages_.col(i).tail(e_.system.n - e_.system.lambda0).setZero();
  }
}

/// Computes one Jacobian for all stages: in the middle of the step if there is a last polynomial,
/// where it differs least from those of the stages; else at the start.
void StageSolver::jacobian(double h, bool extrapolate) {
  if (extrapolate) {
    const double x = 1.0 + 0.5 * h / last_.length();
    last_.evaluate(x, guess_);
    last_.evaluate_rates(x, guess_rate_);
    e_.jacobian(from_.t + 0.5 * h, guess_, guess_rate_);
  } else {
    e_.jacobian(from_.t, from_.y, from_.yp);
  }
  fresh_ = true;
  factored_ = extra_ = 0.0;
}

/// Returns whether the present matrices serve a step h: if Newton contracts at once; if they are
/// expensive, until the extra iterations have cost as much as a renewal.
bool StageSolver::serves(double h) const {
  constexpr double same = 1e-9;
  constexpr double dear = 4.0; // iterations
  return factored_ > 0.0 && std::abs(h - factored_) <= same * h &&
         (at_once() ||
          (newton_->renewal() >= dear && extra_ < newton_->renewal() && state_.wait == 0));
}

bool StageSolver::simplified(double h) {
  constexpr double longest_guess = 3.0; // steps of the last polynomial
  constexpr int most_wary = 15;         // steps
  bool extrapolate = !last_.empty() && h <= longest_guess * last_.length();
  bool renew = !fresh_ && !(factored_ > 0.0 && at_once()) && !serves(h);
  for (;;) {
    if (renew)
      jacobian(h, extrapolate);
    const bool serving = serves(h), old = serving && !at_once();
    if (serving || newton_->factorise(h)) {
      factored_ = h;
      start_values(h, extrapolate);
      if (newton_->simplified(from_.t, h, from_.y, from_.w, stages_) == NewtonResult::converged) {
        state_.last_contraction = newton_->contraction;
        if (old) {
          extra_ += std::max(0, newton_->iterations - iterations_);
          state_.wary = 0;
        } else {
          state_.wait = std::max(0, state_.wait - 1);
          state_.contraction = newton_->contraction;
          iterations_ = newton_->iterations;
        }
        state_.was_full = false;
        return true;
      }
      if (old)
        state_.wait = state_.wary = std::min(2 * state_.wary + 1, most_wary);
    }
    if (fresh_ && !extrapolate)
      break;
    extrapolate = extrapolate && !fresh_;
    renew = true;
  }
  fresh_ = false;
  factored_ = 0.0;
  return false;
}

bool StageSolver::full(double h) {
  start_values(h, false);
  fresh_ = false; // the present Jacobian becomes that of a stage
  factored_ = 0.0;
  state_.was_full = newton_->full(from_.t, h, from_.y, from_.w, stages_) == NewtonResult::converged;
  return state_.was_full;
}

} // namespace hydrodae::integrate
