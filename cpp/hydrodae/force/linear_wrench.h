#pragma once
#include "hydrodae/core/types.h"

namespace hydrodae::force {

/// A force and moment that are linear in the displacement of a body from its reference pose.
///
///   W = W0 - K xi - C twist        [N; N m about the centre of gravity], earth axes
///
/// xi = [r - r_ref; rotation vector of R R_ref^T] [m; rad], twist = [v; w] in world axes
/// [m/s; rad/s]. Hydrostatics and mooring matrices are of this form.
struct LinearWrench {
  Vector6 constant = Vector6::Zero();
  Matrix6 stiffness = Matrix6::Zero();
  Matrix6 damping = Matrix6::Zero();

  template <class S> Vec6<S> apply(const Vec6<S>& xi, const Vec6<S>& twist) const {
    return constant.cast<S>() - stiffness.cast<S>() * xi - damping.cast<S>() * twist;
  }

  /// dW/dxi and dW/dtwist.
  void gradient(const Vector6&, const Vector6&, Matrix6& by_xi, Matrix6& by_twist) const {
    by_xi = -stiffness;
    by_twist = -damping;
  }

  /// Potential energy [J], zero in the reference pose; exact for symmetric K and rotation about one
  /// axis (the rotation vector is not an exact coordinate of a moment in earth axes otherwise).
  double potential(const Vector6& xi) const {
    return -constant.dot(xi) + 0.5 * xi.dot(stiffness * xi);
  }
};

} // namespace hydrodae::force
