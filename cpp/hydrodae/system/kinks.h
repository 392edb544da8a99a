#pragma once
/// Instants at which the past of a delay is not smooth.

#include <utility>
#include <vector>

namespace hydrodae::system {

/// Instants at which a derivative of a motion jumps. Each delay passes them on: a jump of the m-th
/// derivative of s at t becomes one of the (m+1)-th at t + tau, through the damper.
class Kinks {
public:
  /// @param delays  (n,) delays [s]
  /// @param time  time scale of the fastest motion [s]
  /// @param longest  longest step [s]
  Kinks(std::vector<double> delays, double time, double longest, double rtol);

  /// Adds a jump at t; derivative 1: rate, 2: acceleration.
  void add(double t, int derivative);

  /// Removes the kinks at or before t and adds their successors, one delay later.
  /// @returns the lowest derivative that jumped at t; `none` if none did
  int pass(double t);

  /// Next kink that affects a method of this order [s].
  double next(int order) const;

  static constexpr int none = 1000;

  struct Kink {
    double t = 0.0;
    int derivative = 0;
  };
  struct State {
    std::vector<Kink> coming; ///< coming kinks in the order of time
  };
  const State& state() const { return state_; }
  void set(State state) { state_ = std::move(state); }

private:
  void expect(double t, int derivative);

  std::vector<double> delays_;
  int highest_ = 0; ///< highest derivative whose jump affects a step
  State state_;
};

} // namespace hydrodae::system
