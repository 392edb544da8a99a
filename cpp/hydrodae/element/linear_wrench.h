#pragma once
#include "hydrodae/element/elements.h"

namespace hydrodae::element {

/// Force and moment, linear in the displacement of a body from its reference pose.
///
///   W = W0 - K xi - C twist        [N; N m about the centre of gravity], earth axes
///
/// xi = [r - r_ref; rotation vector of R R_ref^T] [m; rad], twist = [v; w] in world axes
/// [m/s; rad/s]. Hydrostatics and mooring matrices are of this form.
struct LinearWrench {
  Vector6 constant = Vector6::Zero();
  Matrix6 stiffness = Matrix6::Zero();
  Matrix6 damping = Matrix6::Zero();

  template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
    const Eigen::Map<const Vec6<S>> xi(in.x), twist(in.v);
    Eigen::Map<Vec6<S>> load(out.load);
    load = constant.cast<S>() - stiffness.cast<S>() * xi - damping.cast<S>() * twist;
  }

  template <class J> void jacobian(const In<double>&, J& j) const { j << -stiffness, -damping; }

  /// Potential energy [J], zero in the reference pose; exact for symmetric K and rotation about one
  /// axis (the rotation vector is not an exact coordinate of a moment in earth axes otherwise).
  double energy(const In<double>& in) const {
    const Eigen::Map<const Vector6> xi(in.x);
    return -constant.dot(xi) + 0.5 * xi.dot(stiffness * xi);
  }
};

} // namespace hydrodae::element
