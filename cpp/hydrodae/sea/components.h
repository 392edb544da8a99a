#pragma once
/// A sea as a sum of plane waves.

#include <cmath>
#include <string>
#include <vector>

#include "hydrodae/sea/wave.h"

namespace hydrodae::sea {

/// eta(x, y, t) = amplitude cos(w t - k (x cos heading + y sin heading) + phase)
struct Component {
  double omega = 0.0;      ///< [rad/s]
  double wavenumber = 0.0; ///< [rad/m]
  double heading = 0.0;    ///< direction of travel [rad]
  double amplitude = 0.0;  ///< [m]
  double phase = 0.0;      ///< [rad]
};

/// Frequencies that something covers [rad/s].
struct Band {
  double low = 0.0, high = INFINITY;
};

/// Components of one wave system, not of a measured one (record.h). Irregular: one in each bin of
/// the spectrum, with the energy of its bin and a frequency drawn in it (uniformly in energy or in
/// frequency), a random phase, and a direction from the spreading. Draws, in this order for each
/// bin: frequency, phase; then, with spreading, one start u of the sequence frac(u + i (sqrt(5) -
/// 1)/2) that is mapped to directions.
/// @param depth, gravity [m], [m/s2]
/// @param note if not null, gets a sentence on what part of the energy the components hold
/// @param covered an irregular wave without a frequency range of its own is cut to these [rad/s]
/// @param lost if not null, gets the part of the variance that this cut leaves out, beyond what is
/// left out without it [-]
std::vector<Component> components(const Wave& wave, double depth, double gravity,
                                  std::string* note = nullptr, const Band& covered = {},
                                  double* lost = nullptr);

/// Growth of the waves at the start: 0 for t <= 0, 1 for t >= duration, between them the polynomial
/// of degree 7 with three vanishing derivatives at both ends. Without duration 1 at all times.
double ramp(double t, double duration);

} // namespace hydrodae::sea
