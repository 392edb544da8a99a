/// Coefficients of the implicit Runge-Kutta methods.

#include "hydrodae/integrate/runge_kutta.h"

#include <doctest/doctest.h>

#include <cmath>

namespace {

using namespace hydrodae;
using integrate::Family;

/// Largest error of sum_i b_i c_i^(k-1) = 1/k, k = 1 .. order.
double quadrature_error(const integrate::RungeKutta& rk) {
  double error = 0.0;
  for (int k = 1; k <= rk.order; ++k)
    error = std::max(error, std::abs(rk.b.dot(rk.c.array().pow(k - 1).matrix()) - 1.0 / k));
  return error;
}

/// Value of the stability function at z -> -infinity: 1 - b^T A^-1 1.
double at_infinity(const integrate::RungeKutta& rk) {
  return 1.0 - rk.b.dot(rk.a_inverse * VectorX::Ones(rk.stages));
}

} // namespace

TEST_CASE("the families have their order of quadrature and damp as they should") {
  for (int s = 1; s <= 10; ++s) {
    const auto radau = integrate::make_runge_kutta(Family::radau_iia, s);
    CHECK(quadrature_error(radau) < 1e-14);
    CHECK(std::abs(at_infinity(radau)) < 1e-10);
    CHECK(radau.c[s - 1] == doctest::Approx(1.0));
    const auto gauss = integrate::make_runge_kutta(Family::gauss, s);
    CHECK(quadrature_error(gauss) < 1e-14);
    CHECK(std::abs(std::abs(at_infinity(gauss)) - 1.0) < 1e-9);
    if (s < 2)
      continue;
    const auto lobatto = integrate::make_runge_kutta(Family::lobatto_iiic, s);
    CHECK(quadrature_error(lobatto) < 1e-14);
    CHECK(std::abs(at_infinity(lobatto)) < 1e-9);
  }
}

TEST_CASE("three stages of Radau IIA are those of the book") {
  // Hairer and Wanner, Solving ODEs II (1996), table IV.5.6.
  const auto rk = integrate::make_runge_kutta(Family::radau_iia, 3);
  const double r = std::sqrt(6.0);
  CHECK(rk.c[0] == doctest::Approx((4 - r) / 10));
  CHECK(rk.a(0, 0) == doctest::Approx((88 - 7 * r) / 360));
  CHECK(rk.a(0, 2) == doctest::Approx((-2 + 3 * r) / 225));
  CHECK(rk.a(2, 2) == doctest::Approx(1.0 / 9));
}

TEST_CASE("the transformation diagonalises in blocks") {
  for (int s : {2, 3, 5, 7, 10}) {
    const auto rk = integrate::make_runge_kutta(Family::radau_iia, s);
    MatrixX blocks = MatrixX::Zero(s, s);
    int k = 0;
    for (double value : rk.real)
      blocks(k, k) = value, ++k;
    for (const auto& value : rk.pairs) {
      blocks.block<2, 2>(k, k) << value.real(), -value.imag(), value.imag(), value.real();
      k += 2;
    }
    CHECK(k == s);
    CHECK((rk.T * blocks * rk.T_inverse - rk.a_inverse).norm() < 1e-9 * rk.a_inverse.norm());
  }
}
