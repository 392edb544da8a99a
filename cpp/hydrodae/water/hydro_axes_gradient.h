#pragma once
/// Derivatives of the hydrodynamic velocities, accelerations and loads (hydro_axes.h).

#include "hydrodae/water/hydro_axes.h"

namespace hydrodae::water {

using Matrix63 = Eigen::Matrix<double, 6, 3>;

/// Yaw with the derivative of s by dphi: s = (0, g_y, g_z)/(g_y^2 + g_z^2), g = R^T e_z,
/// dg = [g] dphi.
struct YawGradient {
  Matrix3 H, s_phi;
  Vector3 s, rate_phi; ///< rate_phi: derivative of psi' = s.w
  double rate = 0.0;
};
inline YawGradient yaw_gradient(const element::BodyState<double>& b) {
  const Yaw<double> psi = yaw<double>(b);
  const Vector3 g = b.R.row(2).transpose();
  const Eigen::Vector2d q = g.tail<2>();
  const double m = q.squaredNorm();
  Matrix3 by_g = Matrix3::Zero();
  by_g.bottomRightCorner<2, 2>() =
      (m * Eigen::Matrix2d::Identity() - 2.0 * q * q.transpose()) / (m * m);
  YawGradient d{psi.H, by_g * skew<double>(g), psi.s, Vector3::Zero(), psi.s.dot(b.w)};
  d.rate_phi = d.s_phi.transpose() * b.w;
  return d;
}

/// Rotation by the mean yaw.
inline Matrix3 mean_turn(const HydroBody& hb) {
  Matrix3 H = Matrix3::Identity();
  H.topLeftCorner<2, 2>() << hb.cos_yaw, -hb.sin_yaw, hb.sin_yaw, hb.cos_yaw;
  return H;
}

/// Matrix L from forces along the hydrodynamic axes to the load on the body; U = L^T u.
inline Matrix6 hydro_axes(HydroAxes axes, const HydroBody& hb,
                          const element::BodyState<double>& b) {
  Matrix6 L = Matrix6::Identity();
  if (axes == HydroAxes::body) {
    L.topLeftCorner<3, 3>() = b.R;
  } else if (axes == HydroAxes::yaw) {
    const Matrix3 H = yaw<double>(b).H;
    L.topLeftCorner<3, 3>() = H;
    L.bottomRightCorner<3, 3>() = b.R.transpose() * H;
  } else if (hb.turned) {
    const Matrix3 H = mean_turn(hb);
    L.topLeftCorner<3, 3>() = H;
    L.bottomRightCorner<3, 3>() = b.R.transpose() * H;
  } else {
    L.bottomRightCorner<3, 3>() = b.R.transpose();
  }
  return L;
}

/// Derivatives dU = U_phi dphi + U_v dv + U_w dw and dU' = a_phi dphi + a_v dv + a_w dw + a_acc
/// d(v', w').
struct HydroMotionGradient {
  Matrix63 U_phi = Matrix63::Zero(), U_v = Matrix63::Zero(), U_w = Matrix63::Zero();
  Matrix63 a_phi = Matrix63::Zero(), a_v = Matrix63::Zero(), a_w = Matrix63::Zero();
  Matrix6 a_acc;
};

inline HydroMotionGradient hydro_motion_gradient(HydroAxes axes, const HydroBody& hb,
                                                 const element::BodyState<double>& b) {
  HydroMotionGradient d;
  d.a_acc = hydro_axes(axes, hb, b).transpose();
  const Matrix3 wx = skew<double>(b.w), R_T = b.R.transpose();
  if (axes == HydroAxes::body) {
    const Matrix3 Vx = skew<double>(R_T * b.v);
    d.U_phi.topRows<3>() = Vx;
    d.U_v.topRows<3>() = R_T;
    d.U_w.bottomRows<3>().setIdentity();
    d.a_phi.topRows<3>() = skew<double>(R_T * b.v_dot) - wx * Vx;
    d.a_v.topRows<3>() = -wx * R_T;
    d.a_w.topRows<3>() = Vx;
  } else if (axes == HydroAxes::yaw) {
    const YawGradient psi = yaw_gradient(b);
    const Matrix3 H_T = psi.H.transpose(), T = H_T * b.R, up = skew<double>(Vector3::UnitZ());
    const Vector3 V = H_T * b.v, W = T * b.w;
    d.U_phi.topRows<3>() = -up * V * psi.s.transpose();
    d.U_phi.bottomRows<3>() = -up * W * psi.s.transpose() - T * wx;
    d.U_v.topRows<3>() = H_T;
    d.U_w.bottomRows<3>() = T;
    d.a_phi.topRows<3>() = -up * (H_T * b.v_dot) * psi.s.transpose() -
                           up * V * psi.rate_phi.transpose() - psi.rate * up * d.U_phi.topRows<3>();
    d.a_phi.bottomRows<3>() = -up * (T * b.w_dot) * psi.s.transpose() - T * skew<double>(b.w_dot) -
                              up * W * psi.rate_phi.transpose() -
                              psi.rate * up * d.U_phi.bottomRows<3>();
    d.a_v.topRows<3>() = -psi.rate * up * H_T;
    d.a_w.topRows<3>() = -up * V * psi.s.transpose();
    d.a_w.bottomRows<3>() = -up * W * psi.s.transpose() - psi.rate * up * T;
  } else {
    const Matrix3 T = d.a_acc.bottomRightCorner<3, 3>(); // H^T R
    d.U_phi.bottomRows<3>() = -T * wx;
    d.U_v.topRows<3>() = d.a_acc.topLeftCorner<3, 3>();
    d.U_w.bottomRows<3>() = T;
    d.a_phi.bottomRows<3>() = -T * skew<double>(b.w_dot);
  }
  return d;
}

/// Derivatives of the load L rate + Q momentum of `hydro_load`: L, Q, and those by the rotation
/// (body axes) and velocities (v, w) of the body, with rate and momentum constant.
struct HydroLoadGradient {
  Matrix6 L, Q = Matrix6::Zero(), by_velocity = Matrix6::Zero();
  Matrix63 by_rotation = Matrix63::Zero();
};

inline HydroLoadGradient hydro_load_gradient(HydroAxes axes, const HydroBody& hb,
                                             const element::BodyState<double>& b,
                                             const Vector6& rate, const Vector6& momentum) {
  HydroLoadGradient d;
  d.L = hydro_axes(axes, hb, b);
  if (axes == HydroAxes::body) {
    const Matrix3 R_T = b.R.transpose(), wx = skew<double>(b.w), Vx = skew<double>(R_T * b.v);
    const Matrix3 px = skew<double>(momentum.head<3>()), hx = skew<double>(momentum.tail<3>());
    d.Q << b.R * wx, Matrix3::Zero(), Vx, wx;
    const Vector3 force = rate.head<3>() + wx * momentum.head<3>();
    d.by_rotation << -b.R * skew<double>(force), -px * Vx;
    d.by_velocity << Matrix3::Zero(), -b.R * px, -px * R_T, -hx;
  } else if (axes == HydroAxes::yaw) {
    const YawGradient psi = yaw_gradient(b);
    const Matrix3 H_T = psi.H.transpose(), T = H_T * b.R, up = skew<double>(Vector3::UnitZ());
    const Vector3 V = H_T * b.v, W = T * b.w, z = Vector3::UnitZ();
    const Vector3 p = momentum.head<3>(), h = momentum.tail<3>();
    d.Q << psi.rate * psi.H * up, Matrix3::Zero(), psi.s * (z.transpose() * skew<double>(V)),
        psi.rate * T.transpose() * up + psi.s * (z.transpose() * skew<double>(W));
    const Vector3 force = rate.head<3>() + psi.rate * up * p;
    const Vector3 moment = rate.tail<3>() + psi.rate * up * h;
    const Matrix3 V_phi = -up * V * psi.s.transpose();
    const Matrix3 W_phi = -up * W * psi.s.transpose() - T * skew<double>(b.w);
    const Vector3 pz = p.cross(z), hz = h.cross(z);
    const double munk = z.dot(V.cross(p) + W.cross(h));
    d.by_rotation << psi.H * (up * force * psi.s.transpose() + up * p * psi.rate_phi.transpose()),
        skew<double>(T.transpose() * moment) +
            T.transpose() * (up * moment * psi.s.transpose() + up * h * psi.rate_phi.transpose()) +
            munk * psi.s_phi + psi.s * (pz.transpose() * V_phi + hz.transpose() * W_phi);
    d.by_velocity << Matrix3::Zero(), psi.H * up * p * psi.s.transpose(),
        psi.s * (pz.transpose() * H_T),
        T.transpose() * up * h * psi.s.transpose() + psi.s * (hz.transpose() * T);
  } else {
    const Vector3 moment = d.L.bottomRightCorner<3, 3>() * rate.tail<3>();
    d.by_rotation.bottomRows<3>() = skew<double>(moment);
  }
  return d;
}

} // namespace hydrodae::water
