#pragma once
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// S ~ (wp^4/w^(4l+1)) exp(-(l + 1/4) (wp/w)^4), l = shape (one of the two parts of Ochi and Hubble
/// 1976; the other is a wave system of its own).
struct OchiHubble : Peaked {
  static constexpr std::string_view type = "ochi_hubble";
  static constexpr std::string_view doc =
      "One part of the spectrum of Ochi and Hubble (1976); the other part is a wave system of its "
      "own.";
  double shape = 1.0;

  Spectrum spectrum(double) const {
    const auto density = [l = shape](double x) { return ochi_hubble_shape(x, l); };
    return spectrum_of_shape(density, 1.0 / (4.0 * shape), height, period);
  }
  Sum components(const Site& site) const { return drawn(spectrum(site.gravity), site); }

  template <class W = OchiHubble> static Fields<W> fields() {
    return peaked_fields<W>() +
           Fields<W>{
               {"shape", &W::shape, "-", "Shape l of Ochi-Hubble.", false, between(0.5, 20)}} +
           irregular_fields<W>();
  }
};

} // namespace hydrodae::sea
