/// Positive definiteness by levels against the eigenvalues of the dense matrix.

#include "hydrodae/math/definite.h"

#include <complex>
#include <random>

#include "hydrodae/math/dense.h"
#include "support.h"

using namespace hydrodae;

namespace {

/// A random Hermitian matrix with coupling between some unknowns.
struct Sample {
  std::vector<Definite::Place> places;
  std::vector<double> real, imaginary;
  Eigen::MatrixXcd dense; ///< lower triangle

  Sample(Index n, double coupled, bool complex, std::mt19937& random)
      : dense(Eigen::MatrixXcd::Zero(n, n)) {
    std::uniform_real_distribution<double> part(-1.0, 1.0), chance(0.0, 1.0);
    for (Index v = 0; v < n; ++v)
      for (Index u = v; u < n; ++u)
        if (u == v || chance(random) < coupled) {
          places.push_back({u, v});
          real.push_back(part(random));
          imaginary.push_back(complex && u > v ? part(random) : 0.0);
          dense(u, v) = {real.back(), imaginary.back()};
        }
  }
};

} // namespace

TEST_CASE("a matrix is definite on one side of its lowest eigenvalue and not on the other") {
  std::mt19937 random(3);
  for (const Index n : {1, 2, 7, 40, 90})
    for (const double coupled : {0.0, 1.0 / static_cast<double>(n), 0.1, 1.0})
      for (const bool complex : {false, true}) {
        CAPTURE(n);
        CAPTURE(coupled);
        CAPTURE(complex);
        const Sample sample(n, coupled, complex, random);
        const double lowest = lowest_eigenpair(sample.dense).first;
        const Definite definite(n, sample.places);
        const double* imaginary = complex ? sample.imaginary.data() : nullptr;
        CHECK(definite.test(sample.real.data(), imaginary, -lowest + 1e-9));
        CHECK_FALSE(definite.test(sample.real.data(), imaginary, -lowest - 1e-9));
      }
}

TEST_CASE("a chain has as many levels as unknowns, and its eigenvalues are known") {
  const Index n = 200; // 2 on the diagonal, -1 beside it: 2 - 2 cos(k pi / (n + 1))
  std::vector<Definite::Place> places;
  std::vector<double> values;
  for (Index u = 0; u < n; ++u) {
    const Index v = (7 * u + 3) % n, next = (7 * (u + 1) + 3) % n; // in another order
    places.push_back({v, v});
    values.push_back(2.0);
    if (u + 1 < n) {
      places.push_back({std::max(v, next), std::min(v, next)});
      values.push_back(-1.0);
    }
  }
  const double lowest = 2.0 - 2.0 * std::cos(pi / static_cast<double>(n + 1));
  const Definite definite(n, places);
  CHECK(definite.test(values.data(), nullptr, -lowest * (1.0 - 1e-6)));
  CHECK_FALSE(definite.test(values.data(), nullptr, -lowest * (1.0 + 1e-6)));
}
