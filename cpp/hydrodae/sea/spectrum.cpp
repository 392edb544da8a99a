#include "hydrodae/sea/spectrum.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/types.h"

namespace hydrodae::sea {
namespace {

/// Cell of an ascending grid that holds x; 0 <= result <= size - 2.
std::size_t cell(const std::vector<double>& grid, double x) {
  const auto above = std::upper_bound(grid.begin() + 1, grid.end() - 1, x);
  return static_cast<std::size_t>(above - grid.begin()) - 1;
}

void integrate(Spectrum& s) {
  s.cumulative.assign(s.omega.size(), 0.0);
  for (std::size_t i = 1; i < s.omega.size(); ++i)
    s.cumulative[i] = s.cumulative[i - 1] +
                      0.5 * (s.omega[i] - s.omega[i - 1]) * (s.density[i] + s.density[i - 1]);
}

} // namespace

Spectrum spectrum_of_points(std::vector<double> omega, std::vector<double> density) {
  Spectrum s;
  s.omega = std::move(omega);
  s.density = std::move(density);
  s.ends = true;
  integrate(s);
  s.m0 = s.cumulative.back();
  return s;
}

Spectrum spectrum_of_shape(const std::function<double(double)>& shape, double tail,
                           double significant_height, double peak_period) {
  Spectrum s;
  const double wp = 2.0 * pi / peak_period;
  constexpr int points = 20000;
  constexpr double lowest = 0.2, highest = 20.0; // times wp; S(0.2 wp) < exp(-460)
  for (int i = 0; i <= points; ++i) {
    const double x = lowest * std::exp(std::log(highest / lowest) * i / points);
    s.omega.push_back(x * wp);
    s.density.push_back(shape(x));
  }
  integrate(s);
  const double whole = s.cumulative.back() + tail * s.omega.back() * s.density.back();
  s.m0 = significant_height * significant_height / 16.0;
  for (double& value : s.density)
    value *= s.m0 / whole;
  for (double& value : s.cumulative)
    value *= s.m0 / whole;
  return s;
}

double jonswap_shape(double x, double gamma) {
  const double x4 = x * x * x * x;
  double s = std::exp(-1.25 / x4) / (x * x4);
  if (gamma != 1.0 && s > 0.0) {
    const double width = x <= 1.0 ? 0.07 : 0.09, d = (x - 1.0) / width;
    s *= std::pow(gamma, std::exp(-0.5 * d * d));
  }
  return s;
}

double ochi_hubble_shape(double x, double l) {
  return std::exp(-(4.0 * l + 1.0) * std::log(x) - (l + 0.25) * std::pow(x, -4.0));
}

double Spectrum::operator()(double w) const {
  if (w < omega.front() || w > omega.back())
    return 0.0;
  const std::size_t i = cell(omega, w);
  const double x = (w - omega[i]) / (omega[i + 1] - omega[i]);
  return (1.0 - x) * density[i] + x * density[i + 1];
}

double Spectrum::energy_below(double w) const {
  if (w <= omega.front())
    return 0.0;
  if (w >= omega.back())
    return cumulative.back();
  const std::size_t i = cell(omega, w);
  return cumulative[i] + 0.5 * (w - omega[i]) * (density[i] + (*this)(w));
}

double Spectrum::frequency_at(double energy) const {
  const std::size_t i = cell(cumulative, energy);
  const double h = omega[i + 1] - omega[i], slope = (density[i + 1] - density[i]) / h;
  // energy - E_i = S_i d + slope d^2 / 2, in the form that does not cancel
  const double e = std::max(energy - cumulative[i], 0.0), s = density[i];
  const double root = std::sqrt(std::max(s * s + 2.0 * slope * e, 0.0));
  return omega[i] + (s + root > 0.0 ? std::min(2.0 * e / (s + root), h) : 0.0);
}

} // namespace hydrodae::sea
