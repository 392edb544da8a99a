#pragma once
/// The stages of one step by Newton's iteration, with matrices that are kept as long as they serve.

#include "hydrodae/integrate/stage_newton.h"
#include "hydrodae/integrate/stage_polynomial.h"

namespace hydrodae::integrate {

class StageSolver {
public:
  /// Where a step starts: the last accepted instant, and the weights of the norm there.
  struct Start {
    double t = 0.0;
    VectorX y, yp, w;
  };

  /// `start`, `last`: of the method at work.
  StageSolver(linalg::Equations& equations, const Start& start, const StagePolynomial& last)
      : e_(equations), from_(start), last_(last) {}

  /// The method with which the next steps are made.
  void use(StageNewton& newton);

  /// Simplified Newton from the last polynomial, with the matrices at hand where they serve; if it
  /// fails with new ones, and from a straight line with those of the start.
  bool simplified(double h);

  /// Full Newton from a straight line.
  bool full(double h);

  /// A step has ended, or the method starts again: the Jacobian is of another one.
  void next_step() { fresh_ = false; }

  const MatrixX& stages() const { return stages_; } ///< increments (n, s) that were found
  bool was_full() const { return state_.was_full; } ///< by full Newton
  double contraction() const {
    return state_.contraction;
  } ///< of the last step with matrices of its own

  /// Without the matrices: they are made again.
  struct State {
    double contraction = 1.0;      ///< of the last step with matrices of its own
    double last_contraction = 1.0; ///< of the last step
    int wary = 0, wait = 0; ///< steps to make with new ones after old ones failed; left of them
    bool was_full = false;
  };
  const State& state() const { return state_; }
  void set(const State& state) { state_ = state; }

private:
  void start_values(double h, bool extrapolate);
  void jacobian(double h, bool extrapolate);
  bool at_once() const { return state_.last_contraction <= 1e-3; }
  bool serves(double h) const;

  linalg::Equations& e_;
  const Start& from_;
  const StagePolynomial& last_;
  StageNewton* newton_ = nullptr;
  MatrixX stages_;
  VectorX guess_, guess_rate_;
  bool fresh_ = false;    ///< the Jacobian is of this step
  double factored_ = 0.0; ///< step of the matrices at hand [s]
  int iterations_ = 0;    ///< that this step took
  double extra_ = 0.0;    ///< iterations that old matrices have cost since
  State state_;
};

} // namespace hydrodae::integrate
