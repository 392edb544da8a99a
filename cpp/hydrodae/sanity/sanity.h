#pragma once
/// What a scene that can be run may still have wrong: masses in tonnes, a joint far from its body,
/// a power take-off along a motion that is locked, waves that would break. Nothing here refuses.

#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/system.h"

namespace hydrodae::sanity {

/// One judgement, with the numbers that it was made from.
struct Finding {
  bool serious = false; ///< the answer of a run is hardly the one that was asked for
  std::string text;
};

/// Bodies that share vertical loads (through joints, couplers, springs), and what lifts them.
struct FloatingGroup {
  std::vector<int> bodies;
  double weight = 0.0;    ///< [N], downwards
  double buoyancy = 0.0;  ///< [N], upwards, in the reference pose
  double load = 0.0;      ///< [N], upwards: constant loads and pretensions
  double stiffness = 0.0; ///< of the hydrostatics against heave of the whole group [N/m]
  double mooring = 0.0;   ///< of mooring matrices, likewise [N/m]
  bool wet = false;       ///< some body has hydrostatics
  bool held = false;      ///< something else than buoyancy carries it vertically

  /// Upwards, over the larger of weight and buoyancy [-].
  double imbalance() const;
};

/// The groups that the start of an assembled system has.
std::vector<FloatingGroup> floating_groups(const system::System& system);

/// "bodies a, b: weight 1.2e6 N, buoyancy 1.2e6 N, floats freely".
std::string describe(const system::System& system, const FloatingGroup& group);

/// Findings on weight and buoyancy, radii of gyration and stability of what floats freely.
std::vector<Finding> look_at_bodies(const model::Scene& scene, const system::System& system);

/// Findings on places and coordinates: joints far from their bodies, points below the sea bed,
/// forces along motions that are locked, starts beyond stops, ropes stretched to several lengths.
std::vector<Finding> look_at_mechanism(const model::Scene& scene, const system::System& system);

/// Findings on the height of the waves against their length and the depth.
std::vector<Finding> look_at_sea(const model::Scene& scene);

/// Findings on waves that travel between the headings of the database.
std::vector<Finding> look_at_headings(const model::Scene& scene, const system::System& system);

/// Findings on the size and the freeboard of meshes.
std::vector<Finding> look_at_hulls(const model::Scene& scene);

/// All of them.
std::vector<Finding> look_over(const model::Scene& scene, const system::System& system);

/// Takes what is serious into the notes of the system.
void note_findings(const model::Scene& scene, system::System& system);

} // namespace hydrodae::sanity
