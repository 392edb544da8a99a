#pragma once
/// Control of the steps of explicit Runge-Kutta methods, of one run or of several side by side.

#include <algorithm>
#include <cmath>

namespace hydrodae::integrate {

struct ExplicitSteps {
  static constexpr double safety = 0.9, least_growth = 0.2, most_growth = 6.0; ///< of the step

  /// Largest part of a step between two times at which it asks for the loads. Larger than it is
  /// between stages: in steps beyond a third of a wave the estimated errors are a hundred times too
  /// large.
  static constexpr double gap = 0.48;

  /// Growth of the next step by proportional-integral control (Gustafsson 1991).
  /// @param error, last_error in units of the tolerance; the second moves on to the first
  /// @param power of the error that bounds the next step
  static double growth(double error, double power, double most, double& last_error) {
    const double e = std::max(error, 1e-10);
    const double grow = std::clamp(
        safety * std::pow(e, -0.7 * power) * std::pow(last_error, 0.3 * power), least_growth, most);
    last_error = std::max(e, 1e-4);
    return grow;
  }

  /// Is the jump between the accelerations of the last two stages, in units of the tolerance, like
  /// those of the steps before? `usual` moves on to the jump. Where all is smooth, jumps are 34
  /// times the common at most, as was found on pendulums, linkages and floating bodies.
  static bool is_usual(double jump, double& usual) {
    constexpr double allowed = 100.0, least = 3.0, memory = 0.8;
    const double now = std::max(jump, least), common = std::max(usual, least);
    if (!(now <= allowed * common))
      return false;
    usual = std::pow(common, memory) * std::pow(now, 1.0 - memory);
    return true;
  }
};

} // namespace hydrodae::integrate
