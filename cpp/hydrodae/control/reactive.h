#pragma once
#include <algorithm>
#include <cmath>

#include "hydrodae/control/law.h"

namespace hydrodae::control {

/// u = -K (s - s0) - C s' within +-limit.
class Reactive final : public Law {
public:
  Reactive(double stiffness, double damping, double neutral, double limit)
      : k_(stiffness), c_(damping), s0_(neutral), limit_(limit) {}

  /// @param in  s and s'
  void sample(double, std::span<const double> in, std::span<double> out) override {
    out[0] = std::clamp(-k_ * (in[0] - s0_) - c_ * in[1], -limit_, limit_);
  }

private:
  double k_, c_, s0_, limit_;
};

/// u = -C s' within +-limit.
class Resistive final : public Law {
public:
  Resistive(double damping, double limit) : c_(damping), limit_(limit) {}

  /// @param in  s'
  void sample(double, std::span<const double> in, std::span<double> out) override {
    out[0] = std::clamp(-c_ * in[0], -limit_, limit_);
  }

private:
  double c_, limit_;
};

} // namespace hydrodae::control
