#pragma once
/// Which bodies belong together. What goes wrong in one mechanism must not hide behind the size of
/// another: tolerances, norms and guards are taken for each by itself.

#include "hydrodae/system/regime.h"

namespace hydrodae::system {

/// Numbers the mechanisms (bodies that rows of joints, couplers, stops or dry friction hold to each
/// other) and the groups (mechanisms that act on each other by forces or through the water).
/// Bodies that cannot move, and the ground, join nothing.
void find_mechanisms(System& system);

/// The joint that a coordinate measures, and that a coupler acts on (its first, if several).
const JointData& joint_of(const System& system, int motion);
const JointData& joint_of(const System& system, const CouplerData& coupler);

/// Of the bodies that a joint joins one that moves, the second if both do; null if neither.
const BodyData* moving_body(const System& system, const JointData& joint);

/// The last body of a port that moves.
const BodyData* moving_body(const System& system, const PortData& port);

/// By mechanism: do the rows that hold now, those of drives among them, leave it no motion of its
/// own?
std::vector<bool> guided_mechanisms(const Regime& regime);

/// Do reactions neither do work nor press friction, and are all states rates? Then the powers of
/// all forces follow from positions, velocities and states.
bool has_idle_reactions(const Regime& regime);

/// The group of each position, velocity and memory state, and the blocks; needs their offsets.
void set_groups(System& system);

} // namespace hydrodae::system
