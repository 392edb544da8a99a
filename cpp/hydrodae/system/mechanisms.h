#pragma once
/// Mechanisms and groups of bodies. Tolerances, norms and guards are taken for each one separately,
/// so that a large mechanism does not hide an error in a small one.

#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// Numbers the mechanisms and the groups. A mechanism is a set of bodies connected by rows of
/// joints, couplers, stops or dry friction. A group is a set of mechanisms that act on each other
/// by forces or through the water. Fixed bodies and the ground connect nothing.
void find_mechanisms(System& system);

/// Joint of a motion; joint of a coupler (the first one, if several).
const JointData& joint_of(const System& system, int motion);
const JointData& joint_of(const System& system, const CouplerData& coupler);

/// Moving body of a joint, the second one if both move; null if neither moves.
const BodyData* moving_body(const System& system, const JointData& joint);

/// Last moving body of a port; null if none moves.
const BodyData* moving_body(const System& system, const PortData& port);

/// Mechanisms that the rows that now hold, drives included, leave no free motion.
std::vector<bool> guided_mechanisms(const Regime& regime);

/// Returns whether reactions neither do work nor press friction, and all states are rates. The
/// powers of all forces then follow from positions, velocities and states.
bool has_idle_reactions(const Regime& regime);

/// Sets the group of each position, velocity and memory state, and the blocks; needs the offsets in
/// y.
void set_groups(System& system);

} // namespace hydrodae::system
