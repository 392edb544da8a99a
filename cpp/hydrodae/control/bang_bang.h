#pragma once
#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

struct BangBangState {
  bool began = false, high = false;
};

/// Two values, with a band of hysteresis about the target:
///
///   u = upper   where e = target - input > band
///       lower   where e < -band
///
/// and within the band the last value; at the start upper for e >= 0.
class BangBangLaw final : public StatefulLaw<BangBangState> {
public:
  BangBangLaw(double target, double band, double lower, double upper)
      : target_(target), band_(band), lower_(lower), upper_(upper) {}

  /// @param in  controlled channel, and optionally its target
  void sample(double, std::span<const double> in, std::span<double> out) override {
    const double e = (in.size() > 1 ? in[1] : target_) - in[0];
    if (!state_.began)
      state_.high = e >= 0.0;
    if (e > band_ || e < -band_)
      state_.high = e > 0.0;
    state_.began = true;
    out[0] = state_.high ? upper_ : lower_;
  }

private:
  double target_, band_, lower_, upper_;
};

struct BangBang : Sampled {
  static constexpr std::string_view type = "bang_bang";
  static constexpr std::string_view doc =
      "u = upper or lower by the sign of e = target - input, with hysteresis.";
  static constexpr Arity arity = of_target;
  double target = 0.0, band = 0.0, lower = 0.0, upper = 0.0;

  std::unique_ptr<Law> law(const Place&) const {
    return std::make_unique<BangBangLaw>(target, band, lower, upper);
  }
  std::optional<Fault> fault() const {
    if (lower > upper)
      return Fault{"lower", "'lower' is above 'upper'"};
    return {};
  }
  static std::optional<Fault> fault(const Terminals& t) { return target_fault(t); }

  template <class C = BangBang> static Fields<C> fields() {
    return usual_fields<C>() +
           Fields<C>{
               {"target", &C::target, "unit of the input",
                "What the input is to be, where no second input gives it."},
               {"band", &C::band, "unit of the input",
                "Half width of the hysteresis: within it the output stays.", false, at_least(0)},
               {"lower", &C::lower, "unit of the output", "Least output.", true},
               {"upper", &C::upper, "unit of the output", "Largest output.", true},
           };
  }
};

} // namespace hydrodae::control
