#pragma once
#include <cmath>

namespace hydrodae::sea {

/// Wave component eta(x, y, t) = amplitude cos(w t - k (x cos heading + y sin heading) + phase)
struct Component {
  double omega = 0.0;      ///< [rad/s]
  double wavenumber = 0.0; ///< [rad/m]
  double heading = 0.0;    ///< direction of travel [rad]
  double amplitude = 0.0;  ///< [m]
  double phase = 0.0;      ///< [rad]
};

/// Range of frequencies [rad/s].
struct Band {
  double low = 0.0, high = INFINITY;
};

/// Growth of the waves at the start: 0 for t <= 0, 1 for t >= duration, between them the polynomial
/// of degree 7 with three vanishing derivatives at both ends. Without duration 1 at all times.
double ramp(double t, double duration);

} // namespace hydrodae::sea
