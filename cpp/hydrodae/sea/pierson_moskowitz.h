#pragma once
#include <algorithm>

#include "hydrodae/core/types.h"
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// JONSWAP with gamma = 1 and wp from Hs: m0 = Hs^2/16 = 0.0081 g^2 / (5 wp^4).
struct PiersonMoskowitz : Irregular {
  static constexpr std::string_view type = "pierson_moskowitz";
  static constexpr std::string_view doc =
      "Spectrum of a fully grown wind sea; its period follows from Hs.";
  double height = 0.0;

  double significant_height() const { return height; }
  double peak_period(double gravity) const {
    const double wp =
        std::pow(16.0 * 0.0081 / 5.0 * std::pow(gravity / std::max(height, 1e-12), 2.0), 0.25);
    return 2.0 * pi / wp;
  }
  Spectrum spectrum(double gravity) const {
    return spectrum_of_shape([](double x) { return jonswap_shape(x, 1.0); }, 0.25, height,
                             peak_period(gravity));
  }
  Sum components(const Site& site) const { return drawn(spectrum(site.gravity), site); }
  std::optional<Fault> fault() const { return own_fault(height > 0.0); }

  template <class W = PiersonMoskowitz> static Fields<W> fields() {
    return system_fields<W>() + height_field<W>() + irregular_fields<W>();
  }
};

} // namespace hydrodae::sea
