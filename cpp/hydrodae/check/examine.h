#pragma once
/// Parts of `examine`: cost of the elements of a scene, and coordinates that nothing moves.

#include <iosfwd>
#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::check {

/// Element with its unknowns and its share of the Jacobian's nonzeros.
struct ElementCost {
  std::string name;
  Index unknowns = 0;    ///< positions, velocities, memory states, norm multipliers
  Index multipliers = 0; ///< multipliers of constraint rows
  Index nonzeros = 0;    ///< entries in its rows and columns that belong to no earlier element
};

/// Costs of joints and constraints (nonzeros of their multipliers), then bodies, the radiation
/// memory, and direct couplings of bodies. The nonzeros add up to those of the Jacobian.
std::vector<ElementCost> element_costs(const system::Regime& regime,
                                       const system::Pattern& pattern);

/// Velocity coordinates (n_u,) that stay at zero: no acceleration, velocity or closing of a joint
/// ever reaches them in random motion along the moving or driven coordinates. Joints or symmetry
/// keep them at zero; a disturbance may break the symmetry. Empty if the accelerations cannot be
/// determined.
std::vector<bool> never_excited(const system::System& system, const system::Pattern& pattern);

/// Writes the size of the results file, and the memory of samples during a run.
/// @param width  values of a sample
void write_sizes(std::ostream& out, const model::Scene& scene, const system::Regime& regime,
                 std::size_t width);

/// Writes the first method of "auto", its reason, and the methods that follow; nothing for a named
/// method, or if a run could not start.
void write_method(std::ostream& out, const model::Scene& scene);

/// Writes weight and buoyancy of floating bodies, their rest in still water, and findings on the
/// scene, line by line (examine_sanity.cpp).
void write_sanity(std::ostream& out, const model::Scene& scene, const system::System& system);

} // namespace hydrodae::check
