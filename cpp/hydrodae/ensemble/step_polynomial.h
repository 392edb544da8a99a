#pragma once
/// A quantity within a step of the Runge-Kutta method of order 8, from its values at the stages.
///
/// The integral C of a quantity c(t, y) is one more unknown of the method, with the rates c_j of
/// the stages. The derivative of its interpolant of order 7 (Hairer, Norsett and Wanner, section
/// II.10) is
///
///   c(t0 + x h) = sum_m x^m sum_j W_mj c_j,    0 <= x <= 1, m = 0 .. 6,
///
/// which meets c at both ends of the step. W depends on the method alone.

#include <array>
#include <cstddef>

namespace hydrodae::ensemble {

inline constexpr std::size_t stages = 12;            ///< of the method
inline constexpr std::size_t polynomial_stages = 16; ///< 12, the end, and three inside the step
inline constexpr std::size_t polynomial_size = 7;

using StepPolynomial = std::array<std::array<double, polynomial_stages>, polynomial_size>;

/// W, by power and stage.
const StepPolynomial& step_polynomial();

} // namespace hydrodae::ensemble
