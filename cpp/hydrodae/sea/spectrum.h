#pragma once
/// Wave spectra S(w) [m2 s/rad].

#include "hydrodae/sea/wave.h"

namespace hydrodae::sea {

/// A spectrum with its running integral, on a fine grid. Between grid points S is a straight line.
struct Spectrum {
  std::vector<double> omega;      ///< [rad/s], ascending
  std::vector<double> density;    ///< S [m2 s/rad]
  std::vector<double> cumulative; ///< integral of S from the first frequency [m2]
  double m0 = 0.0;                ///< the whole energy [m2], also what lies beyond the grid

  /// Energy below w [m2], and its inverse [rad/s].
  double energy_below(double w) const;
  double frequency_at(double energy) const;
  double operator()(double w) const;
};

/// Spectrum of an irregular wave; m0 = Hs^2/16, or as given by the table. `gravity` [m/s2] is for
/// Pierson-Moskowitz.
Spectrum spectrum(const Wave& wave, double gravity);

/// Peak frequency of a spectrum that has one [rad/s].
double peak_frequency(const Wave& wave, double gravity);

} // namespace hydrodae::sea
