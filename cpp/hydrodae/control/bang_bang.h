#pragma once
#include "hydrodae/control/law.h"

namespace hydrodae::control {

/// Two values, with a band of hysteresis about the target:
///
///   u = upper   where e = target - input > band
///       lower   where e < -band
///
/// and within the band what it was before; at the start upper for e >= 0.
class BangBang final : public Law {
public:
  BangBang(double target, double band, double lower, double upper)
      : target_(target), band_(band), lower_(lower), upper_(upper) {}

  /// @param in  what is controlled, and where there are two its target
  void sample(double, std::span<const double> in, std::span<double> out) override {
    const double e = (in.size() > 1 ? in[1] : target_) - in[0];
    if (!began_)
      high_ = e >= 0.0;
    if (e > band_ || e < -band_)
      high_ = e > 0.0;
    began_ = true;
    out[0] = high_ ? upper_ : lower_;
  }

  void remember(Archive& a) override { a(began_, high_); }

private:
  double target_, band_, lower_, upper_;
  bool began_ = false, high_ = false;
};

} // namespace hydrodae::control
