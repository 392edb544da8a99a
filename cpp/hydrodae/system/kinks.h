#pragma once
/// Where the past of a delay is not smooth.

#include <utility>
#include <vector>

namespace hydrodae::system {

/// Instants at which a derivative of a motion jumps. Each delay passes them on: what jumps in the
/// m-th derivative of s at t jumps in the (m+1)-th at t + tau, through the damper.
class Kinks {
public:
  /// @param delays (n,) [s]
  /// @param time that of the fastest motion [s]
  /// @param longest step [s]
  Kinks(std::vector<double> delays, double time, double longest, double rtol);

  /// A derivative of a motion jumps at t: of order 1 the rate, of order 2 the acceleration.
  void add(double t, int derivative);

  /// Takes away what is at t or before, and passes it on.
  /// @returns the lowest derivative that has jumped at t; one above all where none has
  int pass(double t);

  /// The next one that a method of this order notices [s].
  double next(int order) const;

  static constexpr int none = 1000;

  struct Kink {
    double t = 0.0;
    int derivative = 0;
  };
  struct State {
    std::vector<Kink> coming; ///< in their order
  };
  const State& state() const { return state_; }
  void set(State state) { state_ = std::move(state); }

private:
  void expect(double t, int derivative);

  std::vector<double> delays_;
  int highest_ = 0; ///< derivative whose jump a step may notice
  State state_;
};

} // namespace hydrodae::system
