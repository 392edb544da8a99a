#pragma once
/// Stages of one step by Newton's iteration, with matrices that are kept while they serve.

#include "hydrodae/integrate/stage_newton.h"
#include "hydrodae/integrate/stage_polynomial.h"

namespace hydrodae::integrate {

class StageSolver {
public:
  /// Start of a step: the last accepted instant, and the weights of the norm there.
  struct Start {
    double t = 0.0;
    VectorX y, yp, w;
  };

  /// @param start, last  members of the method
  StageSolver(linalg::Equations& equations, const Start& start, const StagePolynomial& last)
      : e_(equations), from_(start), last_(last) {}

  /// Sets the method of the next steps.
  void use(StageNewton& newton);

  /// Simplified Newton from the last polynomial, with the present matrices if they serve. After a
  /// failure it uses new ones, then a straight line with the Jacobian at the start.
  bool simplified(double h);

  /// Full Newton from a straight line.
  bool full(double h);

  /// Takes the end of a step, or a restart: the Jacobian belongs to another step.
  void next_step() { fresh_ = false; }

  const MatrixX& stages() const { return stages_; } ///< increments (n, s) of the stages
  bool was_full() const { return state_.was_full; } ///< true: found by full Newton
  double contraction() const {
    return state_.contraction;
  } ///< contraction of the last step with its own matrices

  /// State without the matrices, which are made again.
  struct State {
    double contraction = 1.0;      ///< contraction of the last step with its own matrices
    double last_contraction = 1.0; ///< contraction of the last step
    /// Number of steps with new matrices after old ones failed; number of them left
    int wary = 0, wait = 0;
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
  bool fresh_ = false;    ///< true: the Jacobian belongs to this step
  double factored_ = 0.0; ///< step of the matrices at hand [s]
  int iterations_ = 0;    ///< number of iterations in this step
  double extra_ = 0.0;    ///< extra iterations of old matrices so far
  State state_;
};

} // namespace hydrodae::integrate
