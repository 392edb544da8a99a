#pragma once
/// Velocities at the start that keep the constraints closed.

#include <optional>
#include <vector>

#include "hydrodae/build/constraints.h"

namespace hydrodae::build {

/// What the case says of a body at the start, in world axes.
struct BodyStart {
  int body = 0;
  bool placed = false; ///< displacement or rotation are given
  std::optional<Vector3> velocity, angular_velocity;
};

/// Velocities of y at its pose. What the case gives (velocities of bodies, rates of joints) is
/// kept; the others follow from the constraints and their drives at t = 0, and where these leave a
/// choice, the kinetic energy is the least. What was completed, or projected
/// because its digits do not fit, is noted. Throws ModelError naming the body or joint whose
/// velocity contradicts the constraints by more than 1e-3 of the largest one given.
void start_velocities(system::System& system, const std::vector<BodyStart>& given,
                      Constraints& constraints, VectorX& y);

} // namespace hydrodae::build
