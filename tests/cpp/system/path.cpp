/// The curve of a path joint against a circle, and where it starts.

#include "hydrodae/joint/path.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace hydrodae;

namespace {

/// Part of a circle of radius 2 about the origin in the x-z plane.
joint::Path arc_of_circle(int points) {
  std::vector<Vector3> list;
  for (int k = 0; k < points; ++k) {
    const double angle = -1.0 + 2.0 * k / (points - 1);
    list.emplace_back(2.0 * std::sin(angle), 0.0, -2.0 * std::cos(angle));
  }
  return joint::Path(list);
}

} // namespace

TEST_CASE("a fine path through points of a circle is that circle") {
  const joint::Path path = arc_of_circle(41);
  CHECK(path.length() == doctest::Approx(4.0).epsilon(1e-4));
  for (double angle : {-0.6, -0.013, 0.3, 0.5}) {
    const Vector3 radial(std::sin(angle), 0.0, -std::cos(angle));
    const auto arc = path.arc<double>(2.1 * radial + Vector3(0.0, 0.05, 0.0));
    CHECK(arc.value == doctest::Approx(2.0 * (angle + 1.0)).epsilon(1e-3));
    // The nearest point moves as much less as the circle is nearer to its centre.
    CHECK(arc.gradient.norm() == doctest::Approx(2.0 / 2.1).epsilon(1e-2));
    const double a = path.across<double>(0, 2.1 * radial).value,
                 b = path.across<double>(1, 2.1 * radial).value;
    CHECK(std::hypot(a, b) == doctest::Approx(0.1).epsilon(1e-2));
    CHECK(std::abs(path.across<double>(0, 2.0 * radial).value) < 1e-4);
  }
}

TEST_CASE("arc length and place are each other's inverse, also beyond the ends") {
  const joint::Path path = arc_of_circle(9);
  for (double arc : {-1.5, 0.0, 0.7, 2.0, 3.99, 6.0}) {
    const auto [point, tangent] = path.at_arc(arc);
    CHECK(path.arc<double>(point).value == doctest::Approx(arc).epsilon(1e-11));
    CHECK(tangent.norm() == doctest::Approx(1.0));
    CHECK(path.arc<double>(point).gradient.dot(tangent) == doctest::Approx(1.0));
  }
}
