#include "hydrodae/math/drive.h"

#include <doctest/doctest.h>

using namespace hydrodae;
using doctest::Approx;

namespace {

Drive full() {
  Drive d;
  d.constant = 0.3;
  d.rate = -0.2;
  d.amplitude = 1.5;
  d.period = 4.0;
  d.phase = 0.7;
  d.ramp = 3.0;
  d.time = {0.0, 1.0, 2.5, 6.0};
  d.values = {0.0, 2.0, -1.0, 1.0};
  d.prepare();
  return d;
}

} // namespace

TEST_CASE("a drive without values stays at zero") {
  const Drive drive;
  CHECK(drive(3.0) == std::array<double, 3>{0.0, 0.0, 0.0});
}

TEST_CASE("a drive adds its parts") {
  Drive d;
  d.constant = 0.5;
  d.rate = 0.1;
  d.amplitude = 2.0;
  d.period = 4.0;
  d.phase = pi / 2;
  const double w = pi / 2; // 2 cos(w t), w = 2 pi / 4
  CHECK(d(0.0)[0] == Approx(2.5));
  CHECK(d(2.0)[0] == Approx(0.5 + 0.2 - 2.0));
  CHECK(d(1.0)[1] == Approx(0.1 - 2.0 * w));
  CHECK(d(0.0)[2] == Approx(-2.0 * w * w));
  d.ramp = 8.0; // (1 - cos(pi t / 8)) / 2: nothing at 0, half at 4, all from 8 on
  CHECK(d(0.0)[0] == Approx(0.5));
  CHECK(d(4.0)[0] == Approx(0.9 + 0.5 * 2.0));
  CHECK(d(8.0)[0] == Approx(1.3 + 2.0));
  CHECK(d(12.0)[0] == Approx(1.7 + 2.0));
}

TEST_CASE("the derivatives of a drive are those of its value") {
  const Drive d = full();
  const double h = 1e-4;
  for (const double t : {0.2, 0.99, 1.01, 2.0, 2.9, 3.1, 5.5}) {
    CAPTURE(t);
    const auto before = d(t - h), here = d(t), after = d(t + h);
    CHECK(here[1] == Approx((after[0] - before[0]) / (2 * h)).epsilon(1e-6));
    CHECK(here[2] == Approx((after[1] - before[1]) / (2 * h)).epsilon(1e-6));
  }
}

TEST_CASE("the ramp ends smoothly to its first derivative") {
  const Drive d = full();
  const auto before = d(3.0 - 1e-9), after = d(3.0 + 1e-9);
  CHECK(before[0] == Approx(after[0]).epsilon(1e-7));
  CHECK(before[1] == Approx(after[1]).epsilon(1e-7));
}

TEST_CASE("a table is a natural cubic spline") {
  Drive d;
  d.time = {0, 1, 2};
  d.values = {0, 1, 0};
  d.prepare();
  // by hand: second derivatives 0, -3, 0, so 3/2 t - t^3 / 2 on [0, 1], mirrored about 1
  for (const double t : {0.0, 0.25, 0.5, 1.0})
    for (const double mirrored : {t, 2.0 - t})
      CHECK(d(mirrored)[0] == Approx(1.5 * t - 0.5 * t * t * t));
  CHECK(d(0.5)[1] == Approx(1.5 - 1.5 * 0.25));
  CHECK(d(1.0)[2] == Approx(-3.0));
  d.time = {-1, 0, 3, 4};
  d.values = {-2, 0, 6, 8};
  d.prepare();
  CHECK(d(1.7)[0] == Approx(3.4));
  CHECK(d(1.7)[1] == Approx(2.0));
  CHECK(d(1.7)[2] == Approx(0.0));
}
