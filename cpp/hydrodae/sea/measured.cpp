#include "hydrodae/sea/measured.h"

#include <cmath>
#include <complex>

#include "hydrodae/core/text.h"
#include "hydrodae/core/types.h"
#include "hydrodae/sea/dispersion.h"

namespace hydrodae::sea {

double Measured::significant_height() const {
  const Eigen::Map<const VectorX> eta(elevation.data(), static_cast<Index>(elevation.size()));
  return 4.0 * std::sqrt((eta.array() - eta.mean()).square().mean());
}

std::optional<Fault> Measured::record_fault() const {
  const std::string key = file ? "file" : "time";
  if (time.size() != elevation.size() || time.size() < 8)
    return Fault{key, "time and elevation must be of equal length, 8 samples or more"};
  for (std::size_t j = 1; j < time.size(); ++j)
    if (!(std::abs(time[j] - time[j - 1] - step()) <= 0.01 * step()))
      return Fault{key, "the record must have equal steps of time, " + number_text(step()) +
                            " s on the average; from " + number_text(time[j - 1]) + " s to " +
                            number_text(time[j]) + " s it has " +
                            number_text(time[j] - time[j - 1]) + " s"};
  return {};
}

std::optional<Fault> Measured::fault(double end_time) const {
  if (!file && time.empty() && elevation.empty())
    return Fault{"", "a measured wave needs 'file', or 'time' and 'elevation'"};
  if (const std::optional<Fault> fault = record_fault())
    return fault;
  if (!point.empty() && point.size() != 2)
    return Fault{"point", "expected [x, y] of the place of the measurement [m]"};
  if (start + end_time > length() * (1.0 + 1e-12))
    return Fault{file ? "file" : "time",
                 "the record is " + number_text(length()) + " s long; the run needs it from " +
                     number_text(start) + " s to " + number_text(start + end_time) +
                     " s (solver.end_time)"};
  if (2.0 * taper > length())
    return Fault{"taper", "the record is shorter than its two ends that fade"};
  return range_fault(frequency_range);
}

Sum Measured::components(const Site& site) const {
  const bool own = !frequency_range.empty();
  const double low = own ? frequency_range[0] : site.covered.low,
               high = own ? frequency_range[1] : site.covered.high;
  const std::size_t n = elevation.size();
  const double dt = step(), count = static_cast<double>(n);
  Sum out;
  double mean = 0.0, variance = 0.0, kept = 0.0;
  std::vector<double> x(n);
  double weights = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    const double t = dt * static_cast<double>(j), left = dt * static_cast<double>(n - 1 - j);
    x[j] = ramp(t, taper) * ramp(left, taper); // the weight
    weights += x[j];
    mean += x[j] * elevation[j];
  }
  mean /= weights;
  for (std::size_t j = 0; j < n; ++j) {
    x[j] *= elevation[j] - mean;
    variance += x[j] * x[j] / count;
  }
  std::vector<std::complex<double>> root(n); // e^{-2 pi i m / N}
  for (std::size_t m = 0; m < n; ++m)
    root[m] = std::polar(1.0, -2.0 * pi * static_cast<double>(m) / count);
  const double base = 2.0 * pi / (count * dt);
  const double along =
      point.empty() ? 0.0 : point[0] * std::cos(heading) + point[1] * std::sin(heading);
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
    const double wave_number = wavenumber(w, site.depth, site.gravity);
    const double phase = std::arg(sum) + w * start + wave_number * along;
    out.components.push_back({w, wave_number, heading, std::abs(sum), phase});
    kept += 0.5 * std::norm(sum);
  }
  out.lost = variance > 0.0 ? 1.0 - kept / variance : 0.0;
  out.range = number_text(low) + " to " + number_text(high) + " rad/s";
  if (!out.components.empty())
    out.note = "wave " + in_quotes(name) + ": mean " + number_text(mean) +
               " m of the record taken off, faded over " + number_text(taper) +
               " s at both ends; " + std::to_string(out.components.size()) + " components from " +
               number_text(out.components.front().omega) + " to " +
               number_text(out.components.back().omega) + " rad/s hold " +
               number_text(100.0 * (1.0 - out.lost)) + " % of its variance";
  return out;
}

} // namespace hydrodae::sea
