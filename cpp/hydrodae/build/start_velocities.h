#pragma once
/// Velocities at the start that keep the constraints closed.

#include <optional>
#include <vector>

#include "hydrodae/build/constraints.h"

namespace hydrodae::build {

/// Initial values of a body in the case, in world axes.
struct BodyStart {
  int body = 0;
  bool placed = false; ///< true: displacement or rotation are given
  std::optional<Vector3> velocity, angular_velocity;
};

/// Sets the velocities of y at its pose. Given velocities of bodies and rates of joints are kept.
/// The others follow from the constraints and their drives at t = 0, with the least kinetic energy
/// if several fit. Completed or projected values (digits that do not fit) are noted. Throws
/// ModelError with the body or joint whose velocity contradicts the constraints by more than 1e-3
/// of the largest given one.
void start_velocities(system::System& system, const std::vector<BodyStart>& given,
                      Constraints& constraints, VectorX& y);

} // namespace hydrodae::build
