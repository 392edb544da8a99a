/// Elementary functions of vectors of numbers against those of the standard library.

#include "hydrodae/math/registers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace hydrodae;
using simd::Register16;

TEST_CASE("cosines and sines of many angles") {
  std::mt19937 random(1);
  for (const double range : {0.01, 3.0, 100.0, 1e6}) {
    std::uniform_real_distribution<double> draw(-range, range);
    for (int i = 0; i < 1000; ++i) {
      const Register16 angle{draw(random), draw(random)};
      Register16 c, s;
      simd::cos_sin(angle, c, s);
      for (int k = 0; k < 2; ++k) {
        CHECK(std::abs(c[k] - std::cos(angle[k])) < 4e-16);
        CHECK(std::abs(s[k] - std::sin(angle[k])) < 4e-16);
      }
    }
  }
}

TEST_CASE("exponentials of many numbers") {
  std::mt19937 random(2);
  for (const double range : {0.01, 1.0, 30.0, 700.0}) {
    std::uniform_real_distribution<double> draw(-range, range);
    for (int i = 0; i < 1000; ++i) {
      const Register16 x{draw(random), draw(random)};
      Register16 e;
      simd::exp(x, e);
      for (int k = 0; k < 2; ++k)
        CHECK(std::abs(e[k] / std::exp(x[k]) - 1.0) < 4.5e-16);
    }
  }
  const Register16 far{-1e5, 1e5};
  Register16 e;
  simd::exp(far, e);
  CHECK(e[0] < 1e-300);
  CHECK(std::isfinite(e[1]));
}
