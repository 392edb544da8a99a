#pragma once
/// Motion of the undisturbed water at points that move: linear (Airy) waves of finite depth, their
/// bound waves as further terms (sea/second_order.h), and a current, uniform or over the depth.
///
///   eta = a cos th,   th = w t - k (x cos b + y sin b) + phase
///   u_h = a w C cos th,   u_z = -a w S sin th,   du_h/dt = -a w^2 C sin th,   du_z/dt = ...
///   C = cosh k(z+h) / sinh kh,   S = sinh k(z+h) / sinh kh,   both e^{kz} in deep water
///
/// - Above the mean surface the values of z = 0 hold (constant extrapolation). Beneath the bed the
///   water is at rest.
/// - Accelerations are local (du/dt at a point that stands still): the convective part u.grad u is
///   of second order in the steepness.
/// - The ramp multiplies elevation, velocity and acceleration alike, as it does the excitation: its
///   own derivative is in none of them (of the order 1/(w ramp) beside the acceleration).

#include <cmath>
#include <memory>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/sea/component.h"

namespace hydrodae::sea {

class SecondOrder;

/// Second-order elevation of all bound waves, without the ramp [m].
double second_elevation(const SecondOrder& second, double t, double x, double y);

/// Current at one height.
struct Layer {
  double z = 0.0;                     ///< [m]
  Vector3 velocity = Vector3::Zero(); ///< [m/s]
};

/// Layers of rows z [m], speed [m/s], heading [deg].
std::vector<Layer> layers(const std::vector<Vector3>& rows);

/// The sea as a field in space and time; without terms the water moves with the current alone.
struct WaveField {
  struct Term {
    double omega = 0.0, wavenumber = 0.0, phase = 0.0; ///< [rad/s], [rad/m], [rad]
    /// Cosine and sine of the direction of travel
    double cosine = 1.0, sine = 0.0;
    double amplitude = 0.0;  ///< a [m]
    double reflection = 0.0; ///< e^{-2kh}; 0 in deep water
    double speed = 0.0;      ///< a w / (1 - e^{-2kh}) [m/s]
  };
  double depth = INFINITY, ramp = 0.0; ///< h [m], growth at the start [s]
  Vector3 current = Vector3::Zero();   ///< [m/s]
  std::vector<Layer> profile;          ///< downwards, in place of `current`; empty: uniform
  std::vector<Term> terms;
  std::shared_ptr<const SecondOrder> second; ///< added by `elevation`; null in a first-order sea

  WaveField() = default;
  WaveField(const std::vector<Component>& components, double water_depth, double ramp_time,
            const Vector3& flow)
      : depth(water_depth), ramp(ramp_time), current(flow) {
    for (const Component& c : components) {
      const double kh = c.wavenumber * depth;
      // Beyond, e^{-kh} is less than what rounding leaves.
      const double reflection = kh < 40.0 ? std::exp(-2.0 * kh) : 0.0;
      const double whole = kh < 40.0 ? -std::expm1(-2.0 * kh) : 1.0;
      terms.push_back({c.omega, c.wavenumber, c.phase, std::cos(c.heading), std::sin(c.heading),
                       c.amplitude, reflection, c.amplitude * c.omega / whole});
    }
  }
};

/// Elevation at one place and time, with the ramp [m].
inline double elevation(const WaveField& field, double t, double x, double y) {
  const double growth = ramp(t, field.ramp);
  double sum = 0.0;
  for (const WaveField::Term& w : field.terms)
    sum +=
        w.amplitude * std::cos(w.omega * t + w.phase - w.wavenumber * (w.cosine * x + w.sine * y));
  if (field.second)
    sum += second_elevation(*field.second, t, x, y);
  return growth * sum;
}

/// Current at height z in a profile, and, where `slope` is not null, its derivative by z. The
/// velocities of the layers are joined by straight lines and constant beyond.
template <class S>
Vec3<S> current_at(const std::vector<Layer>& profile, const S& z, Vector3* slope = nullptr) {
  if (slope)
    slope->setZero();
  if (z >= S(profile.front().z))
    return profile.front().velocity.template cast<S>();
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Layer &above = profile[i - 1], &below = profile[i];
    if (z < S(below.z))
      continue;
    const Vector3 by_z = (above.velocity - below.velocity) / (above.z - below.z);
    if (slope)
      *slope = by_z;
    return below.velocity.template cast<S>() + (z - S(below.z)) * by_z.template cast<S>();
  }
  return profile.back().velocity.template cast<S>();
}

/// Velocity [m/s] and acceleration [m/s2] of the water at a point, elevation [m] above it.
template <class S> struct FluidPoint {
  Vec3<S> velocity, acceleration;
  S elevation;
};

