#pragma once
#include <cmath>

#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// S ~ exp(-(w / wp - 1)^2 / (2 s^2)), m0 = Hs^2/16: a swell whose energy is near its peak.
struct GaussianSwell : Peaked {
  static constexpr std::string_view type = "gaussian_swell";
  static constexpr std::string_view doc = "Swell with a spectrum of the shape of a bell.";
  double width = 0.1;

  Spectrum spectrum(double) const {
    const auto shape = [this](double x) { return std::exp(-0.5 * std::pow((x - 1) / width, 2)); };
    return spectrum_of_shape(shape, 0.0, height, period); // no tail: S falls faster than any w^-n
  }
  Sum components(const Site& site) const { return drawn(spectrum(site.gravity), site); }

  template <class W = GaussianSwell> static Fields<W> fields() {
    return peaked_fields<W>() +
           Fields<W>{{"width", &W::width, "-", "Deviation s relative to the peak frequency.", false,
                      between(0.02, 0.3)}} +
           irregular_fields<W>();
  }
};

} // namespace hydrodae::sea
