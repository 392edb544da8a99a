#include "hydrodae/math/band_matrix.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace hydrodae;

TEST_CASE("a band matrix is solved as the dense one is") {
  for (const Index n : {1, 2, 7, 40})
    for (const Index reach : {0, 1, 5, 8}) {
      const MatrixX random = MatrixX::Random(n, n); // no large diagonal: pivots have to be found
      MatrixX dense = MatrixX::Zero(n, n);
      BandMatrix band(n, reach);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
          if (std::abs(i - j) <= reach)
            dense(i, j) = band(i, j) = random(i, j);
      const MatrixX b = MatrixX::Random(n, 2);
      MatrixX x = b;
      REQUIRE(band.factorise());
      band.solve(x);
      const MatrixX expected = dense.fullPivLu().solve(b);
      CHECK((x - expected).norm() <= 1e-9 * expected.norm());
    }
}

TEST_CASE("a singular band matrix is said to be so") {
  BandMatrix band(3, 1);
  band(0, 0) = band(0, 1) = band(1, 0) = band(1, 1) = 1.0;
  CHECK_FALSE(band.factorise());
}
