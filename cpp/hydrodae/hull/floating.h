#pragma once
/// Displaced volume and water plane of a body in still water.

#include "hydrodae/hull/wet_surface.h"

namespace hydrodae::hull {

/// Integrals over the displaced volume and over the water plane at z = 0. x, y are world axes from
/// the body's origin.
struct Floating {
  double volume = 0.0;                 ///< V [m3]
  Vector3 buoyancy = Vector3::Zero();  ///< centre of V relative to the body's origin [m]
  double wetted_area = 0.0;            ///< [m2]
  double plane_area = 0.0;             ///< A [m2]
  double plane_x = 0.0, plane_y = 0.0; ///< integrals of x and y over the water plane [m3]
  double plane_xx = 0.0, plane_xy = 0.0, plane_yy = 0.0; ///< integrals of x^2, x y, y^2 [m4]

  /// Buoyancy part of the stiffness about the body's origin, rows heave, roll, pitch: minus the
  /// derivative of the loads of still water by the pose [N/m, N, N m].
  Matrix3 stiffness(double weight) const;
};

/// Exact for the mesh; all zero for a body in the air. By Gauss's theorem with the lid at z = 0,
/// from integrals over the wet surface: A = -integral n_z dS, V = integral z n_z dS, ...
/// @param still a field without waves
Floating floating(const Mesh& mesh, const WaveField& still, const Pose& pose, Workspace& work);

/// Floating properties in the reference pose of the body.
/// @param origin  origin of the body, above still water and in its axes
Floating floating_in_reference_pose(const Mesh& mesh, const Vector3& origin);

} // namespace hydrodae::hull
