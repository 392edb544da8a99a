#include "hydrodae/sea/record.h"

#include <cmath>
#include <complex>

#include "hydrodae/sea/dispersion.h"

namespace hydrodae::sea {

double record_step(const Wave& wave) {
  return (wave.time.back() - wave.time.front()) / static_cast<double>(wave.time.size() - 1);
}

RecordComponents record_components(const Wave& wave, double depth, double gravity, double low,
                                   double high) {
  const std::size_t n = wave.elevation.size();
  const double dt = record_step(wave), count = static_cast<double>(n);
  RecordComponents out;
  std::vector<double> x(n);
  double weights = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    const double t = dt * static_cast<double>(j), left = dt * static_cast<double>(n - 1 - j);
    x[j] = ramp(t, wave.taper) * ramp(left, wave.taper); // the weight
    weights += x[j];
    out.mean += x[j] * wave.elevation[j];
  }
  out.mean /= weights;
  for (std::size_t j = 0; j < n; ++j) {
    x[j] *= wave.elevation[j] - out.mean;
    out.variance += x[j] * x[j] / count;
  }
  std::vector<std::complex<double>> root(n); // e^{-2 pi i m / N}
  for (std::size_t m = 0; m < n; ++m)
    root[m] = std::polar(1.0, -2.0 * pi * static_cast<double>(m) / count);
  const double base = 2.0 * pi / (count * dt);
  const Vector3 point(wave.point.empty() ? 0.0 : wave.point[0],
                      wave.point.empty() ? 0.0 : wave.point[1], 0.0);
  const double along = point[0] * std::cos(wave.heading) + point[1] * std::sin(wave.heading);
  constexpr double slack = 1e-9; // of the ends of the band
  const auto first = static_cast<std::size_t>(std::max(1.0, std::ceil(low / base * (1 - slack))));
  for (std::size_t k = first; 2 * k < n; ++k) {
    const double w = base * static_cast<double>(k);
    if (w > high * (1.0 + slack))
      break;
    std::complex<double> sum = 0.0;
    for (std::size_t j = 0, m = 0; j < n; ++j) {
      sum += x[j] * root[m];
      m += k;
      if (m >= n)
        m -= n;
    }
    sum *= 2.0 / count;
    const double wave_number = wavenumber(w, depth, gravity);
    const double phase = std::arg(sum) + w * wave.start + wave_number * along;
    out.components.push_back({w, wave_number, wave.heading, std::abs(sum), phase});
    out.kept += 0.5 * std::norm(sum);
  }
  out.kept = out.variance > 0.0 ? out.kept / out.variance : 1.0;
  return out;
}

} // namespace hydrodae::sea
