#pragma once

namespace hydrodae::solve {

/// What an integrator did so far.
struct Statistics {
  long steps = 0;
  long residual_calls = 0;
  long jacobian_calls = 0;
  long newton_iterations = 0;
  long error_test_failures = 0;
  long convergence_failures = 0;
  double last_step = 0.0; ///< [s]
  int last_order = 0;
};

} // namespace hydrodae::solve
