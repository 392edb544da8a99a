#pragma once
#include <algorithm>

#include "hydrodae/core/types.h"
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// S given point by point, straight lines between, m0 as given.
struct DensityTable : Irregular {
  static constexpr std::string_view type = "table";
  static constexpr std::string_view doc = "Spectrum given point by point, straight lines between.";
  std::vector<double> frequency, density;

  double significant_height() const { return 4.0 * std::sqrt(spectrum(0.0).m0); }
  double peak_period(double) const {
    const auto peak = std::max_element(density.begin(), density.end()) - density.begin();
    return 2.0 * pi / frequency[static_cast<std::size_t>(peak)];
  }
  Spectrum spectrum(double) const { return spectrum_of_points(frequency, density); }
  Sum components(const Site& site) const { return drawn(spectrum(site.gravity), site); }
  std::optional<Fault> fault() const {
    const std::optional<Fault> wrong = table_fault(frequency, density);
    return wrong ? wrong : own_fault(spectrum(0.0).m0 > 0.0);
  }

  template <class W = DensityTable> static Fields<W> fields() {
    return system_fields<W>() +
           Fields<W>{
               {"frequency", &W::frequency, "rad/s", "Frequencies of a table, ascending.", true,
                more_than(0)},
               {"density", &W::density, "m2 s/rad", "Spectral density S at these frequencies.",
                true, at_least(0)},
           } +
           irregular_fields<W>();
  }
};

} // namespace hydrodae::sea
