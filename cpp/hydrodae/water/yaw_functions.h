#pragma once
/// Functions of the yaw psi of a body that its excitation is composed of.
///
///   all headings                     1, cos psi, sin psi, cos 2 psi, sin 2 psi ...
///   for |psi - middle| <= half       Chebyshev polynomials T_m((psi - middle) / half), continued
///                                     along their tangents so that Newton's method converges
///   if the yaw does not matter       1 alone, with an infinite interval
///
/// All have a continuous derivative.

#include <array>
#include <cmath>

#include "hydrodae/core/types.h"
#include "hydrodae/math/dual.h"

namespace hydrodae::water {

struct YawFunctions {
  static constexpr int most = 129;
  int count = 1;
  bool round = false;
  double middle = 0.0, half = INFINITY; ///< interval [rad]

  template <class S> using Values = std::array<S, most>;

  /// Distance of psi from the interval [rad]; negative inside.
  double outside(double psi) const {
    return round ? -INFINITY : std::abs(std::remainder(psi - middle, 2.0 * pi)) - half;
  }

  /// Values of the functions (count,), from cos psi and sin psi.
  template <class S> void values(const S& c, const S& s, Values<S>& out) const {
    out[0] = S(1);
    if (count == 1)
      return;
    if (round) {
      S re = c, im = s;
      for (int k = 1; k < count; k += 2) {
        out[index(k)] = re;
        if (k + 1 < count)
          out[index(k + 1)] = im;
        const S next = re * c - im * s;
        im = re * s + im * c;
        re = next;
      }
      return;
    }
    const S x = place(c, s);
    const double end = x > S(0) ? 1.0 : -1.0;
    if (S(end) * x > S(1)) {
      const S beyond = S(end) * x - S(1);
      double sign = 1.0;
      for (int m = 1; m < count; ++m)
        out[index(m)] = S(sign *= end) * (S(1) + S(m * m) * beyond);
      return;
    }
    out[1] = x;
    for (int m = 2; m < count; ++m)
      out[index(m)] = S(2) * x * out[index(m - 1)] - out[index(m - 2)];
  }

  /// Derivatives of the functions by psi [1/rad].
  void slopes(double c, double s, Values<double>& out) const {
    Values<Dual> d;
    values(Dual(c, -s), Dual(s, c), d);
    for (int k = 0; k < count; ++k)
      out[index(k)] = d[index(k)].b;
  }

private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  template <class S> S place(const S& c, const S& s) const {
    using std::atan2;
    const S cm(std::cos(middle)), sm(std::sin(middle));
    return atan2(s * cm - c * sm, c * cm + s * sm) / S(half);
  }
};

} // namespace hydrodae::water
