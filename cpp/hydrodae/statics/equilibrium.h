#pragma once
/// Static pose of the constrained scene in still water.

#include "hydrodae/model/scene.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::statics {

/// Matrices of the equations linearised about a pose at rest, in virtual displacements xi (n_u,):
/// translations in world axes, rotations in body axes.
///
///   M xi'' + C xi' + K xi - G^T dlambda = 0,   G xi = 0
///
/// K contains the geometric stiffness of the reactions in `y`. Memory states of the radiation are
/// omitted; states z of forces add F_z z to the loads, z' = A z + B xi + D xi'. Algebraic unknowns
/// are eliminated.
struct LinearMatrices {
  MatrixX mass, damping, stiffness;                   ///< M, C, K (n_u, n_u)
  MatrixX constraints;                                ///< G (n_lambda, n_u)
  MatrixX load_by_state;                              ///< F_z (n_u, n_z)
  MatrixX state_by_state, state_by_xi, state_by_rate; ///< A, B, D (n_z, n_z), (n_z, n_u) twice
  VectorX forces; ///< (n_u,) G^T lambda plus all loads: zero in equilibrium
};

/// Matrices at (t = 0, y, y' = 0); y must be at rest.
LinearMatrices linear_matrices(const system::Regime& regime, const system::Pattern& pattern,
                               const VectorX& y);

/// Map T (n_moving, n_u) of the hydrodynamic velocities U = T xi'.
MatrixX hydro_map(const system::Regime& regime, const system::Workspace<double>& workspace);

/// Scene at rest.
struct Rest {
  VectorX y;                               ///< pose with the reactions
  std::vector<system::Regime::Mode> modes; ///< (n_switches,) states of the switches
  std::string instability;                 ///< note on an unstable pose; empty: stable
};

/// Moves the start of the system to the equilibrium: Newton's method on forces(q, lambda) = 0, g(q)
/// = 0 from the start, without waves. States of forces, such as pressures, are constant; dynamic
/// lines are at rest; the motion is smallest along directions in which nothing holds a body. An
/// unstable pose is noted. Throws ModelError if no equilibrium is near, or velocities are given.
Rest move_to_equilibrium(system::System& system);

/// Calls `move_to_equilibrium`, with the mean yaw of the hydrodynamic bodies from the equilibrium.
Rest settle(const model::Scene& scene, system::System& system);

/// Calls `build`, moves the start to the equilibrium if the scene requests it, and notes findings
/// on the scene and its memory fit.
system::System starting_system(const model::Scene& scene);

/// System without the findings.
system::System bare_system(const model::Scene& scene);

} // namespace hydrodae::statics
