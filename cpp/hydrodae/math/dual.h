#pragma once
/// Dual numbers a + b e with e^2 = 0: exact directional derivatives. The test oracle of the
/// hand-written Jacobians; the kernel itself runs on double.

#include <cmath>

#include "hydrodae/core/types.h"

namespace hydrodae {

struct Dual {
  double a = 0.0; ///< value
  double b = 0.0; ///< derivative

  Dual() = default;
  Dual(double value) : a(value) {} // NOLINT: a number is a dual number
  Dual(double value, double derivative) : a(value), b(derivative) {}

  Dual& operator+=(const Dual& y) { return *this = {a + y.a, b + y.b}; }
  Dual& operator-=(const Dual& y) { return *this = {a - y.a, b - y.b}; }
  Dual& operator*=(const Dual& y) { return *this = {a * y.a, a * y.b + b * y.a}; }
  Dual& operator/=(const Dual& y) { return *this = {a / y.a, (b - a / y.a * y.b) / y.a}; }
  friend Dual operator+(Dual x, const Dual& y) { return x += y; }
  friend Dual operator-(Dual x, const Dual& y) { return x -= y; }
  friend Dual operator*(Dual x, const Dual& y) { return x *= y; }
  friend Dual operator/(Dual x, const Dual& y) { return x /= y; }
  friend Dual operator-(const Dual& x) { return {-x.a, -x.b}; }
  friend bool operator<(const Dual& x, const Dual& y) { return x.a < y.a; }
  friend bool operator>(const Dual& x, const Dual& y) { return x.a > y.a; }
  friend bool operator<=(const Dual& x, const Dual& y) { return x.a <= y.a; }
  friend bool operator>=(const Dual& x, const Dual& y) { return x.a >= y.a; }
  friend bool operator==(const Dual& x, const Dual& y) { return x.a == y.a; }
  friend bool operator!=(const Dual& x, const Dual& y) { return x.a != y.a; }
};

inline Dual sqrt(const Dual& x) {
  const double s = std::sqrt(x.a);
  return {s, 0.5 * x.b / s};
}
inline Dual sin(const Dual& x) { return {std::sin(x.a), std::cos(x.a) * x.b}; }
inline Dual cos(const Dual& x) { return {std::cos(x.a), -std::sin(x.a) * x.b}; }
inline Dual exp(const Dual& x) {
  const double e = std::exp(x.a);
  return {e, e * x.b};
}
inline Dual log(const Dual& x) { return {std::log(x.a), x.b / x.a}; }
inline Dual atan2(const Dual& y, const Dual& x) {
  return {std::atan2(y.a, x.a), (x.a * y.b - y.a * x.b) / (x.a * x.a + y.a * y.a)};
}
inline Dual abs(const Dual& x) { return x.a < 0 ? -x : x; }

} // namespace hydrodae

namespace Eigen {
template <> struct NumTraits<hydrodae::Dual> : NumTraits<double> {
  using Real = hydrodae::Dual;
  using NonInteger = hydrodae::Dual;
  using Nested = hydrodae::Dual;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 2,
    MulCost = 4
  };
};
} // namespace Eigen
