#include "hydrodae/math/cardinal_splines.h"

#include <doctest/doctest.h>

#include <cmath>

using hydrodae::CardinalSplines;
using hydrodae::Dual;

namespace {

/// Blend of f at the places, by the functions at x: value and first two derivatives.
template <class F>
std::array<double, 3> blend(const std::vector<double>& places, double x, const F& f) {
  const CardinalSplines splines(places);
  std::vector<double> w(places.size()), slope(w), curvature(w);
  splines.values(x, w.data(), slope.data());
  splines.curvatures(x, curvature.data());
  std::array<double, 3> out{};
  for (std::size_t m = 0; m < places.size(); ++m) {
    out[0] += w[m] * f(places[m]);
    out[1] += slope[m] * f(places[m]);
    out[2] += curvature[m] * f(places[m]);
  }
  return out;
}

} // namespace

TEST_CASE("cardinal splines blend a cubic exactly") {
  const std::vector<double> places = {-2.0, -1.1, 0.3, 0.9, 2.5};
  const auto f = [](double x) { return 1.0 + x * (0.5 + x * (-0.3 + 0.2 * x)); };
  for (double x : {-2.0, -1.7, -1.1, 0.0, 0.5, 2.4, 2.5}) {
    const auto [value, slope, curvature] = blend(places, x, f);
    CHECK(value == doctest::Approx(f(x)).epsilon(1e-12));
    CHECK(slope == doctest::Approx(0.5 + x * (-0.6 + 0.6 * x)).epsilon(1e-11));
    CHECK(curvature == doctest::Approx(-0.6 + 1.2 * x).epsilon(1e-10));
  }
}

TEST_CASE("cardinal splines of two and three places are a line and a parabola") {
  const auto f = [](double x) { return x * x; };
  CHECK(blend({1.0, 3.0}, 2.0, f)[0] == doctest::Approx(5.0));
  CHECK(blend({-1.0, 1.0, 4.0}, 3.0, f)[0] == doctest::Approx(9.0));
  CHECK(blend({-1.0, 1.0, 4.0}, 3.0, f)[2] == doctest::Approx(2.0));
}

TEST_CASE("cardinal splines go on along their tangents") {
  const auto f = [](double x) { return std::exp(x); };
  const std::vector<double> places = {0.0, 0.5, 1.0, 1.5};
  const auto [end, slope, bend] = blend(places, 1.5, f);
  const auto [value, along, curvature] = blend(places, 2.0, f);
  CHECK(value == doctest::Approx(end + 0.5 * slope).epsilon(1e-12));
  CHECK(along == doctest::Approx(slope).epsilon(1e-12));
  CHECK(curvature == 0.0);
}

TEST_CASE("cardinal splines of dual numbers have the slope as derivative") {
  const CardinalSplines splines({-1.0, 0.0, 0.4, 1.0});
  for (double x : {-1.3, -0.2, 0.4, 0.7, 1.6}) {
    Dual w[4], dual_slope[4];
    splines.values(Dual(x, 1.0), w, dual_slope);
    double value[4], slope[4], curvature[4];
    splines.values(x, value, slope);
    splines.curvatures(x, curvature);
    for (int m = 0; m < 4; ++m) {
      CHECK(w[m].a == doctest::Approx(value[m]));
      CHECK(w[m].b == doctest::Approx(slope[m]));
      CHECK(dual_slope[m].b == doctest::Approx(curvature[m]));
    }
  }
}
