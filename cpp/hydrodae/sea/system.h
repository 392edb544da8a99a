#pragma once
/// Common members of every table [[wave]] and of its types.

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/core/one_of.h"
#include "hydrodae/sea/component.h"
#include "hydrodae/sea/crest.h"
#include "hydrodae/sea/spectrum.h"

namespace hydrodae::sea {

/// Place of the waves, and frequencies that the scene responds to.
struct Site {
  double depth = INFINITY, gravity = 9.81; ///< [m], [m/s2]
  /// Frequencies that a wave without its own range is cut to
  Band covered;
};

/// A wave system as a sum of plane waves.
struct Sum {
  std::vector<Component> components;
  double lost = 0.0; ///< part of the variance outside the range, beyond the usual one [-]
  std::string range; ///< description of that range
  std::string note;  ///< note on the components; "" if missing

  std::string lost_text() const; ///< "2.1 % of the variance lies outside 0.2 to 1.5 rad/s"
};

/// Wave system. A type is a struct that derives from this one (spectra from `Irregular`), with
///
///   type, doc, fields()       as every typed table (core/one_of.h)
///   components(Site)          its waves
///   significant_height()      Hs [m], except for a regular wave
///   peak_period(gravity)      Tp [s], if it exists: for checks of the steepness
///   fault(), fault(end_time)  optional: fault in its values
///
/// and one entry in the list of sea/wave.h.
struct WaveSystem {
  static constexpr std::string_view list_doc =
      "One wave system; the sea is the sum of all, and still without any.";
  std::string name;
  double heading = 0.0;
  std::optional<double> lost_variance;
  static constexpr double usual_loss = 0.0; ///< part of the variance that may be lost by default
};

template <class W> Fields<W> system_fields() {
  return {{"name", &W::name, "-", "Name of the wave system.", true},
          {"heading_deg", &W::heading, "deg", "Mean direction of travel; 0 = +x, 90 = +y.", false,
           between(-360, 360)}};
}

template <class W> Fields<W> range_fields() {
  return {
      {"lost_variance", &W::lost_variance, "-",
       "Largest part of the variance that may lie outside the frequencies of the database and is "
       "left out; 0.02 by default for a record, 0.1 for a spectrum without frequency_range.",
       false, between(0, 1)},
      {"frequency_range", &W::frequency_range, "rad/s",
       "Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 % "
       "above, as far as the database reaches.",
       false, more_than(0)},
  };
}

inline std::optional<Fault> range_fault(const std::vector<double>& range) {
  if (!range.empty() && (range.size() != 2 || !(range[0] < range[1])))
    return Fault{"frequency_range", "expected the lowest and the highest frequency [rad/s]"};
  return {};
}

/// Energies below the lowest and the highest frequency of the components [m2].
struct Cut {
  double low = 0.0, high = 0.0;
  double lost = 0.0; ///< energy of the usual range outside what is covered [m2]
};

/// Energies between which components are made: those of a range, or all but 0.1 % below and 0.5 %
/// above, as far as something is covered.
Cut energy_cut(const Spectrum& spectrum, const std::vector<double>& range, const Band& covered);

std::string range_text(const Band& covered); ///< "the database, 0.2 to 1.5 rad/s"

/// Fault of a spectrum that is given point by point.
std::optional<Fault> table_fault(const std::vector<double>& frequency,
                                 const std::vector<double>& density);

/// Capillary waves are shorter than what gravity moves.
inline constexpr double shortest_period = 1e-3; // [s]
std::optional<Fault> period_fault(const char* key, double period);

/// Wave system drawn from a spectrum.
struct Irregular : WaveSystem {
  static constexpr double usual_loss = 0.1;
  std::optional<double> spreading;
  int count = 200;
  std::string spacing = "energy";
  std::vector<double> frequency_range;
  int seed = 1;
  Crest crest;

  /// Components: one in each bin of the spectrum, with the energy of its bin and a frequency drawn
  /// in it (uniformly in energy or in frequency), a random phase, and a direction from the
  /// spreading. Draws, in this order for each bin: frequency, phase; then, with spreading, one
  /// start u of the sequence frac(u + i (sqrt(5) - 1)/2) that is mapped to directions.
  /// With a `crest` the result is constrained to it.
  Sum drawn(const Spectrum& spectrum, const Site& site) const;

  /// Fault of the range or the crest. A sea without energy cannot have a crest.
  std::optional<Fault> own_fault(bool has_energy) const;
};

template <class W> Fields<W> irregular_fields() {
  return Fields<W>{
             {"spreading", &W::spreading, "-",
              "Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90 "
              "deg; without it all waves travel along the heading.",
              false, between(0.5, 1000)},
             {"components", &W::count, "-", "Number of components of an irregular wave.", false,
              between(2, 100000)},
             {"spacing",
              &W::spacing,
              "-",
              "Bins of equal energy or of equal width in frequency; each has one component at a "
              "frequency drawn at random in its bin, so that the sea does not repeat.",
              false,
              any_value,
              {"energy", "frequency"}},
             {"seed", &W::seed, "-", "Seed of the random phases, frequencies and directions.",
              false, at_least(0)},
         } +
         range_fields<W>();
}

/// An irregular wave of a given significant height and peak period.
struct Peaked : Irregular {
  double height = 0.0, period = 0.0;
  double significant_height() const { return height; }
  double peak_period(double) const { return period; }
  std::optional<Fault> fault() const {
    const std::optional<Fault> wrong = period_fault("peak_period", period);
    return wrong ? wrong : own_fault(height > 0.0);
  }
};

template <class W> Fields<W> height_field() {
  return {{"significant_height", &W::height, "m", "Hs = 4 sqrt(m0).", true, at_least(0, 1e6)}};
}
template <class W> Fields<W> peaked_fields() {
  return system_fields<W>() + height_field<W>() +
         Fields<W>{{"peak_period", &W::period, "s", "Period at which the spectrum is highest.",
                    true, more_than(0, 1e6)}};
}

} // namespace hydrodae::sea
