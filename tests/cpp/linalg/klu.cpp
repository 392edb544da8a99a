/// Sparse LU, real and complex.

#include "hydrodae/linalg/klu.h"

#include <doctest/doctest.h>

using namespace hydrodae;

TEST_CASE("real and complex systems are solved, also after the values change") {
  // [2 1; 1 a], by columns.
  linalg::SparseLu<double> real({0, 2, 4}, {0, 1, 0, 1});
  linalg::SparseLu<std::complex<double>> complex({0, 2, 4}, {0, 1, 0, 1});
  for (double a : {3.0, -1.0, 1e-9}) {
    real.values() = {2.0, 1.0, 1.0, a};
    REQUIRE(real.factorise());
    double b[] = {1.0, 0.0};
    real.solve(b);
    const double det = 2.0 * a - 1.0;
    CHECK(b[0] == doctest::Approx(a / det));
    CHECK(b[1] == doctest::Approx(-1.0 / det));
    const std::complex<double> c{a, 1.0};
    complex.values() = {2.0, 1.0, 1.0, c};
    REQUIRE(complex.factorise());
    std::complex<double> x[] = {1.0, 0.0};
    complex.solve(x);
    CHECK(std::abs(x[0] - c / (2.0 * c - 1.0)) < 1e-14);
    CHECK(std::abs(x[1] + 1.0 / (2.0 * c - 1.0)) < 1e-14);
  }
}

TEST_CASE("a refactorisation whose pivots went bad takes new ones") {
  linalg::SparseLu<double> lu({0, 2, 4}, {0, 1, 0, 1});
  lu.values() = {1.0, 1e-3, 1e-3, 1.0};
  REQUIRE(lu.factorise());
  lu.values() = {1e-18, 1.0, 1.0, 1e-3}; // the old pivot is next to nothing
  REQUIRE(lu.factorise());
  double b[] = {1.0, 2.0};
  lu.solve(b);
  CHECK(b[1] == doctest::Approx(1.0));
  CHECK(b[0] == doctest::Approx(2.0 - 1e-3));
}

TEST_CASE("singular matrices and values that are not finite are told") {
  linalg::SparseLu<double> lu({0, 2, 4}, {0, 1, 0, 1});
  lu.values() = {1.0, 1.0, 1.0, 1.0};
  CHECK_FALSE(lu.factorise());
  lu.values() = {1.0, 1.0, 1.0, NAN};
  CHECK_FALSE(lu.factorise());
}
