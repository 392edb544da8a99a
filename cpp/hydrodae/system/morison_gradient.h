#pragma once
/// Derivatives of the Morison loads (morison.h) for the Jacobian and for the linear model.

#include "hydrodae/system/hydro_gradient.h"
#include "hydrodae/system/morison.h"

namespace hydrodae::system {

/// Derivatives of a load (world force, body-axes moment) by the virtual displacement of its body
/// (world translation, body-axes rotation), its velocities (v, w) and accelerations (v', w').
struct LoadGradient {
  Matrix6 by_displacement = Matrix6::Zero(), by_velocity = Matrix6::Zero(),
          by_acceleration = Matrix6::Zero();
};

/// One segment by the water: force F (3,) and dF by its velocity, acceleration and elevation.
struct SegmentGradient {
  Vector3 arm, force;
  element::MorisonGradient dry; ///< without the wet part
  double wet = 0.0;
  Vector3 by_height, by_axis_z; ///< of F through the wet part
};

inline SegmentGradient segment_gradient(const MorisonData& m, const BodyState<double>& b, int k,
                                        const sea::FluidPoint<double>& f) {
  SegmentGradient d;
  d.arm = m.first + k * m.step;
  const Vector3 spin = b.w.cross(d.arm), axis = b.R * m.axis;
  const Vector3 u = f.velocity - b.v - b.R * spin;
  const Vector3 acceleration = b.v_dot + b.R * (b.w_dot.cross(d.arm) + b.w.cross(spin));
  const double height = (b.r + b.R * d.arm)[2] - (m.instantaneous ? f.elevation : 0.0);
  double by_height = 0.0, by_axis_z = 0.0;
  d.wet = element::wet_part<double>(m.law, height, axis[2], &by_height, &by_axis_z);
  const Vector3 dry = element::morison_force<double>(m.law, axis, u, f.acceleration, acceleration);
  d.dry = element::morison_gradient(m.law, axis, u, f.acceleration, acceleration);
  d.force = d.wet * dry;
  d.by_height = by_height * dry;
  d.by_axis_z = by_axis_z * dry;
  return d;
}

// x = r + R s, v_b = v + R (w x s), a_b = v' + R c, c = w' x s + w x (w x s), t = R t_0:
//   dx = dr - R [s] dphi,  dv_b = dv - R [w x s] dphi - R [s] dw,  dt = -R [t_0] dphi,
//   da_b = dv' - R [c] dphi - R [s] dw' - R ([w x s] + [w][s]) dw.
// Load (F, s x R^T F): d(R^T F) = R^T dF + [R^T F] dphi.
inline LoadGradient morison_gradient(const sea::WaveField& water, const MorisonData& m,
                                     const BodyState<double>& b, double t,
                                     std::vector<sea::FluidPoint<double>>& fluid,
                                     std::vector<sea::FluidGradient>& gradients) {
  morison_fluid<double>(water, m, b, t, fluid, gradients.data());
  const Matrix3 by_phi_axis = -b.R * skew<double>(m.axis), wx = skew<double>(b.w);
  LoadGradient out;
  for (int k = 0; k < m.segments; ++k) {
    const sea::FluidGradient& g = gradients[static_cast<std::size_t>(k)];
    const SegmentGradient d = segment_gradient(m, b, k, fluid[static_cast<std::size_t>(k)]);
    const Matrix3 sx = skew<double>(d.arm), spin_x = skew<double>(b.w.cross(d.arm));
    const Matrix3 c_x = skew<double>(b.w_dot.cross(d.arm) + b.w.cross(b.w.cross(d.arm)));
    const Vector3 up = Vector3::UnitZ() - (m.instantaneous ? g.elevation : Vector3::Zero());
    const Matrix3 by_x =
        d.wet * (d.dry.by_velocity * g.velocity + d.dry.by_fluid * g.acceleration) +
        d.by_height * up.transpose();
    const Matrix3 by_v = -d.wet * d.dry.by_velocity, by_a = d.wet * d.dry.by_body;
    const Matrix3 by_axis = d.wet * d.dry.by_axis + d.by_axis_z * Vector3::UnitZ().transpose();
    const Matrix3 R_sx = b.R * sx, moment = sx * b.R.transpose();
    const auto add = [&](Matrix6& to, const Matrix3& by_translation, const Matrix3& by_rotation) {
      to.topLeftCorner<3, 3>() += by_translation;
      to.topRightCorner<3, 3>() += by_rotation;
      to.bottomLeftCorner<3, 3>() += moment * by_translation;
      to.bottomRightCorner<3, 3>() += moment * by_rotation;
    };
    add(out.by_displacement, by_x,
        -by_x * R_sx - by_v * b.R * spin_x - by_a * b.R * c_x + by_axis * by_phi_axis);
    out.by_displacement.bottomRightCorner<3, 3>() += sx * skew<double>(b.R.transpose() * d.force);
    add(out.by_velocity, by_v, -by_v * R_sx - by_a * b.R * (spin_x + wx * sx));
    add(out.by_acceleration, by_a, -by_a * R_sx);
  }
  return out;
}

} // namespace hydrodae::system
