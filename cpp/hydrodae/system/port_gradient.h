#pragma once
/// Derivatives of the inputs of a law by the poses of its bodies, and of its load on them.

#include "hydrodae/system/elements.h"

namespace hydrodae::system {

/// Gradient of w inputs by n tangent coordinates (virtual displacements dxi, velocities u):
///   dx = x_xi dxi,   dv = v_xi dxi + v_u du,   load on the bodies W^T f,   d(W^T) f = turn dxi
template <int w, int n> struct PortGradient {
  Eigen::Matrix<double, w, n> x_xi, v_xi, v_u, W; ///< v_u = W; for delayed laws v_u = 0
  Eigen::Matrix<double, n, n> turn;               ///< rotation of W under the present load
};

/// Gradient of a coordinate s: W = ds/dxi, d(W u) = (T^T u) . dxi, turn = f T. A delayed law
/// depends on the present only if there is no past. T is unbounded where two points coincide. A
/// load f = f_s s is zero there, and f T tends to f_s (d2(s^2 / 2)/dxi2 - W^T W).
/// @param load, slope  f and f_s
inline void motion_gradient(const Regime& s, const Workspace<double>& ws, const PortData& port,
                            const joint::Vector12& row, double load, double slope,
                            PortGradient<1, 12>& out) {
  const JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
  const joint::FreeMotion& motion = s.motions[static_cast<std::size_t>(port.motion)].motion;
  const joint::Geometry<double> g = joint_geometry<double>(j, ws.bodies);
  const joint::Matrix12 T = joint::motion_curvature(motion, j.A, j.B, g);
  out.W = row.transpose();
  out.turn = load * T;
  if (motion.kind == joint::FreeMotion::Kind::stretches &&
      joint::stretch_row<double>(j.A, j.B, g).value == 0.0)
    out.turn = slope * (joint::distance().curvature(j.A, j.B, {1.0}, g) - row * row.transpose());
  if (port.delay < 0) {
    out.x_xi = out.v_u = out.W;
    out.v_xi = (T.transpose() * joint_velocity<double>(j, ws.bodies)).transpose();
  } else {
    out.x_xi = ws.past ? Eigen::Matrix<double, 1, 12>(Eigen::Matrix<double, 1, 12>::Zero()) : out.W;
    out.v_xi.setZero();
    out.v_u.setZero();
  }
}

/// Displacement and twist of a body:
///   d xi = (dr, J R_turn dphi), d twist = (dv, -R [w]x dphi + R dw), d(R^T m) = [R^T m]x dphi +
///   R^T dm.
inline void body_gradient(const BodyState<double>& b, const PortData& port, const double* x,
                          const double* load, PortGradient<6, 6>& out) {
  const Eigen::Map<const Vector3> theta(x + 3), moment(load + 3);
  out.x_xi.setIdentity();
  out.x_xi.bottomRightCorner<3, 3>() =
      rotation_vector_gradient(theta) * rotation_matrix<double>(port.turn);
  out.v_xi.setZero();
  out.v_xi.bottomRightCorner<3, 3>() = -b.R * skew<double>(b.w);
  out.W.setIdentity();
  out.W.bottomRightCorner<3, 3>() = b.R;
  out.v_u = out.W;
  out.turn.setZero();
  out.turn.bottomRightCorner<3, 3>() = skew<double>(b.R.transpose() * moment);
}

/// Gradient at a point p of a body: dr = A dxi, dv = A du + V dxi, with A = [1, -R [p]x] and V =
/// [0, -R [w x p]x]. Its force f loads the body by A^T f, with the derivative `turn` dxi.
struct PointGradient {
  Eigen::Matrix<double, 3, 6> A, V;
  Matrix6 turn;
};

inline PointGradient point_gradient(const BodyState<double>& b, const Vector3& p, const double* f) {
  const Eigen::Map<const Vector3> force(f);
  PointGradient out;
  out.A << Matrix3::Identity(), -b.R * skew<double>(p);
  out.V << Matrix3::Zero(), -b.R * skew<double>(b.w.cross(p));
  out.turn.setZero();
  out.turn.bottomRightCorner<3, 3>() = skew<double>(p) * skew<double>(b.R.transpose() * force);
  return out;
}

/// Gradient of the pose of marker B relative to A. Places are the rows `span` of joints. For
/// rotations, with the axes a
/// of A, N = R_A^T R_B, dN = -[dphi_A]x N + N [dphi_B]x:
///   omega = a^T (N w_B - w_A),   d theta = J(-theta) a^T (N dphi_B - dphi_A)
inline void marker_gradient(const Regime& s, const Workspace<double>& ws, const PortData& port,
                            const double* x, const joint::Vector12* rows, const double* load,
                            PortGradient<6, 12>& out) {
  const JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
  const joint::Geometry<double> g = joint_geometry<double>(j, ws.bodies);
  const joint::Vector12 u = joint_velocity<double>(j, ws.bodies);
  out.turn.setZero();
  for (int i = 0; i < 6; ++i)
    out.W.row(i) = rows[i].transpose();
  for (int i = 0; i < 3; ++i) {
    const joint::Matrix12 T = joint::SpanRow{i}.curvature(j.A, j.B, j.parameters, g);
    out.v_xi.row(i) = (T.transpose() * u).transpose();
    out.turn += load[i] * T;
  }
  out.x_xi = out.v_u = out.W;
  const Eigen::Map<const Vector3> theta(x + 3), moment(load + 3);
  // Rotations seen from A's axes are on the left of theta: J(-theta) (the left Jacobian's inverse).
  out.x_xi.bottomRows<3>() = rotation_vector_gradient(-theta) * out.W.bottomRows<3>();
  const Matrix3 axes = j.A.axes;
  const Vector3 w = g.N * u.tail<3>(), m = axes * moment;
  out.v_xi.bottomRows<3>().setZero();
  out.v_xi.block<3, 3>(3, 3) = axes.transpose() * skew<double>(w);
  out.v_xi.block<3, 3>(3, 9) = -axes.transpose() * g.N * skew<double>(Vector3(u.tail<3>()));
  const Vector3 m_B = g.N.transpose() * m;
  out.turn.block<3, 3>(9, 3) -= g.N.transpose() * skew<double>(m);
  out.turn.block<3, 3>(9, 9) += skew<double>(m_B);
}

} // namespace hydrodae::system
