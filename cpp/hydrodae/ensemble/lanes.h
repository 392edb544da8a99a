#pragma once
/// Numbers of several runs side by side: the scalar of a march of many seas. Each operation acts on
/// every lane by itself, so that a lane is computed as it would be alone.

#include <cmath>

#include "hydrodae/core/types.h"

namespace hydrodae::ensemble {

/// A function whose calls become a part of it, compiled for the plain processor and for wider
/// registers; the widest that the machine has is taken at run time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__)
#define HYDRODAE_WIDE [[gnu::flatten, gnu::target_clones("default", "avx2", "avx512f")]]
#else
#define HYDRODAE_WIDE
#endif

inline constexpr int width = 8; ///< lanes: numbers in the longest register

struct alignas(sizeof(double) * width) Lanes {
  double lane[width];

  Lanes() = default;
  Lanes(double x) { // NOLINT: a number is the same in all lanes
    for (double& a : lane)
      a = x;
  }
  double& operator[](int k) { return lane[k]; }
  double operator[](int k) const { return lane[k]; }

  Lanes& operator+=(const Lanes& y) {
    for (int k = 0; k < width; ++k)
      lane[k] += y.lane[k];
    return *this;
  }
  Lanes& operator-=(const Lanes& y) {
    for (int k = 0; k < width; ++k)
      lane[k] -= y.lane[k];
    return *this;
  }
  Lanes& operator*=(const Lanes& y) {
    for (int k = 0; k < width; ++k)
      lane[k] *= y.lane[k];
    return *this;
  }
  Lanes& operator/=(const Lanes& y) {
    for (int k = 0; k < width; ++k)
      lane[k] /= y.lane[k];
    return *this;
  }
  friend Lanes operator+(const Lanes& x, const Lanes& y) {
    Lanes out = x;
    return out += y;
  }
  friend Lanes operator-(const Lanes& x, const Lanes& y) {
    Lanes out = x;
    return out -= y;
  }
  friend Lanes operator*(const Lanes& x, const Lanes& y) {
    Lanes out = x;
    return out *= y;
  }
  friend Lanes operator/(const Lanes& x, const Lanes& y) {
    Lanes out = x;
    return out /= y;
  }
  friend Lanes operator-(const Lanes& x) {
    Lanes out(0.0);
    return out -= x;
  }
};

/// f of each lane.
template <class F> Lanes each(const Lanes& x, F&& f) {
  Lanes out;
  for (int k = 0; k < width; ++k)
    out.lane[k] = f(x.lane[k]);
  return out;
}

inline Lanes sqrt(const Lanes& x) {
  return each(x, [](double a) { return std::sqrt(a); });
}
inline Lanes abs(const Lanes& x) {
  return each(x, [](double a) { return std::abs(a); });
}

/// A value in all lanes and its rate of change: what a constraint row has while the bodies move.
struct Moving {
  Lanes a; ///< value
  Lanes b; ///< rate

  Moving() = default;
  Moving(double value) : a(value), b(0.0) {} // NOLINT: a number does not move
  Moving(const Lanes& value, const Lanes& rate) : a(value), b(rate) {}

  Moving& operator+=(const Moving& y) {
    a += y.a;
    b += y.b;
    return *this;
  }
  Moving& operator-=(const Moving& y) {
    a -= y.a;
    b -= y.b;
    return *this;
  }
  Moving& operator*=(const Moving& y) { return *this = {a * y.a, a * y.b + b * y.a}; }
  Moving& operator/=(const Moving& y) { return *this = {a / y.a, (b - a / y.a * y.b) / y.a}; }
  friend Moving operator+(const Moving& x, const Moving& y) {
    Moving out = x;
    return out += y;
  }
  friend Moving operator-(const Moving& x, const Moving& y) {
    Moving out = x;
    return out -= y;
  }
  friend Moving operator*(const Moving& x, const Moving& y) {
    Moving out = x;
    return out *= y;
  }
  friend Moving operator/(const Moving& x, const Moving& y) {
    Moving out = x;
    return out /= y;
  }
  friend Moving operator-(const Moving& x) { return {-x.a, -x.b}; }
};

} // namespace hydrodae::ensemble

namespace Eigen {
template <> struct NumTraits<hydrodae::ensemble::Lanes> : NumTraits<double> {
  using Real = hydrodae::ensemble::Lanes;
  using NonInteger = hydrodae::ensemble::Lanes;
  using Nested = hydrodae::ensemble::Lanes;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
template <> struct NumTraits<hydrodae::ensemble::Moving> : NumTraits<double> {
  using Real = hydrodae::ensemble::Moving;
  using NonInteger = hydrodae::ensemble::Moving;
  using Nested = hydrodae::ensemble::Moving;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 2,
    AddCost = 2,
    MulCost = 4
  };
};
} // namespace Eigen
