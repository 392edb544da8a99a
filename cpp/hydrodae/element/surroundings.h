#pragma once
#include <cmath>
#include <memory>

#include "hydrodae/math/smooth_table.h"
#include "hydrodae/sea/kinematics.h"

namespace hydrodae::element {

/// Environment of the laws that are made with it (`list(forces, surroundings)`).
struct Surroundings {
  double gravity = 9.81; ///< [m/s2]
  double density = 0.0;  ///< density of the water [kg/m3]; 0 without water
  sea::WaveField water;  ///< depth, waves and current of the water
  std::shared_ptr<const SmoothTable>
      seabed; ///< z over x and y [m]; null: at the depth of the water
};

} // namespace hydrodae::element
