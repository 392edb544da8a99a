#pragma once
/// Tables [sea] and [[wave]]: the sea is the sum of its wave systems; without any it is still.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/field.h"

namespace hydrodae::sea {

/// Table [sea]: what all wave systems share.
struct Sea {
  static constexpr std::string_view doc = "What all wave systems share, and the current.";
  double ramp = 0.0;
  Vector3 current = Vector3::Zero();
  std::string phase = "fixed";
  std::string stretching = "vertical";
  bool bernoulli = false;

  template <class S = Sea> static Fields<S> fields() {
    return {
        {"ramp", &S::ramp, "s",
         "Time over which all waves grow from nothing, by a polynomial of degree 7 (three "
         "continuous derivatives).",
         false, at_least(0, longest_time)},
        {"current", &S::current, "m/s",
         "Velocity of the water, the same everywhere, on which the Morison elements work; the "
         "waves do not feel it."},
        {"phase",
         &S::phase,
         "-",
         "Where a body feels the phase of the waves: at its reference position (fixed), or where "
         "it "
         "is (moving: for bodies that drift; then every evaluation sums all components).",
         false,
         any_value,
         {"fixed", "moving"}},
        {"stretching",
         &S::stretching,
         "-",
         "Pressure of the waves above z = 0 on bodies with `froude_krylov = \"mesh\"`: hydrostatic "
         "down from the crest (vertical: consistent to second order), the profile of linear theory "
         "moved up to the crest (wheeler), e^(kz) as it is (extrapolated), or nothing: the wetted "
         "part ends at z = 0 (none).",
         false,
         any_value,
         {"vertical", "wheeler", "extrapolated", "none"}},
        {"bernoulli", &S::bernoulli, "-",
         "Whether the pressure on them has the term -rho u^2 / 2 of the waves' own velocity."},
    };
  }
};

/// Table [[wave]]: one wave system.
///
///   regular:            eta = H/2 cos(w t - k.x + phase)
///   jonswap:            S ~ w^-5 exp(-5/4 (wp/w)^4) gamma^exp(-(w/wp - 1)^2 / (2 s^2)), s = 0.07
///                       below wp and 0.09 above (Hasselmann et al. 1973), m0 = Hs^2/16
///   bretschneider:      the same with gamma = 1
///   pierson_moskowitz:  the same with gamma = 1 and wp from Hs: m0 = 0.0081 g^2 / (5 wp^4)
///   ochi_hubble:        S ~ (wp^4/w^(4l+1)) exp(-(l + 1/4) (wp/w)^4), l = shape (one of the two
///                       parts of Ochi and Hubble 1976; the other is a wave system of its own)
///   table:              S given point by point, straight lines between, m0 as given
///   measured:           elevation over time at a point: the harmonics of the record
struct Wave {
  static constexpr std::string_view doc =
      "One wave system; the sea is the sum of all, and still without any.";
  std::string name;
  std::string type;
  std::optional<double> height, period;
  double phase = 0.0;
  std::optional<double> significant_height, peak_period;
  double gamma = 3.3;
  double shape = 1.0;
  std::vector<double> frequency, density;
  std::optional<std::string> file;
  std::vector<double> time, elevation; ///< of the record, also when it comes from the file
  std::vector<double> point;
  double start = 0.0;
  double taper = 30.0;
  std::optional<double> lost_variance;
  double heading = 0.0;
  std::optional<double> spreading;
  int components = 200;
  std::string spacing = "energy";
  std::vector<double> frequency_range;
  int seed = 1;

  template <class W = Wave> static Fields<W> fields() {
    return {
        {"name", &W::name, "-", "Name of the wave system.", true},
        {"type",
         &W::type,
         "-",
         "Regular wave, or the spectrum of an irregular one.",
         true,
         any_value,
         {"regular", "jonswap", "bretschneider", "pierson_moskowitz", "ochi_hubble", "table",
          "measured"}},
        {"height", &W::height, "m", "Height H of a regular wave, crest to trough.", false,
         at_least(0, 1e6)},
        {"period", &W::period, "s", "Period of a regular wave.", false, more_than(0, 1e6)},
        {"phase_deg", &W::phase, "deg",
         "Phase of a regular wave: its crest passes the origin when w t = -phase."},
        {"significant_height", &W::significant_height, "m", "Hs = 4 sqrt(m0).", false,
         at_least(0, 1e6)},
        {"peak_period", &W::peak_period, "s", "Period at which the spectrum is highest.", false,
         more_than(0, 1e6)},
        {"gamma", &W::gamma, "-", "Peak enhancement of JONSWAP.", false, between(1, 20)},
        {"shape", &W::shape, "-", "Shape l of Ochi-Hubble.", false, between(0.5, 20)},
        {"frequency", &W::frequency, "rad/s", "Frequencies of a table, ascending.", false,
         more_than(0)},
        {"density", &W::density, "m2 s/rad", "Spectral density S at these frequencies.", false,
         at_least(0)},
        {"file", &W::file, "-",
         "Measured elevation: text with commas, named columns time [s] and elevation [m]; relative "
         "to the case file."},
        {"time", &W::time, "s", "Times of a measured elevation, at equal steps; without a file."},
        {"elevation", &W::elevation, "m", "Measured elevation at these times."},
        {"point", &W::point, "m", "Where it was measured, [x, y]; the origin by default."},
        {"start", &W::start, "s", "Time since the first sample of the record at which t = 0.",
         false, at_least(0, longest_time)},
        {"taper", &W::taper, "s",
         "Time over which a record fades at both ends, where the waves before and after it, which "
         "also load the body, are not known; 30 s by default.",
         false, at_least(0, longest_time)},
        {"lost_variance", &W::lost_variance, "-",
         "Largest part of the variance that may lie outside the frequencies of the database and is "
         "left out; 0.02 by default for a record, 0.1 for a spectrum without frequency_range.",
         false, between(0, 1)},
        {"heading_deg", &W::heading, "deg", "Mean direction of travel; 0 = +x, 90 = +y.", false,
         between(-360, 360)},
        {"spreading", &W::spreading, "-",
         "Exponent s of the directional spreading cos^2s((theta - heading)/2), cut at +-90 deg; "
         "without it all waves travel along the heading.",
         false, between(0.5, 1000)},
        {"components", &W::components, "-", "Number of components of an irregular wave.", false,
         between(2, 100000)},
        {"spacing",
         &W::spacing,
         "-",
         "Bins of equal energy or of equal width in frequency; each has one component at a "
         "frequency drawn at random in its bin, so that the sea does not repeat.",
         false,
         any_value,
         {"energy", "frequency"}},
        {"frequency_range", &W::frequency_range, "rad/s",
         "Lowest and highest frequency; default: all but 0.1 % of the energy below and 0.5 % "
         "above, as far as the database reaches.",
         false, more_than(0)},
        {"seed", &W::seed, "-", "Seed of the random phases, frequencies and directions.", false,
         at_least(0)},
    };
  }
};

} // namespace hydrodae::sea
