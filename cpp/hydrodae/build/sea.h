#pragma once
/// Sea of a scene, drawn once for all loads.

#include "hydrodae/model/scene.h"
#include "hydrodae/sea/kinematics.h"

namespace hydrodae::build {

struct Sea {
  /// Components of one wave of the scene.
  struct System {
    std::vector<sea::Component> components;
    std::string note; ///< note on their origin; "" if missing
  };
  std::vector<System> systems;
  std::vector<sea::Component> all; ///< components of all systems, in their order
  sea::WaveField field;            ///< all waves and the current, in water of the scene's depth
  std::shared_ptr<const sea::SecondOrder> second; ///< of gauges; null in a sea of first order
  std::string note;                               ///< what there is of second order; "" without
};

/// Throws ModelError if too much of a wave lies outside the frequencies of the database.
Sea draw_sea(const model::Scene& scene);

} // namespace hydrodae::build
