#pragma once
/// Where the past of a delay is not smooth.

#include <vector>

#include "hydrodae/core/archive.h"

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

  void remember(Archive& a) { a(coming_); }

  static constexpr int none = 1000;

private:
  struct Kink {
    double t = 0.0;
    int derivative = 0;
    void remember(Archive& a) { a(t, derivative); }
  };
  void expect(double t, int derivative);

  std::vector<double> delays_;
  int highest_ = 0;          ///< derivative whose jump a step may notice
  std::vector<Kink> coming_; ///< in their order
};

} // namespace hydrodae::system
