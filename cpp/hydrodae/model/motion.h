#pragma once
/// Motion of each body: its free coordinates, and the hydrodynamic coordinates that move with them.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

inline constexpr std::array<std::string_view, 6> coordinate_names = hydro::rigid_dofs;

/// Free coordinates of a body: translations along the world axes, rotations about its own.
/// Throws ModelError (key "body.<name>.motion") on words that are unknown, doubled or mixed, and on
/// two free rotations: a body turns about no axis, one fixed axis, or all.
std::array<bool, 6> free_coordinates(const Body& body);

/// Body-axes velocities that can be nonzero: the free coordinates closed under rotation. A rotation
/// about y mixes surge and heave; with all rotations a free translation has parts along all axes.
std::array<bool, 6> moving_axes(const Body& body);

/// Returns whether any coordinate moves.
bool moves(const Body& body);

/// Name of a joint's coordinate in a constraint: the given one, or the first. The joint must exist
/// and have a motion.
std::string coordinate_of(const Scene& scene, const std::string& joint,
                          const std::optional<std::string>& coordinate);

/// Labels "<body>.<dof>" in the database of all moving hydrodynamic coordinates.
std::vector<std::string> moving_coordinates(const Scene& scene);

/// Exponential fit of the scene: the one named in [hydro], or the smallest one that covers the
/// moving coordinates. Null if the scene has no memory or nothing moves. Throws ModelError if the
/// fit does not exist or does not cover them.
const hydro::MemoryFit* memory_fit(const Scene& scene);

} // namespace hydrodae::model
