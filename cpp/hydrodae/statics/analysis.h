#pragma once
/// Static pose and linear model of a scene, for the frequency domain.

#include <string>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::statics {

/// Force that holds points or a body, at a pose at rest: ropes and lines (their points), springs
/// between two points, mooring matrices (the body).
struct Mooring {
  std::string name, type;
  std::vector<int> bodies; ///< body of each point, index in LinearModel::bodies; -1: ground
  /// Place of each point [m]; for a mooring matrix, the centre of gravity
  std::vector<Vector3> places;
  VectorX load; ///< forces on the points (3 n,) [N]; or force and moment (6,)
  /// Derivatives -d load / d places and by their rates (3 n, 3 n); for a matrix (6, 6) by the
  /// displacement from the reference pose, earth axes
  MatrixX stiffness, damping;
  std::vector<std::string> channels, units; ///< reported channels besides the load
  VectorX values;
};

/// Scene in static equilibrium in still water, with its equations linearised there.
///
///   M xi'' + C xi' + K xi + T^T (hydrodynamic loads) = G^T dlambda + T^T f + F_z z,   G xi = 0
///   z' = A z + B xi + D xi'                        states of forces, from their starts
///
/// xi: virtual displacements, translations in world axes [m], rotations in body axes [rad]. The
/// caller adds added mass and radiation, with the velocities U = T xi'.
struct LinearModel {
  std::vector<std::string> coordinates; ///< (n_u,) "bodies/flap1/pitch"
  MatrixX mass, damping, stiffness;     ///< M, C, K (n_u, n_u), without hydrodynamics but C_hs
  MatrixX constraints;                  ///< G (n_lambda, n_u)
  MatrixX load_by_state;                ///< F_z (n_u, n_z)
  MatrixX state_by_state, state_by_xi, state_by_rate; ///< A, B, D (n_z, n_z), (n_z, n_u) twice
  std::vector<std::string> state_of;                  ///< (n_z,) name of the force of each state
  /// (m,) labels of the moving coordinates in the database
  std::vector<std::string> hydro_labels;
  MatrixX hydro_map; ///< T (m, n_u)
  /// (m,) mean yaw of the body of each label [rad]
  std::vector<double> hydro_yaws;
  std::vector<Vector3> hydro_points;    ///< (m,) place of that body in equilibrium [m]
  std::vector<std::string> motions;     ///< (n_m,) "joints/hinge1/angle"
  MatrixX motion_map;                   ///< (n_m, n_u) map to the joint coordinates
  std::vector<std::string> dampers;     ///< (n_d,) forces with damping along a joint coordinate
  std::vector<double> damper_damping;   ///< (n_d,) [N s/m or N m s]
  std::vector<double> damper_stiffness; ///< (n_d,) [N/m or N m]
  std::vector<double> damper_delay;     ///< (n_d,) [s]; where > 0, K holds k and C not c
  MatrixX damper_map;                   ///< (n_d, n_u) map to their coordinates
  std::vector<std::string> reactions;   ///< (6 n_joints,) "joints/hinge1/reaction_force.x"
  MatrixX reaction_by_xi, reaction_by_lambda; ///< (6 n_joints, n_u), (6 n_joints, n_lambda)

  /// Points of the Morison elements [m] and, for each, the load on the coordinates by the water's
  /// velocity (3), acceleration (3) and elevation (1): (n_u, 7).
  std::vector<Vector3> water_points;
  std::vector<MatrixX> water_loads;
  double water_depth = 0.0, gravity = 0.0; ///< [m], may be infinite; [m/s2]

  std::vector<std::string> bodies;
  /// Displacement of each body from the reference pose [m], [rad]
  std::vector<Vector3> offsets, rotations;
  std::vector<Vector3> places; ///< centres of gravity [m]
  std::vector<Mooring> moorings;
  VectorX reaction; ///< (6 n_joints,) in equilibrium [N], [N m]
  /// "bodies/pile/support_force.x", for bodies with locked coordinates
  std::vector<std::string> supports;
  VectorX support; ///< support loads in equilibrium, world axes [N], [N m]
  std::vector<std::string> notes;
};

/// Throws ModelError if there is no equilibrium near the start of the scene.
LinearModel linearize(const model::Scene& scene);

/// Components of all wave systems of a scene, one a row: frequency [rad/s], heading [rad],
/// amplitude [m], phase [rad].
MatrixX wave_components(const model::Scene& scene);

} // namespace hydrodae::statics
