#pragma once
/// The static pose of the whole constrained scene in still water.

#include "hydrodae/model/scene.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::statics {

/// Matrices of the equations linearised about a pose at rest, in virtual displacements xi (n_u,):
/// translations in world axes, rotations in body axes.
///
///   M xi'' + C xi' + K xi - G^T dlambda = 0,   G xi = 0
///
/// K holds the geometric stiffness of the reactions in `y`. Memory states of the radiation are left
/// out; states z of forces add F_z z to the loads, z' = A z + B xi + D xi'. Algebraic unknowns are
/// eliminated.
struct LinearMatrices {
  MatrixX mass, damping, stiffness;                   ///< M, C, K (n_u, n_u)
  MatrixX constraints;                                ///< G (n_lambda, n_u)
  MatrixX load_by_state;                              ///< F_z (n_u, n_z)
  MatrixX state_by_state, state_by_xi, state_by_rate; ///< A, B, D (n_z, n_z), (n_z, n_u) twice
  VectorX forces; ///< (n_u,) G^T lambda plus all loads: zero in equilibrium
};

/// At (t = 0, y, y' = 0); y must be at rest.
LinearMatrices linear_matrices(const system::Regime& regime, const system::Pattern& pattern,
                               const VectorX& y);

/// T (n_moving, n_u) of the hydrodynamic velocities U = T xi'.
MatrixX hydro_map(const system::Regime& regime, const system::Workspace<double>& workspace);

/// A scene at rest.
struct Rest {
  VectorX y;                               ///< with the reactions
  std::vector<system::Regime::Mode> modes; ///< (n_switches,) which stops hold
  std::string instability;                 ///< the note of it, where the pose is unstable
};

/// Newton's method on forces(q, lambda) = 0, g(q) = 0 from the start of the system, without waves.
/// States of forces, such as pressures, are held; dynamic lines are at rest; the motion is the
/// smallest along directions in which nothing holds a body. Moves the start of the system
/// there. An unstable pose is noted. Throws ModelError when there is no equilibrium near, or
/// velocities are given.
Rest move_to_equilibrium(system::System& system);

/// `move_to_equilibrium`, with the mean yaw of the hydrodynamic bodies that of the equilibrium.
Rest settle(const model::Scene& scene, system::System& system);

/// `build`, with the start moved to the equilibrium where the scene asks for it; what looks wrong
/// in the scene or its memory fit is noted.
system::System starting_system(const model::Scene& scene);

/// The same without a look at what may be wrong.
system::System bare_system(const model::Scene& scene);

} // namespace hydrodae::statics
