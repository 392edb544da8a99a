#pragma once
#include <cmath>
#include <optional>
#include <string>

#include "hydrodae/core/field.h"
#include "hydrodae/math/rotation.h"

namespace hydrodae::water {

/// Table [[morison]]: drag and inertia of the water on a point or on a slender member of a body
/// (Morison et al., Petroleum Trans. AIME 189 (1950) 149), by the motion of the undisturbed water.
///
///   point:   F = w [ 1/2 rho C_d A |u| u + rho V ((1 + C_a) a_f - C_a a_b) ]
///   member:  as above with the parts of u, a_f, a_b across the axis, A = D dl, V = pi/4 D^2 dl for
///            each segment dl; along the axis 1/2 rho C_dt pi D dl |u_t| u_t and
///            rho V C_at (a_f - a_b)_t; without the pressure on the end faces
///
/// Inside a mesh with the Froude-Krylov load of its body, C_a replaces 1 + C_a.
///
/// u = u_fluid - v_body [m/s]; w: wet part of the segment (see `wet_part`). Buoyancy is not
/// included: it belongs to the hydrostatics of the database.
struct Morison {
  static constexpr std::string_view doc =
      "Drag and inertia of the water on a point or on a slender member of a body (Morison).";
  std::string name;
  std::string body;
  std::optional<Vector3> point, point_a, point_b;
  std::optional<double> diameter, area, volume;
  double drag_coefficient = 0.0, drag_axial = 0.0;
  std::optional<double> added_mass_coefficient;
  double added_mass_axial = 0.0;
  int segments = 20;
  std::string surface = "mean";

  bool has_inertia() const { return added_mass_coefficient || added_mass_axial > 0.0; }

  static Fields<Morison> fields();
};

/// Segment for the evaluation; a point has no axis (a zero vector).
struct MorisonSegment {
  double half_length = 0.0, radius = 0.0; ///< [m]; half_length 0: a point
  double drag = 0.0, drag_axial = 0.0;    ///< 1/2 rho C A across and along the axis [kg/m]
  double mass_fluid = 0.0;                ///< rho V (1 + C_a), 0 without inertia [kg]
  double mass_body = 0.0;                 ///< rho V C_a [kg]
  double mass_axial = 0.0;                ///< rho V C_at [kg]
};

/// Wet part of a segment, from the height of its centre above the surface:
///   w = x,   x = 1/2 - height/(2e) within [0, 1],   e^2 = (l t_z)^2 + r^2 (1 - t_z^2)
/// where e is half the height of the segment, exact for upright (then the wet length is, too) and
/// level segments. For a point w = x^2 (3 - 2x) with e = r, the wet part of a sphere.
template <class S>
S wet_part(const MorisonSegment& m, const S& height, const S& axis_z, S* by_height = nullptr,
           S* by_axis_z = nullptr) {
  using std::sqrt;
  const S l2(m.half_length * m.half_length), r2(m.radius * m.radius);
  const S e = sqrt(r2 + (l2 - r2) * axis_z * axis_z);
  const S x = S(0.5) - S(0.5) * height / e;
  const bool all = x > S(1), none = x < S(0);
  const bool sphere = m.half_length == 0.0;
  const S slope = all || none ? S(0) : sphere ? S(6) * x * (S(1) - x) : S(1);
  if (by_height)
    *by_height = S(-0.5) * slope / e;
  if (by_axis_z)
    *by_axis_z = S(0.5) * slope * height / (e * e) * (l2 - r2) * axis_z / e;
  return all ? S(1) : none ? S(0) : sphere ? x * x * (S(3) - S(2) * x) : x;
}

/// Force on a dry segment [N], without the wet part, world axes: axis t, velocity u of the water
/// relative to the segment, accelerations a_f of the water and a_b of the segment.
template <class S>
Vec3<S> morison_force(const MorisonSegment& m, const Vec3<S>& t, const Vec3<S>& u,
                      const Vec3<S>& a_f, const Vec3<S>& a_b) {
  using std::abs, std::sqrt;
  const S u_t = t.cwiseProduct(u).sum();
  const Vec3<S> u_n = u - u_t * t;
  const S square = u_n.cwiseProduct(u_n).sum();
  const S speed = square > S(0) ? S(sqrt(square)) : S(0);
  const Vec3<S> b = S(m.mass_fluid) * a_f - S(m.mass_body) * a_b;
  const Vec3<S> c = b - S(m.mass_axial) * (a_f - a_b);
  const S c_t = t.cwiseProduct(c).sum();
  return S(m.drag) * speed * u_n + (S(m.drag_axial) * abs(u_t) * u_t - c_t) * t + b;
}

/// Derivatives of the force, (3, 3) each. The drag |u| u has a continuous derivative, zero at u =
/// 0.
struct MorisonGradient {
  Matrix3 by_axis, by_velocity, by_fluid, by_body;
};
inline MorisonGradient morison_gradient(const MorisonSegment& m, const Vector3& t, const Vector3& u,
                                        const Vector3& a_f, const Vector3& a_b) {
  const Matrix3 I = Matrix3::Identity(), tt = t * t.transpose(), across = I - tt;
  const double u_t = t.dot(u);
  const Vector3 u_n = u - u_t * t;
  const double speed = u_n.norm();
  Matrix3 by_u_n = m.drag * speed * I;
  if (speed > 0.0)
    by_u_n += m.drag / speed * u_n * u_n.transpose();
  const Vector3 c = m.mass_fluid * a_f - m.mass_body * a_b - m.mass_axial * (a_f - a_b);
  const double axial = m.drag_axial * std::abs(u_t) * u_t - t.dot(c);
  MorisonGradient d;
  d.by_velocity = by_u_n * across + 2.0 * m.drag_axial * std::abs(u_t) * tt;
  d.by_axis = axial * I + t * (2.0 * m.drag_axial * std::abs(u_t) * u - c).transpose() -
              by_u_n * (u_t * I + t * u.transpose());
  d.by_fluid = m.mass_fluid * across + m.mass_axial * tt;
  d.by_body = -m.mass_body * across - m.mass_axial * tt;
  return d;
}

} // namespace hydrodae::water
