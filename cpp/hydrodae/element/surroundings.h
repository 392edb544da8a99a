#pragma once
#include <cmath>

#include "hydrodae/sea/kinematics.h"

namespace hydrodae::element {

/// What surrounds the laws that are made with it (`list(forces, surroundings)`).
struct Surroundings {
  double gravity = 9.81; ///< [m/s2]
  double density = 0.0;  ///< of the water, 0 without water [kg/m3]
  sea::WaveField water;  ///< its depth, waves and current
};

} // namespace hydrodae::element
