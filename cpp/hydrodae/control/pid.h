#pragma once
#include <algorithm>
#include <cmath>

#include "hydrodae/control/law.h"

namespace hydrodae::control {

/// PID controller with a filtered derivative, limits and back-calculation (Astrom, Murray, Feedback
/// Systems, 2nd ed. 2021, sec. 11.5), at sampling instants T apart:
///
///   e = target - input
///   d = Tf / (Tf + T) d + (e - e_before) / (Tf + T)      0 at the first instant
///   v = Kp e + I + Kd d,   u = v within [lower, upper]
///   I += T (Ki e + (u - v) / Tt)                         0 at the start; Tt: tracking time
class Pid final : public Law {
public:
  struct Gains {
    double p = 0.0, i = 0.0, d = 0.0;
    double target = 0.0;
    double period = 0.0, filter_time = 0.0;
    double tracking_time = INFINITY;
    double lower = -INFINITY, upper = INFINITY;
  };

  explicit Pid(const Gains& gains) : g_(gains) {}

  /// @param in  what is controlled, and where there are two its target
  void sample(double, std::span<const double> in, std::span<double> out) override {
    const double e = (in.size() > 1 ? in[1] : g_.target) - in[0],
                 width = g_.filter_time + g_.period;
    if (began_)
      slope_ = g_.filter_time / width * slope_ + (e - error_) / width;
    const double wanted = g_.p * e + integral_ + g_.d * slope_;
    out[0] = std::clamp(wanted, g_.lower, g_.upper);
    integral_ += g_.period * (g_.i * e + (out[0] - wanted) / g_.tracking_time);
    error_ = e;
    began_ = true;
  }

  void remember(Archive& a) override { a(began_, error_, slope_, integral_); }

private:
  Gains g_;
  bool began_ = false;
  double error_ = 0.0, slope_ = 0.0, integral_ = 0.0;
};

} // namespace hydrodae::control
