#pragma once
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// Components given one by one: eta = sum a cos(w t - k x + phase), from a file or from lists.
struct ComponentFile : WaveSystem {
  static constexpr std::string_view type = "components";
  static constexpr std::string_view doc =
      "Components given one by one: the sum of a cos(w t - k.x + phase).";
  static constexpr double usual_loss = 0.02;
  std::optional<std::string> file;
  std::vector<double> omega, amplitude, phase; ///< of the components, also when from the file
  std::vector<double> headings;                ///< [rad]; empty: `heading` of all
  std::vector<double> frequency_range;

  Sum components(const Site& site) const;
  double significant_height() const; ///< 4 sqrt(sum a^2 / 2) [m]
  std::optional<Fault> fault() const;

  template <class W = ComponentFile> static Fields<W> fields() {
    return system_fields<W>() +
           Fields<W>{
               {"file", &W::file, "-",
                "Text with commas, a component a line: named columns omega [rad/s], amplitude [m], "
                "phase [rad] and, if they differ, heading [deg]; relative to the case file."},
               {"omega", &W::omega, "rad/s", "Frequencies of the components; without a file.",
                false, more_than(0)},
               {"amplitude", &W::amplitude, "m", "Their amplitudes.", false, at_least(0, 1e6)},
               {"phase", &W::phase, "rad",
                "Their phases: the crest passes the origin when w t = "
                "-phase."},
               {"headings_deg", &W::headings, "deg",
                "Their directions of travel; 'heading_deg' of all by default.", false,
                between(-360, 360)},
           } +
           range_fields<W>();
  }
};

} // namespace hydrodae::sea
