#pragma once
/// A measured elevation as a sum of wave components.

#include "hydrodae/sea/components.h"

namespace hydrodae::sea {

/// Harmonics w_n = 2 pi n / (N dt) of the record of a measured wave whose frequencies lie within
/// [low, high]. The mean (with the weights of the faded ends) is taken off, and both ends fade over
/// `taper` (the polynomial of the ramp), since the record has no data beyond them, which waves
/// ahead of their excitation would need. The phases refer to the origin and to t = 0 at `start` of
/// the record. O(N) for each harmonic.
struct RecordComponents {
  std::vector<Component> components;
  double mean = 0.0;     ///< that was taken off [m]
  double variance = 0.0; ///< of the faded record [m2]
  double kept = 0.0;     ///< part of it in the components [-]
};
RecordComponents record_components(const Wave& wave, double depth, double gravity, double low,
                                   double high);

/// Time step of the record [s].
double record_step(const Wave& wave);

} // namespace hydrodae::sea