/// Derivatives by the place: column j is by x_j.
struct FluidGradient {
  Matrix3 velocity, acceleration;
  Vector3 elevation;
};

/// Water at the n points x0 + j dx, j = 0 .. n-1, of a straight line and, unless `gradients` is
/// null, its derivatives. Each component needs two sines and cosines, then recurrences from point
/// to point. Allocates nothing.
template <class S>
void fluid_on_line(const WaveField& field, double t, const Vec3<S>& x0, const Vec3<S>& dx, int n,
                   FluidPoint<S>* out, FluidGradient* gradients = nullptr) {
  using std::cos, std::exp, std::sin;
  const double growth = ramp(t, field.ramp);
  // Upwards, so that e^{kz} grows from point to point until it stays at 1.
  const bool down = dx[2] < S(0);
  const Vec3<S> step = down ? Vec3<S>(-dx) : dx;
  const Vec3<S> low = down ? Vec3<S>(x0 + S(n - 1) * dx) : x0;
  const auto place = [&](int j) { return down ? n - 1 - j : j; };
  int first = 0; // index of the first point above the bed
  while (first < n && low[2] + S(first) * step[2] < S(-field.depth))
    ++first;
  for (int j = 0; j < n; ++j) {
    FluidPoint<S>& p = out[place(j)];
    p.velocity.setZero();
    p.acceleration.setZero();
    p.elevation = S(0);
    if (gradients)
      gradients[place(j)] = {Matrix3::Zero(), Matrix3::Zero(), Vector3::Zero()};
  }
  for (const WaveField::Term& w : field.terms) {
    if (growth == 0.0 || first == n)
      break;
    const double k = w.wavenumber, kx = k * w.cosine, ky = k * w.sine;
    const S along = S(kx) * (low[0] + S(first) * step[0]) + S(ky) * (low[1] + S(first) * step[1]);
    const S angle = S(w.omega * t + w.phase) - along;
    const S turn = -(S(kx) * step[0] + S(ky) * step[1]);
    const S turn_c = cos(turn), turn_s = sin(turn);
    const bool steep = S(k) * step[2] > S(30); // one step spans more than the recurrence bears
    const S rise = steep ? S(1) : S(exp(S(k) * step[2]));
    S c = cos(angle), s = sin(angle), e = S(0);
    for (int j = first; j < n; ++j) {
      const S z = low[2] + S(j) * step[2];
      const bool above = z > S(0);
      e = above ? S(1) : j == first || steep ? S(exp(S(k) * z)) : S(e * rise);
      const S back = w.reflection > 0.0 ? S(w.reflection) / e : S(0);
      const S C = S(growth * w.speed) * (e + back), D = S(growth * w.speed) * (e - back);
      const S u_h = C * c, u_z = -(D * s), a_h = S(-w.omega) * C * s, a_z = S(-w.omega) * D * c;
      FluidPoint<S>& p = out[place(j)];
      p.velocity += Vec3<S>(S(w.cosine) * u_h, S(w.sine) * u_h, u_z);
      p.acceleration += Vec3<S>(S(w.cosine) * a_h, S(w.sine) * a_h, a_z);
      p.elevation += S(growth * w.amplitude) * c;
      if constexpr (std::is_same_v<S, double>) {
        if (gradients) {
          // By th: d/dx = -k cos b d/dth, d/dy = -k sin b d/dth; by z: C' = k S, S' = k C.
          const Vector3 direction(w.cosine, w.sine, 0.0), up(0.0, 0.0, 1.0);
          const Vector3 by_th_u = -C * s * direction - D * c * up;
          const Vector3 by_th_a = w.omega * (-C * c * direction + D * s * up);
          FluidGradient& g = gradients[place(j)];
          g.velocity -= k * by_th_u * direction.transpose();
          g.acceleration -= k * by_th_a * direction.transpose();
          g.elevation += k * growth * w.amplitude * s * direction;
          if (!above) {
            g.velocity.col(2) += k * (D * c * direction - C * s * up);
            g.acceleration.col(2) -= k * w.omega * (D * s * direction + C * c * up);
          }
        }
      }
      const S turned = c * turn_c - s * turn_s;
      s = s * turn_c + c * turn_s;
      c = turned;
    }
  }
  if (field.profile.empty()) {
    for (int j = first; j < n; ++j)
      out[place(j)].velocity += field.current.template cast<S>();
    return;
  }
  for (int j = first; j < n; ++j) {
    Vector3 slope;
    out[place(j)].velocity += current_at<S>(field.profile, low[2] + S(j) * step[2], &slope);
    if (gradients)
      gradients[place(j)].velocity.col(2) += slope;
  }
}

} // namespace hydrodae::sea
