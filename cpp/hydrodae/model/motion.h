#pragma once
/// What each body can do: its free coordinates, and the hydrodynamic coordinates that move with
/// them.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/model/scene.h"

namespace hydrodae::model {

inline constexpr std::array<std::string_view, 6> coordinate_names = hydro::rigid_dofs;

/// Free coordinates of a body: translations along the world axes, rotations about its own.
/// Throws ModelError (key "body.<name>.motion") on words that are unknown, doubled or mixed, and on
/// two free rotations: a body turns about no axis, about one that stays, or about all.
std::array<bool, 6> free_coordinates(const Body& body);

/// The body-axes velocities that can be nonzero: the free coordinates closed under rotation. A turn
/// about y mixes surge and heave; with all rotations a free translation has parts along all axes.
std::array<bool, 6> moving_axes(const Body& body);

/// Does any coordinate move?
bool moves(const Body& body);

/// Name of the coordinate of a joint that a constraint means: the given one, else the first. The
/// joint must exist and have a motion.
std::string coordinate_of(const Scene& scene, const std::string& joint,
                          const std::optional<std::string>& coordinate);

/// Labels "<body>.<dof>" in the database of all hydrodynamic coordinates that move.
std::vector<std::string> moving_coordinates(const Scene& scene);

/// The exponential fit that the scene uses: the one named in [hydro], else the one with the fewest
/// states that covers the coordinates that move. Null if the scene asks for no memory or nothing
/// moves. Throws ModelError when there is no such fit or it does not cover them.
const hydro::MemoryFit* memory_fit(const Scene& scene);

} // namespace hydrodae::model
