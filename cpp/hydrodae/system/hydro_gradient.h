#pragma once
/// Derivatives of the hydrodynamic velocities and accelerations (hydrodynamics.h) for the Jacobian.

#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

using Matrix63 = Eigen::Matrix<double, 6, 3>;

/// The block of a matrix (n_moving, n_moving) between two hydrodynamic bodies, zero where a
/// coordinate does not move.
inline Matrix6 hydro_block(const MatrixX& matrix, const HydroBody& i, const HydroBody& j) {
  Matrix6 block = Matrix6::Zero();
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n)
      if (i.moving[m] >= 0 && j.moving[n] >= 0)
        block(m, n) = matrix(i.moving[m], j.moving[n]);
  return block;
}

/// dU = U_phi dphi + U_v dv + U_w dw and dU' = a_phi dphi + a_v dv + a_w dw + a_acc d(v', w').
struct HydroMotionGradient {
  Matrix63 U_phi = Matrix63::Zero(), U_v = Matrix63::Zero(), U_w = Matrix63::Zero();
  Matrix63 a_phi = Matrix63::Zero(), a_v = Matrix63::Zero(), a_w = Matrix63::Zero();
  Matrix6 a_acc = Matrix6::Zero();
};

inline HydroMotionGradient hydro_motion_gradient(bool body_axes, const BodyState<double>& b) {
  HydroMotionGradient d;
  const Matrix3 wx = skew<double>(b.w), R_T = b.R.transpose();
  if (body_axes) {
    const Matrix3 Vx = skew<double>(R_T * b.v);
    d.U_phi.topRows<3>() = Vx;
    d.U_v.topRows<3>() = R_T;
    d.U_w.bottomRows<3>().setIdentity();
    d.a_phi.topRows<3>() = skew<double>(R_T * b.v_dot) - wx * Vx;
    d.a_v.topRows<3>() = -wx * R_T;
    d.a_w.topRows<3>() = Vx;
    d.a_acc.topLeftCorner<3, 3>() = R_T;
    d.a_acc.bottomRightCorner<3, 3>().setIdentity();
  } else {
    d.U_phi.bottomRows<3>() = -b.R * wx;
    d.U_v.topRows<3>().setIdentity();
    d.U_w.bottomRows<3>() = b.R;
    d.a_phi.bottomRows<3>() = -b.R * skew<double>(b.w_dot);
    d.a_acc.topLeftCorner<3, 3>().setIdentity();
    d.a_acc.bottomRightCorner<3, 3>() = b.R;
  }
  return d;
}

} // namespace hydrodae::system
