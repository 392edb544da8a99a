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

TEST_CASE("a given order of elimination is kept") {
  // An arrow: dense first row and column, diagonal else.
  constexpr Index n = 6;
  std::vector<Index> start{0}, row;
  std::vector<double> values;
  for (Index column = 0; column < n; ++column) {
    for (Index r = 0; r < n; ++r)
      if (r == column || r == 0 || column == 0) {
        row.push_back(r);
        values.push_back(r == column ? 4.0 + static_cast<double>(r) : 1.0);
      }
    start.push_back(static_cast<Index>(row.size()));
  }
  const linalg::Elimination last{{5, 4, 3, 2, 1, 0}, {5, 4, 3, 2, 1, 0}};
  linalg::SparseLu<double> given(start, row, last), own(start, row);
  std::vector<double> x(n, 1.0), same(n, 1.0);
  for (auto* lu : {&given, &own}) {
    lu->values() = values;
    REQUIRE(lu->factorise());
    lu->solve(lu == &given ? x.data() : same.data());
  }
  for (std::size_t k = 0; k < x.size(); ++k)
    CHECK(x[k] == doctest::Approx(same[k]));
  const linalg::Elimination used = given.elimination();
  CHECK(used.row == last.row);
  CHECK(used.column == last.column);
}
