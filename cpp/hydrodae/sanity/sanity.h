#pragma once
/// Findings on likely errors of a valid scene: masses in tonnes, a joint far from its body, a power
/// take-off along a locked motion, waves that would break. Nothing here refuses a scene.

#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::sanity {

/// Finding with the numbers that it is based on.
struct Finding {
  bool serious = false; ///< true: the result is probably not the intended one
  std::string text;
};

/// Bodies that share vertical loads (through joints, couplers, springs), and their lift.
struct FloatingGroup {
  std::vector<int> bodies;
  double weight = 0.0;    ///< weight downwards [N]
  double buoyancy = 0.0;  ///< buoyancy upwards in the reference pose [N]
  double load = 0.0;      ///< constant loads and pretensions upwards [N]
  double stiffness = 0.0; ///< heave stiffness of the hydrostatics of the whole group [N/m]
  double mooring = 0.0;   ///< heave stiffness of mooring matrices [N/m]
  bool wet = false;       ///< true: a body has hydrostatics
  bool held = false;      ///< true: something besides buoyancy carries it vertically

  /// Upward imbalance over the larger of weight and buoyancy [-].
  double imbalance() const;
};

/// Floating groups of an assembled system at its start.
std::vector<FloatingGroup> floating_groups(const system::System& system);

/// Text "bodies a, b: weight 1.2e6 N, buoyancy 1.2e6 N, floats freely".
std::string describe(const system::System& system, const FloatingGroup& group);

/// Findings on weight and buoyancy, radii of gyration and stability of free-floating bodies.
std::vector<Finding> look_at_bodies(const model::Scene& scene, const system::System& system);

/// Findings on places and coordinates: joints far from their bodies, points below the sea bed,
/// forces along locked motions, starts beyond stops, ropes stretched to several lengths.
std::vector<Finding> look_at_mechanism(const model::Scene& scene, const system::System& system);

/// Findings on the height of the waves relative to their length and the depth.
std::vector<Finding> look_at_sea(const model::Scene& scene);

/// Findings on waves that travel between the headings of the database.
std::vector<Finding> look_at_headings(const model::Scene& scene, const system::System& system);

/// Findings on the size and the freeboard of meshes.
std::vector<Finding> look_at_hulls(const model::Scene& scene);

/// Findings on the volume of chambers above water columns of the database.
std::vector<Finding> look_at_chambers(const model::Scene& scene);

/// All findings.
std::vector<Finding> look_over(const model::Scene& scene, const system::System& system);

/// Adds serious findings to the notes of the system.
void note_findings(const model::Scene& scene, system::System& system);

} // namespace hydrodae::sanity
