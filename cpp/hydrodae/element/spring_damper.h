#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"
#include "hydrodae/element/elements.h"
#include "hydrodae/math/curve.h"

namespace hydrodae::element {

/// Spring and damper between a point of one body and a point of another (or of the ground).
///
///   f = -k d - k2 d^2 - k3 d^3 - ... - F(d) - c s' + f0      [N], f > 0 pushes them apart
///
/// s: distance of the points [m], d = s - s0; F: a curve through measured points, straight beyond
/// its ends. A negative k pushes away from s0. The points are given in the reference pose. Where
/// they coincide the force has no direction, so it must be zero there. A linear spring with s0 = 0
/// is: its vector -k (r_B - r_A) is smooth. Its damper then acts along the motion.
struct SpringDamper {
  static constexpr std::string_view type = "spring_damper";
  static constexpr Port port = Port::along_distance;
  static constexpr int n_signals = 1;
  static constexpr std::string_view doc =
      "Spring and damper between points of two bodies: f = -k (s - s0) - c s' + f0, s their "
      "distance.";
  std::string name;
  std::string body_a;
  std::string body_b;
  Vector3 point_a = Vector3::Zero();
  Vector3 point_b = Vector3::Zero();
  double stiffness = 0.0;
  double damping = 0.0;
  double force = 0.0;
  /// Natural length s0; by default the distance in the reference pose
  std::optional<double> length;
  std::vector<double> hardening;
  std::vector<double> curve_at, curve_force;

  /// Law to evaluate, with s0 known.
  struct Law {
    double stiffness, damping, length;
    std::vector<double> hardening;
    Curve curve;

    template <class S> void operator()(const In<S>& in, const Out<S>& out) const {
      const S d = *in.x - S(length);
      S f = S(in.signals[0]) - S(stiffness) * d - S(damping) * *in.v, power = d;
      for (const double k : hardening) {
        power *= d;
        f -= S(k) * power;
      }
      if (!curve.empty())
        f -= curve(d);
      *out.load = f;
    }
    double energy(const In<double>& in) const {
      const double d = *in.x - length;
      double sum = 0.5 * stiffness * d * d - in.signals[0] * d, power = 0.5 * d * d, n = 2.0;
      for (const double k : hardening) {
        power *= n / (n + 1.0) * d;
        n += 1.0;
        sum += k * power;
      }
      if (!curve.empty())
        sum += curve.area(d) - curve.area(0.0);
      return sum;
    }
  };
  Law law() const {
    return {stiffness, damping, length.value_or((point_b - point_a).norm()), hardening,
            curve_at.empty() ? Curve() : Curve(curve_at, curve_force)};
  }

  /// Inputs that a program may change during the run.
  static std::vector<Signal> inputs() { return {{"force", "N"}}; }
  std::array<double, n_signals> start_signals() const { return {force}; }

  /// Returns whether the spring is at rest where its points coincide.
  bool rests_at_zero() const {
    const double s = 0.0, v = 0.0;
    double f = 0.0, none = 0.0;
    law()(In<double>{0.0, &s, &v, &none, &force}, Out<double>{&f, &none});
    return f == 0.0;
  }

  /// Fault in the parameters, or nothing.
  std::optional<Fault> fault() const {
    if (const std::string_view wrong = Curve::fault(curve_at, curve_force); !wrong.empty())
      return Fault{"curve_at", "'curve_at' " + std::string(wrong) + " 'curve_force'"};
    return {};
  }

  template <class D = SpringDamper> static Fields<D> fields() {
    return {
        {"name", &D::name, "-", "Name of this force in the results.", true},
        {"body_a", &D::body_a, "-", "First body, or ground.", true},
        {"body_b", &D::body_b, "-", "Second body, or ground.", true},
        {"point_a", &D::point_a, "m", "Point of the first body in the reference pose, world axes.",
         true},
        {"point_b", &D::point_b, "m", "Point of the second body in the reference pose, world axes.",
         true},
        {"stiffness", &D::stiffness, "N/m", "Stiffness k; negative: it pushes away from `length`."},
        {"damping", &D::damping, "N s/m", "Damping c.", false, at_least(0)},
        {"force", &D::force, "N", "Constant part f0, positive apart."},
        {"length", &D::length, "m",
         "Length s0 at which the spring is slack; default: distance of the points in the reference "
         "pose.",
         false, at_least(0)},
        {"hardening", &D::hardening, "N/m2, N/m3, ...", "k2, k3, ... of the powers of s - s0."},
        {"curve_at", &D::curve_at, "m", "Places s - s0, ascending, of `curve_force`."},
        {"curve_force", &D::curve_force, "N", "Forces F there, together for > 0."},
    };
  }
};

} // namespace hydrodae::element
