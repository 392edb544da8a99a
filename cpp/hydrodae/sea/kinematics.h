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

/// Current at one height.
struct Layer {
  double z = 0.0;                     ///< [m]
  Vector3 velocity = Vector3::Zero(); ///< [m/s]
};

/// Layers of rows z [m], speed [m/s], heading [deg].
std::vector<Layer> layers(const std::vector<Vector3>& rows);

/// Plane waves in groups that one vector of numbers, or a few, takes at once.
class WaveTerms {
public:
  struct Term {
    double omega = 0.0, wavenumber = 0.0, phase = 0.0; ///< [rad/s], [rad/m], [rad]
    /// Cosine and sine of the direction of travel
    double cosine = 1.0, sine = 0.0;
    double amplitude = 0.0;  ///< a [m]
    double reflection = 0.0; ///< e^{-2kh}; 0 in deep water
    double speed = 0.0;      ///< a w / (1 - e^{-2kh}) [m/s]
  };
  static constexpr std::size_t lanes = 8;
  /// Numbers of the terms of a group, in the order of `Term`; behind the last term all are zero, so
  /// that nothing travels there in any direction.
  struct Group {
    double omega[lanes], wavenumber[lanes], phase[lanes], cosine[lanes], sine[lanes],
        amplitude[lanes], reflection[lanes], speed[lanes];
  };

  std::size_t size() const;
  bool empty() const { return groups_.empty(); }
  void clear() { groups_.clear(); }
  void push_back(const Term& term);
  void append(const std::vector<Term>& terms);
  void keep(std::size_t size); ///< leaves out the terms behind the first ones
  void set_phase(std::size_t i, double phase);
  Term operator[](std::size_t i) const;
  const std::vector<Group>& groups() const { return groups_; }

private:
  std::vector<Group> groups_;
};

/// The sea as a field in space and time; without terms the water moves with the current alone.
struct WaveField {
  using Term = WaveTerms::Term;
  double depth = INFINITY, ramp = 0.0; ///< h [m], growth at the start [s]
  Vector3 current = Vector3::Zero();   ///< [m/s]
  std::vector<Layer> profile;          ///< downwards, in place of `current`; empty: uniform
  WaveTerms terms;
  std::shared_ptr<const SecondOrder> second; ///< added by `elevation`; null in a first-order sea

  WaveField() = default;
  WaveField(const std::vector<Component>& components, double water_depth, double ramp_time,
            const Vector3& flow);
};

/// Elevation at one place and time, with the ramp [m].
double elevation(const WaveField& field, double t, double x, double y);

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

/// Adds the waves at a point that is not beneath the bed, and, unless `gradient` is null, their
/// derivatives. This is the closed form, for dual numbers.
template <class S>
void add_waves(const WaveField& field, double t, const Vec3<S>& x, FluidPoint<S>& out,
               FluidGradient* /*gradient*/) {
  const double growth = ramp(t, field.ramp);
  const bool above = x[2] > S(0);
  for (std::size_t i = 0; i < field.terms.size(); ++i) {
    const WaveField::Term w = field.terms[i];
    const double k = w.wavenumber;
    const S angle = S(w.omega * t + w.phase) - (S(k * w.cosine) * x[0] + S(k * w.sine) * x[1]);
    const S c = cos(angle), s = sin(angle), e = above ? S(1) : S(exp(S(k) * x[2]));
    const S back = w.reflection > 0.0 ? S(w.reflection) / e : S(0);
    const S C = S(growth * w.speed) * (e + back), D = S(growth * w.speed) * (e - back);
    const S u_h = C * c, a_h = S(-w.omega) * C * s;
    out.velocity += Vec3<S>(S(w.cosine) * u_h, S(w.sine) * u_h, -(D * s));
    out.acceleration += Vec3<S>(S(w.cosine) * a_h, S(w.sine) * a_h, S(-w.omega) * D * c);
    out.elevation += S(growth * w.amplitude) * c;
  }
}

/// The same for numbers, many terms at once.
template <>
void add_waves<double>(const WaveField& field, double t, const Vector3& x, FluidPoint<double>& out,
                       FluidGradient* gradient);

/// Water at the n points x0 + j dx, j = 0 .. n-1, of a straight line and, for numbers, unless
/// `gradients` is null, its derivatives. Allocates nothing.
template <class S>
void fluid_on_line(const WaveField& field, double t, const Vec3<S>& x0, const Vec3<S>& dx, int n,
                   FluidPoint<S>* out, FluidGradient* gradients = nullptr) {
  for (int j = 0; j < n; ++j) {
    const Vec3<S> x = x0 + S(j) * dx;
    out[j] = {Vec3<S>::Zero(), Vec3<S>::Zero(), S(0)};
    FluidGradient* gradient = gradients ? gradients + j : nullptr;
    if (gradient)
      *gradient = {Matrix3::Zero(), Matrix3::Zero(), Vector3::Zero()};
    if (x[2] < S(-field.depth))
      continue;
    if (!field.terms.empty())
      add_waves<S>(field, t, x, out[j], gradient);
    if (field.profile.empty()) {
      out[j].velocity += field.current.template cast<S>();
      continue;
    }
    Vector3 slope;
    out[j].velocity += current_at<S>(field.profile, x[2], &slope);
    if (gradient)
      gradient->velocity.col(2) += slope;
  }
}

} // namespace hydrodae::sea
