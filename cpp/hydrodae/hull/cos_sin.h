#pragma once
/// Cosines and sines of many angles at once, in operations that compilers and Eigen vectorise.

#include <Eigen/Core>

namespace hydrodae::hull {

/// cos and sin of angles of at most 1e5 rad, with an absolute error below 4e-15.
///
/// The angle without whole turns, in [-pi, pi], is divided by 8; the Taylor series of sin and of
/// 1 - cos, exact to rounding up to pi/8, then double the angle three times:
///   1 - cos 2a = 2 sin^2 a,   sin 2a = 2 sin a cos a.
template <class Array> void cos_sin(const Array& angle, Array& cosine, Array& sine) {
  // 2 pi = high + low; 2^20 times `high` is still exact.
  constexpr double high = 6746518852.0 / 1073741824.0;
  constexpr double low = (6.28318530717958647692 - high) + 2.4492935982947064e-16;
  constexpr double to_integer = 6755399441055744.0; // 1.5 2^52: the sum has no fraction
  Array turns = angle * (1.0 / 6.28318530717958647692) + to_integer;
  turns -= to_integer;
  const Array a = 0.125 * ((angle - turns * high) - turns * low);
  const Array q = a * a;
  Array s =
      a +
      a * q *
          (-1.0 / 6 +
           q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880 + q * (-1.0 / 39916800 +
                                                                        q * (1.0 / 6227020800))))));
  Array v =
      q * (1.0 / 2 +
           q * (-1.0 / 24 + q * (1.0 / 720 + q * (-1.0 / 40320 +
                                                  q * (1.0 / 3628800 + q * (-1.0 / 479001600))))));
  for (int k = 0; k < 3; ++k) {
    const Array t = 2.0 * s;
    v = (1.0 - v).eval();
    const Array next = t * v;
    v = t * s;
    s = next;
  }
  cosine = 1.0 - v;
  sine = s;
}

} // namespace hydrodae::hull
