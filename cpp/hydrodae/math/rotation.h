#pragma once
/// Rotations: unit quaternions (w, x, y, z), rotation vectors, and their derivatives. Angular
/// velocities and virtual rotations are in body axes: R' = R [w]x, delta R = R [delta phi]x.

#include <cmath>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// [a]x with [a]x b = a x b.
template <class S> Mat3<S> skew(const Vec3<S>& a) {
  Mat3<S> m;
  m << S(0), -a[2], a[1], a[2], S(0), -a[0], -a[1], a[0], S(0);
  return m;
}

/// R(p / |p|) of a quaternion (w, x, y, z): defined off the unit sphere, constant along p.
template <class S> Mat3<S> rotation_matrix(const Vec4<S>& p) {
  const S w = p[0], x = p[1], y = p[2], z = p[3];
  const S s = S(2) / (w * w + x * x + y * y + z * z);
  Mat3<S> r;
  r << S(1) - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y), //
      s * (x * y + w * z), S(1) - s * (x * x + z * z), s * (y * z - w * x),  //
      s * (x * z - w * y), s * (y * z + w * x), S(1) - s * (x * x + y * y);
  return r;
}

/// Rotation by `angle` about the coordinate axis 0, 1 or 2.
template <class S> Mat3<S> rotation_about_axis(int axis, const S& angle) {
  using std::cos;
  using std::sin;
  const S c = cos(angle), s = sin(angle);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Mat3<S> r = Mat3<S>::Zero();
  r(axis, axis) = S(1);
  r(j, j) = c;
  r(k, k) = c;
  r(j, k) = -s;
  r(k, j) = s;
  return r;
}

/// The 4x3 matrix L(p) of p o (0, a) = L(p) a, so that p' = 1/2 L(p) w. Since L^T L = |p|^2 I and
/// L^T p = 0, it also gives delta phi = 2 L(p)^T delta p / |p|^2.
template <class S> Eigen::Matrix<S, 4, 3> quaternion_rate_matrix(const Vec4<S>& p) {
  Eigen::Matrix<S, 4, 3> l;
  l << -p[1], -p[2], -p[3], //
      p[0], -p[3], p[2],    //
      p[3], p[0], -p[1],    //
      -p[2], p[1], p[0];
  return l;
}

/// The 4x4 matrix Q(a) of p o (0, a) = Q(a) p.
inline Eigen::Matrix4d quaternion_right_matrix(const Vector3& a) {
  Eigen::Matrix4d m;
  m << 0, -a[0], -a[1], -a[2], //
      a[0], 0, a[2], -a[1],    //
      a[1], -a[2], 0, a[0],    //
      a[2], a[1], -a[0], 0;
  return m;
}

/// Rotation vector (angle times axis, angle in [0, pi]) of a quaternion of any norm.
template <class S> Vec3<S> rotation_vector(const Vec4<S>& p) {
  using std::atan2;
  using std::sqrt;
  const S sign = p[0] < S(0) ? S(-1) : S(1); // p and -p are the same rotation
  const Vec3<S> v = sign * p.template tail<3>();
  const S w = sign * p[0];
  const S v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const S t2 = v2 / (w * w);
  if (w > S(0) && t2 < S(1e-4)) { // 2 atan(t)/t by its series: error below t^10/11
    const S series = S(1) - t2 * (S(1.0 / 3) - t2 * (S(1.0 / 5) - t2 * (S(1.0 / 7) - t2 / S(9))));
    return (S(2) * series / w) * v;
  }
  const S norm = sqrt(v2);
  return (S(2) * atan2(norm, w) / norm) * v;
}

/// Quaternion (w, x, y, z) of a rotation matrix, not of unit norm: the row of q q^T, scaled, whose
/// diagonal is the largest (Shepperd, J. Guidance and Control 1 (1978) 223).
template <class S> Vec4<S> quaternion_of(const Mat3<S>& R) {
  const S trace = R(0, 0) + R(1, 1) + R(2, 2);
  int largest = 3; // 3: w
  for (int k = 0; k < 3; ++k)
    if (R(k, k) > (largest == 3 ? trace : R(largest, largest)))
      largest = k;
  Vec4<S> p;
  if (largest == 3) {
    p << S(1) + trace, R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
    return p;
  }
  const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
  p[0] = R(k, j) - R(j, k);
  p[1 + i] = S(1) + R(i, i) - R(j, j) - R(k, k);
  p[1 + j] = R(j, i) + R(i, j);
  p[1 + k] = R(k, i) + R(i, k);
  return p;
}

/// Unit quaternion of a rotation vector.
inline Vector4 quaternion_from_rotation_vector(const Vector3& theta) {
  const double half = 0.5 * theta.norm();
  const double s = half < 1e-6 ? 0.5 * (1.0 - half * half / 6.0) : 0.5 * std::sin(half) / half;
  Vector4 p;
  p << std::cos(half), s * theta;
  return p;
}

/// d(rotation vector)/d(phi), phi in body axes: J = I + [t]x/2 + (1 - h cot h) [t/|t|]x^2, h =
/// |t|/2 (Sola, Deray, Atchuthan, arXiv:1812.01537, eq. 144: inverse right Jacobian of SO(3)). Also
/// beyond half a turn; at full turns it has no value across the axis.
inline Matrix3 rotation_vector_gradient(const Vector3& theta) {
  const double angle = theta.norm();
  const Matrix3 k = skew<double>(theta);
  const double half = 0.5 * angle;
  const double c = angle < 1e-3 ? 1.0 / 12.0 + angle * angle / 720.0
                                : (1.0 - half / std::tan(half)) / (angle * angle);
  return Matrix3::Identity() + 0.5 * k + c * k * k;
}

/// Cross product without the complex conjugation and the static checks of Eigen's.
template <class S> Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Dot product without complex conjugation.
template <class S> S dot(const Vec3<S>& a, const Vec3<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace hydrodae
