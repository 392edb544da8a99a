#pragma once
/// Wave spectra S(w) [m2 s/rad].

#include <functional>
#include <vector>

namespace hydrodae::sea {

/// A spectrum with its running integral, on a fine grid. Between grid points S is a straight line.
struct Spectrum {
  std::vector<double> omega;      ///< [rad/s], ascending
  std::vector<double> density;    ///< S [m2 s/rad]
  std::vector<double> cumulative; ///< integral of S from the first frequency [m2]
  double m0 = 0.0;                ///< total energy [m2], including that beyond the grid
  bool ends = false;              ///< true: no energy beyond the grid

  /// Energy below w [m2], and its inverse [rad/s].
  double energy_below(double w) const;
  double frequency_at(double energy) const;
  double operator()(double w) const;
};

/// Spectrum given point by point.
Spectrum spectrum_of_points(std::vector<double> omega, std::vector<double> density);

/// Spectrum of a shape S(w / wp), up to a factor, whose tail falls as w^-n.
/// @param tail  integral beyond a point far above the peak, relative to w S there: 1 / (n - 1)
Spectrum spectrum_of_shape(const std::function<double(double)>& shape, double tail,
                           double significant_height, double peak_period);

/// Shape w^-5 exp(-5/4 w^-4) gamma^exp(-(w - 1)^2 / (2 s^2)), s = 0.07 below 1 and 0.09 above.
double jonswap_shape(double x, double gamma);

/// w^-(4l+1) exp(-(l + 1/4) w^-4).
double ochi_hubble_shape(double x, double l);

} // namespace hydrodae::sea
