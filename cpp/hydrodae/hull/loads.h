#pragma once
/// Nonlinear hydrostatic and Froude-Krylov loads: the pressure of still water and of the
/// undisturbed waves over the instantaneous wetted surface of a body.
///
///   F = -integral p n dS,   M = -integral p (x - r) x n dS,   p = -rho g z + p_dynamic
///
/// n points into the water, r is the body's origin; wet is what lies beneath the incident surface
/// z = eta(x, y, t), or beneath z = 0 without waves. Loads are [N] and [N m] in world axes.
///
/// In still water the loads of a mesh are exact and have the potential -rho g integral z dV over
/// the displaced volume. In waves the rule is of degree 2 on each triangle.

#include "hydrodae/hull/wet_surface.h"

namespace hydrodae::hull {

/// Both parts are taken over the same wetted surface; above z = 0 only their sum has a meaning.
struct Loads {
  Vector6 hydrostatic = Vector6::Zero(); ///< load of the pressure -rho g z
  Vector6 dynamic = Vector6::Zero();     ///< load of the wave pressure (Froude-Krylov)
};

/// @param gradient if not null, gets the derivative of the whole load by the pose: columns
/// displacement of the body's origin [N/m, N], then rotation vector, both in world axes. It is the
/// derivative of the sums that this function forms, the motion of the clipped corners included.
Loads loads(const Mesh& mesh, const WaveField& field, const Pose& pose, const Instant& instant,
            Workspace& work, Matrix6* gradient = nullptr);

} // namespace hydrodae::hull
