#pragma once
/// Polynomial of a step of a collocation method, through its start and its stages.

#include "hydrodae/integrate/runge_kutta.h"
#include "hydrodae/system/regime.h"
#include "hydrodae/system/system.h"

namespace hydrodae::integrate {

/// Evaluates y at x = (t - t0) / h of a step with increments Z (n, s) from `start`. Lobatto's first
/// stage is at the start itself, and multipliers of Gauss have no value there.
void evaluate_stages(const system::Regime& system, const RungeKutta& rk, const VectorX& start,
                     const MatrixX& Z, double x, VectorX& y);

/// Polynomial of the last step.
class StagePolynomial {
public:
  explicit StagePolynomial(const system::Regime& system) : s_(system) {}

  /// @param rk  must outlive this object
  void set_method(const RungeKutta& rk) { rk_ = &rk; }

  /// Sets the step of length h from t0, y0 with increments Z and rates of the stages (n, s).
  void accept(double t0, double h, const VectorX& y0, const MatrixX& Z, const MatrixX& rates);
  /// Sets the end of the step, for `between_ends`.
  void end_at(const VectorX& y);
  /// Removes the last step.
  void clear() { state_.h = 0.0; }

  bool empty() const { return state_.h == 0.0; }
  int stages() const { return static_cast<int>(state_.Z.cols()); }
  double length() const { return state_.h; } ///< [s]
  double place(double t) const { return (t - state_.t0) / state_.h; }
  const RungeKutta& rk() const { return *rk_; }

  void evaluate(double x, VectorX& y) const {
    evaluate_stages(s_, *rk_, state_.y0, state_.Z, x, y);
  }
  /// Computes y' from the stages alone.
  void evaluate_rates(double x, VectorX& yp) const;
  /// Replaces positions and velocities of y if the interpolant is a line: velocities by a line
  /// between both ends of the step, positions by the cubic with these rates, so that a falling body
  /// follows a parabola. `end`: y at the end of the step.
  void between_ends(double x, const VectorX& end, VectorX& y) const;

  struct State {
    double t0 = 0.0, h = 0.0; ///< start and length of the step [s]
    VectorX y0;
    MatrixX Z, rates;
    VectorX slope0, slope; ///< rates of the positions at both ends, for a line
  };
  const State& state() const { return state_; }
  void set(State state) { state_ = std::move(state); }

private:
  const system::Regime& s_;
  const RungeKutta* rk_ = nullptr;
  State state_;
};

} // namespace hydrodae::integrate
