#pragma once
#include "hydrodae/sea/system.h"

namespace hydrodae::sea {

/// A measured elevation over time at a point: the harmonics w_n = 2 pi n / (N dt) of the record
/// within `frequency_range`, or within what is covered. The mean (with the weights of the faded
/// ends) is taken off, and both ends fade over `taper` (the polynomial of the ramp). The
/// record has no data beyond them, which waves ahead of their excitation would need. The phases
/// refer to the origin and to t = 0 at `start` of the record. O(N) for each harmonic.
struct Measured : WaveSystem {
  static constexpr std::string_view type = "measured";
  static constexpr std::string_view doc =
      "Elevation over time at a point: the harmonics of the record.";
  static constexpr double usual_loss = 0.02;
  std::optional<std::string> file;
  std::vector<double> time, elevation; ///< record, also when it comes from the file
  std::vector<double> point;
  double start = 0.0;
  double taper = 30.0;
  std::vector<double> frequency_range;

  Sum components(const Site& site) const;
  double significant_height() const;                           ///< 4 standard deviations [m]
  double length() const { return time.back() - time.front(); } ///< [s]
  double step() const { return length() / static_cast<double>(time.size() - 1); } ///< [s]

  /// Returns a fault if steps are unequal or the record is shorter than the run.
  std::optional<Fault> fault(double end_time) const;

  template <class W = Measured> static Fields<W> fields() {
    return system_fields<W>() +
           Fields<W>{
               {"file", &W::file, "-",
                "Measured elevation: text with commas, named columns time [s] and elevation [m]; "
                "relative to the case file."},
               {"time", &W::time, "s",
                "Times of a measured elevation, at equal steps; without a file."},
               {"elevation", &W::elevation, "m", "Measured elevation at these times."},
               {"point", &W::point, "m", "Where it was measured, [x, y]; the origin by default."},
               {"start", &W::start, "s",
                "Time since the first sample of the record at which t = 0.", false,
                at_least(0, longest_time)},
               {"taper", &W::taper, "s",
                "Time over which a record fades at both ends, because the waves before and after "
                "it are unknown; 30 s by default.",
                false, at_least(0, longest_time)},
           } +
           range_fields<W>();
  }

private:
  std::optional<Fault> record_fault() const;
};

} // namespace hydrodae::sea
