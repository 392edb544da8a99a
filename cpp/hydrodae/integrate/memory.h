#pragma once
/// Data that the next steps of each method depend on besides t, y and y' at the end of the last
/// one. Matrices are not included: they are made again.

#include <variant>

#include "hydrodae/core/error.h"
#include "hydrodae/integrate/stage_polynomial.h"
#include "hydrodae/integrate/stage_solver.h"
#include "hydrodae/linalg/equations.h"

namespace hydrodae::integrate {

/// Last step, for statistics.
struct LastStep {
  double length = 0.0; ///< [s]
  int order = 0;
};

struct CollocationState {
  int stages = 0; ///< number of stages of the next step
  StagePolynomial::State polynomial;
  StageSolver::State solver;
  double h = 0.0;     ///< next step [s]
  double reach = 0.0; ///< end of the step that the error control would have chosen [s]
  double last_h = 0.0, last_error = 1.0;
  /// Number of steps of this order; number of last steps that Newton limited
  int since_change = 0, slack = 0;
  LastStep made;
  linalg::ProgressGuard::State guard;
};

struct ExplicitState {
  double h = 0.0; ///< next step [s]
  double last_error = 1e-4;
  double usual_jump = 0.0; ///< usual jump of the accelerations between the last two stages
  LastStep made;
  linalg::ProgressGuard::State guard;
};

struct AlphaState {
  VectorX a;       ///< algorithm's own accelerations
  VectorX y0, yp0; ///< y, y' at the start of the last step
  double t0 = 0.0; ///< [s]
  LastStep made;
};

/// State of ida, whose order is 1 again.
struct BdfState {
  double rounding = 1e3; ///< rounding of the multipliers, in units of the machine epsilon
  int restarts = 0;
  linalg::ProgressGuard::State guard;
};

using Memory = std::variant<CollocationState, ExplicitState, AlphaState, BdfState>;

/// Memory of one method. Throws Error for the memory of another one.
template <class State> const State& memory_of(const Memory& memory) {
  if (const State* own = std::get_if<State>(&memory))
    return *own;
  throw Error("the state is of a run with another method");
}

} // namespace hydrodae::integrate
