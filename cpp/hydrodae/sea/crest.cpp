#include "hydrodae/sea/crest.h"

#include <cmath>
#include <complex>

namespace hydrodae::sea {

std::optional<Fault> crest_fault(const Crest& crest) {
  if (!crest.place.empty() && crest.place.size() != 2)
    return Fault{"crest.place", "expected 'place' = [x, y] of the crest [m]"};
  return {};
}

void constrain(std::vector<Component>& components, const Crest& crest) {
  const auto angle = [&](const Component& c) {
    return c.omega * crest.time -
           c.wavenumber * (crest.x() * std::cos(c.heading) + crest.y() * std::sin(c.heading));
  };
  double m0 = 0.0, m2 = 0.0, eta = 0.0, rate = 0.0;
  for (const Component& c : components) {
    const double energy = 0.5 * c.amplitude * c.amplitude, here = angle(c) + c.phase;
    m0 += energy;
    m2 += c.omega * c.omega * energy;
    eta += c.amplitude * std::cos(here);
    rate -= c.amplitude * c.omega * std::sin(here);
  }
  for (Component& c : components) {
    const double energy = 0.5 * c.amplitude * c.amplitude, lag = angle(c);
    const std::complex<double> changed =
        std::polar(c.amplitude, lag + c.phase) +
        energy * std::complex<double>((crest.height - eta) / m0, c.omega * rate / m2);
    c.amplitude = std::abs(changed);
    c.phase = std::remainder(std::arg(changed) - lag, 2.0 * pi);
  }
}

} // namespace hydrodae::sea
