#pragma once
/// Static pose and linear model of a scene: what the frequency domain is made from.

#include <string>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::statics {

/// A force by which points or a body are held, at a pose at rest: ropes and lines (their points),
/// springs between two points, mooring matrices (the body).
struct Mooring {
  std::string name, type;
  std::vector<int> bodies;     ///< of each point, in LinearModel::bodies; -1: ground
  std::vector<Vector3> places; ///< of each point [m]; of a mooring matrix the centre of gravity
  VectorX load;                ///< forces on the points (3 n,) [N]; or force and moment (6,)
  MatrixX stiffness, damping;  ///< -d load / d places, over their rates (3 n, 3 n); or (6, 6) over
                               ///< the displacement from the reference pose, earth axes
  std::vector<std::string> channels, units; ///< what it reports beside its load
  VectorX values;
};

/// A scene at rest in its static equilibrium in still water, and its equations linearised there.
///
///   M xi'' + C xi' + K xi + T^T (hydrodynamic loads) = G^T dlambda + T^T f + F_z z,   G xi = 0
///   z' = A z + B xi + D xi'                        states of forces, from their starts
///
/// xi: virtual displacements, translations in world axes [m], rotations in body axes [rad]. Added
/// mass and radiation are left to the caller: their velocities are U = T xi'.
struct LinearModel {
  std::vector<std::string> coordinates; ///< (n_u,) "bodies/flap1/pitch"
  MatrixX mass, damping, stiffness;     ///< M, C, K (n_u, n_u), without hydrodynamics but C_hs
  MatrixX constraints;                  ///< G (n_lambda, n_u)
  MatrixX load_by_state;                ///< F_z (n_u, n_z)
  MatrixX state_by_state, state_by_xi, state_by_rate; ///< A, B, D (n_z, n_z), (n_z, n_u) twice
  std::vector<std::string> state_of;                  ///< (n_z,) forces whose states they are
  std::vector<std::string> hydro_labels;              ///< (m,) labels of the database that move
  MatrixX hydro_map;                                  ///< T (m, n_u)
  std::vector<double> hydro_yaws;                     ///< (m,) mean yaw of the body of each [rad]
  std::vector<Vector3> hydro_points;    ///< (m,) where that body stands in the equilibrium [m]
  std::vector<std::string> motions;     ///< (n_m,) "joints/hinge1/angle"
  MatrixX motion_map;                   ///< (n_m, n_u) of the joint coordinates
  std::vector<std::string> dampers;     ///< (n_d,) forces with damping along a joint coordinate
  std::vector<double> damper_damping;   ///< (n_d,) [N s/m or N m s]
  std::vector<double> damper_stiffness; ///< (n_d,) [N/m or N m]
  std::vector<double> damper_delay;     ///< (n_d,) [s]; where > 0, K holds k and C not c
  MatrixX damper_map;                   ///< (n_d, n_u) of their coordinates
  std::vector<std::string> reactions;   ///< (6 n_joints,) "joints/hinge1/reaction_force.x"
  MatrixX reaction_by_xi, reaction_by_lambda; ///< (6 n_joints, n_u), (6 n_joints, n_lambda)

  /// Points of the Morison elements (each [m]) and, for each, the load on the coordinates by the
  /// water's velocity (3), acceleration (3) and elevation (1): (n_u, 7).
  std::vector<Vector3> water_points;
  std::vector<MatrixX> water_loads;
  double water_depth = 0.0, gravity = 0.0; ///< [m], may be infinite; [m/s2]

  std::vector<std::string> bodies;
  std::vector<Vector3> offsets, rotations; ///< per body, from the reference pose [m], [rad]
  std::vector<Vector3> places;             ///< of the centres of gravity [m]
  std::vector<Mooring> moorings;
  VectorX reaction;                  ///< (6 n_joints,) in equilibrium [N], [N m]
  std::vector<std::string> supports; ///< "bodies/pile/support_force.x", of bodies held by axes
  VectorX support;                   ///< the same in equilibrium, world axes [N], [N m]
  std::vector<std::string> notes;
};

/// Throws ModelError when there is no equilibrium near the start of the scene.
LinearModel linearize(const model::Scene& scene);

/// Components of all wave systems of a scene, one a row: frequency [rad/s], heading [rad],
/// amplitude [m], phase [rad].
MatrixX wave_components(const model::Scene& scene);

} // namespace hydrodae::statics
