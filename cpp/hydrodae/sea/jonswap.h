#pragma once
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// S ~ w^-5 exp(-5/4 (wp/w)^4) gamma^exp(-(w/wp - 1)^2 / (2 s^2)), s = 0.07 below wp and 0.09
/// above, m0 = Hs^2/16.
struct Jonswap : Peaked {
  static constexpr std::string_view type = "jonswap";
  static constexpr std::string_view doc = "JONSWAP spectrum (Hasselmann et al. 1973).";
  double gamma = 3.3;

  Spectrum spectrum(double) const {
    return spectrum_of_shape([this](double x) { return jonswap_shape(x, gamma); }, 0.25, height,
                             period);
  }
  Sum components(const Site& site) const { return drawn(spectrum(site.gravity), site); }

  template <class W = Jonswap> static Fields<W> fields() {
    return peaked_fields<W>() +
           Fields<W>{
               {"gamma", &W::gamma, "-", "Peak enhancement of JONSWAP.", false, between(1, 20)}} +
           irregular_fields<W>();
  }
};

/// JONSWAP with gamma = 1.
struct Bretschneider : Peaked {
  static constexpr std::string_view type = "bretschneider";
  static constexpr std::string_view doc = "JONSWAP spectrum with gamma = 1.";

  Spectrum spectrum(double) const {
    return spectrum_of_shape([](double x) { return jonswap_shape(x, 1.0); }, 0.25, height, period);
  }
  Sum components(const Site& site) const { return drawn(spectrum(site.gravity), site); }

  template <class W = Bretschneider> static Fields<W> fields() {
    return peaked_fields<W>() + irregular_fields<W>();
  }
};

} // namespace hydrodae::sea
