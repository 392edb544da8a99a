#pragma once
#include "hydrodae/sea/dispersion.h"
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// eta = H/2 cos(w t - k.x + phase)
struct Regular : WaveSystem {
  static constexpr std::string_view type = "regular";
  static constexpr std::string_view doc = "One wave of one period: H/2 cos(w t - k.x + phase).";
  double height = 0.0, period = 0.0, phase = 0.0;

  Sum components(const Site& site) const {
    const double w = 2.0 * pi / period;
    const double k = wavenumber(w, site.depth, site.gravity);
    return {{{w, k, heading, 0.5 * height, phase}}, 0.0, "", ""};
  }
  std::optional<Fault> fault() const { return period_fault("period", period); }

  template <class W = Regular> static Fields<W> fields() {
    return system_fields<W>() +
           Fields<W>{
               {"height", &W::height, "m", "Height H of a regular wave, crest to trough.", true,
                at_least(0, 1e6)},
               {"period", &W::period, "s", "Period of a regular wave.", true, more_than(0, 1e6)},
               {"phase_deg", &W::phase, "deg",
                "Phase of a regular wave: its crest passes the origin when w t = -phase."},
           };
  }
};

} // namespace hydrodae::sea
