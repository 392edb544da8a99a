/// The first root inside a step: of polynomials with known roots, of margins that jump.

#include "hydrodae/events/locator.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace hydrodae;
using events::first_root;
using events::Margins;

namespace {

/// c (r_1 - t) (r_2 - t) ..., positive before its first root where c is.
double polynomial(double t, const std::vector<double>& roots, double c) {
  for (const double r : roots)
    c *= r - t;
  return c;
}

Margins margin(const std::vector<double>& roots, double c = 1.0) {
  return [=](double t, std::span<double> out) { out[0] = polynomial(t, roots, c); };
}

} // namespace

TEST_CASE("the first root of random polynomials is found, however near the next one is") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 1.0), size(-12.0, 12.0);
  const double t0 = 3.0, t1 = 3.2;
  for (int trial = 0; trial < 4000; ++trial) {
    const int degree = 1 + trial % 8;
    std::vector<double> roots;
    for (int k = 0; k < degree; ++k)
      roots.push_back(t0 + (t1 - t0) * place(random));
    if (degree > 2 && trial % 3 == 0) // two that are near
      roots[1] = roots[0] + 3e-5 * (t1 - t0) * (1.0 + place(random));
    std::sort(roots.begin(), roots.end());
    if (degree > 2 && roots[1] - roots[0] < 2e-5 * (t1 - t0))
      continue; // they count as one that does not cross
    const auto found = first_root(margin(roots, std::pow(10.0, size(random))), 1, t0, t1, degree);
    REQUIRE(found);
    CHECK(found->time == doctest::Approx(roots[0]).epsilon(1e-11));
    CHECK(found->before <= found->time);
    CHECK(found->time - found->before < 1e-14);
  }
}

TEST_CASE("where there is no root none is found") {
  const Margins near = [](double t, std::span<double> out) {
    out[0] = (t - 1.5) * (t - 1.5) + 1e-13;
  };
  CHECK_FALSE(first_root(near, 1, 1.0, 2.0, 4));
  CHECK_FALSE(first_root(margin({2.5}), 1, 1.0, 2.0, 4));
  CHECK_FALSE(first_root([](double t, std::span<double> out) { out[0] = std::cos(t) + 1.01; }, 1,
                         0.0, 6.0, 12));
  CHECK_FALSE(first_root([](double, std::span<double>) {}, 0, 1.0, 2.0, 4));
}

TEST_CASE("roots at the ends of the step") {
  CHECK(first_root(margin({2.0 - 1e-15}), 1, 1.0, 2.0, 4)->time == doctest::Approx(2.0));
  CHECK_FALSE(first_root(margin({1.0}, -1.0), 1, 1.0, 2.0, 4)); // it has just left zero
  // Left with the wrong sign, by an error: it counts from where it is right.
  CHECK_FALSE(first_root(margin({1.001}, -1.0), 1, 1.0, 2.0, 4));
  CHECK(first_root(margin({1.001, 1.7}, -1.0), 1, 1.0, 2.0, 4)->time == doctest::Approx(1.7));
  CHECK(first_root(margin({0.5}), 1, 1.0, 2.0, 4)->time == doctest::Approx(1.0)); // due at once
}

TEST_CASE("a short visit beyond the limit between two samples is seen") {
  // A gap of 1e-4 of the step, of a parabola as deep as 2.5e-9.
  const auto found = first_root(margin({1.43, 1.4301}), 1, 1.0, 2.0, 4);
  REQUIRE(found);
  CHECK(found->time == doctest::Approx(1.43).epsilon(1e-9));
}

TEST_CASE("margins that jump are found where they do") {
  const Margins jumps = [](double t, std::span<double> out) { out[0] = t < 1.2345 ? 3.0 : -0.1; };
  const auto found = first_root(jumps, 1, 1.0, 2.0, 6);
  REQUIRE(found);
  CHECK(found->before < 1.2345);
  CHECK(found->time >= 1.2345);
  CHECK(found->time - found->before < 1e-14);
}

TEST_CASE("of several margins the first is found") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 1.3);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<double> roots(5);
    for (double& r : roots)
      r = place(random);
    const Margins all = [&](double t, std::span<double> out) {
      for (std::size_t k = 0; k < roots.size(); ++k)
        out[k] = (roots[k] - t) * (1.0 + t * t);
    };
    const auto least = std::min_element(roots.begin(), roots.end());
    const auto found = first_root(all, roots.size(), 0.0, 1.0, 4);
    REQUIRE(found.has_value() == (*least <= 1.0));
    if (found) {
      CHECK(found->which == static_cast<std::size_t>(least - roots.begin()));
      CHECK(found->time == doctest::Approx(*least).epsilon(1e-12));
    }
  }
}
