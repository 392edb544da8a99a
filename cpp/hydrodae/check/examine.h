#pragma once
/// Parts of `examine`: what the elements of a scene cost, and which coordinates nothing moves.

#include <iosfwd>
#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::check {

/// One element with its unknowns and its share of the Jacobian's nonzeros.
struct ElementCost {
  std::string name;
  Index unknowns = 0;    ///< positions, velocities, memory states, norm multipliers
  Index multipliers = 0; ///< of constraint rows
  Index nonzeros = 0;    ///< entries in its rows and columns that belong to no element before it
};

/// Joints and constraints first (their nonzeros are those of their multipliers), then bodies, the
/// radiation memory, and what couples bodies directly. The nonzeros add up to those of the
/// Jacobian.
std::vector<ElementCost> element_costs(const system::Regime& regime,
                                       const system::Pattern& pattern);

/// Velocity coordinates (n_u,) that stay at zero: from the start, moved at random along those
/// coordinates alone that move or are driven, no acceleration, velocity or closing of a joint ever
/// reaches them. Joints or symmetry keep them at zero; a disturbance may break the symmetry.
/// Empty where the accelerations cannot be determined.
std::vector<bool> never_excited(const system::System& system, const system::Pattern& pattern);

/// Size of the results file, and the memory that samples take during a run.
/// @param width values of a sample
void write_sizes(std::ostream& out, const model::Scene& scene, const system::Regime& regime,
                 std::size_t width);

/// With which method "auto" begins, why, and which follow; nothing where a method is named, or a
/// run could not start.
void write_method(std::ostream& out, const model::Scene& scene);

/// Weight and buoyancy of what floats, where it rests in still water, and what looks wrong with the
/// scene, line by line (examine_sanity.cpp).
void write_sanity(std::ostream& out, const model::Scene& scene, const system::System& system);

} // namespace hydrodae::check
