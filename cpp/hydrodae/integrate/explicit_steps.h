#pragma once
/// Step control of explicit Runge-Kutta methods, for one run or several side by side.

#include <algorithm>
#include <cmath>

namespace hydrodae::integrate {

struct ExplicitSteps {
  /// Bounds of the growth of a step
  static constexpr double safety = 0.9, least_growth = 0.2, most_growth = 6.0;

  /// Largest part of a step between two evaluations of the loads, larger than the true distance of
  /// the stages: in steps beyond a third of a wave, the estimated errors are a hundred times too
  /// large.
  static constexpr double gap = 0.48;

  /// Growth of the next step by proportional-integral control (Gustafsson 1991).
  /// @param error, last_error  errors in units of the tolerance; last_error is set to error
  /// @param power  exponent of the error that controls the next step
  static double growth(double error, double power, double most, double& last_error) {
    const double e = std::max(error, 1e-10);
    const double grow = std::clamp(
        safety * std::pow(e, -0.7 * power) * std::pow(last_error, 0.3 * power), least_growth, most);
    last_error = std::max(e, 1e-4);
    return grow;
  }

  /// Returns whether the jump between the accelerations of the last two stages, in units of the
  /// tolerance, is like those of the steps before. `usual` moves towards the jump. In smooth motion
  /// jumps were at most 34 times the usual (pendulums, linkages, floating bodies).
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
