#pragma once
#include <cmath>

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

/// u = K e where |e| > b, else 0: a gain that does not answer to small signals.
class DeadBandLaw final : public Law {
public:
  DeadBandLaw(double gain, double band) : gain_(gain), band_(band) {}

  /// @param in  e
  void sample(double, std::span<const double> in, std::span<double> out) override {
    out[0] = std::abs(in[0]) > band_ ? gain_ * in[0] : 0.0;
  }

private:
  double gain_, band_;
};

struct DeadBand : Sampled {
  static constexpr std::string_view type = "dead_band";
  static constexpr std::string_view doc = "u = K e where |e| > b, else 0.";
  static constexpr Arity arity = {1, 1, 1, "the signal e"};
  double gain = 0.0, band = 0.0;

  std::unique_ptr<Law> law(const Place&) const { return std::make_unique<DeadBandLaw>(gain, band); }

  template <class C = DeadBand> static Fields<C> fields() {
    return usual_fields<C>() +
           Fields<C>{
               {"gain", &C::gain, "output per input", "Gain K.", true},
               {"band", &C::band, "unit of the input", "Half width b.", false, at_least(0)},
           };
  }
};

} // namespace hydrodae::control
