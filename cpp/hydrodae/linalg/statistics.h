#pragma once
namespace hydrodae::linalg {

/// Measured operations of a residual and of a Jacobian, for each entry of the Jacobian.
inline constexpr double of_residual = 8.0, of_jacobian = 40.0;

/// Counts of an integrator so far.
struct Statistics {
  long steps = 0;
  long residual_calls = 0;
  long jacobian_calls = 0;
  long newton_iterations = 0;
  long error_test_failures = 0;
  long convergence_failures = 0;
  double factor_work = 0.0; ///< operations for the factors of Newton's matrices
  double last_step = 0.0;   ///< length of the last step [s]
  int last_order = 0;

  /// Adds the counts of another part of the same run; the last step stays.
  Statistics& operator+=(const Statistics& other) {
    steps += other.steps;
    residual_calls += other.residual_calls;
    jacobian_calls += other.jacobian_calls;
    newton_iterations += other.newton_iterations;
    error_test_failures += other.error_test_failures;
    convergence_failures += other.convergence_failures;
    factor_work += other.factor_work;
    return *this;
  }
};

} // namespace hydrodae::linalg
