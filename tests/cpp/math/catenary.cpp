#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "hydrodae/math/catenary.h"

using namespace hydrodae;

namespace {

Catenary chain(double friction = 0.0) {
  Catenary line;
  line.parts = {{400.0, 1200.0, 5e7}};
  line.bed = true;
  line.friction = friction;
  return line;
}

/// A line of three parts with a clump and a buoy.
Catenary mixed() {
  Catenary line;
  line.parts = {{120.0, 1500.0, 4e8}, {80.0, 20.0, 1e7}, {60.0, 900.0, 4e8}};
  line.loads = {{3e4}, {-5e4}};
  return line;
}

} // namespace

TEST_CASE("a line that reaches the bed straight below and lies in a heap pulls down only") {
  // Z = V / w + V^2 / (2 EA w), H = 0 up to X = L - V / w
  const CatenaryHold found = hold(chain(), 200.0, 50.0);
  CHECK(found.horizontal == 0.0);
  CHECK(found.vertical == doctest::Approx(59964.04313530768).epsilon(1e-12));
  CHECK(found.on_bed == doctest::Approx(350.02996405391025).epsilon(1e-12));
  CHECK(found.stiffness(0, 0) == 0.0);
}

TEST_CASE("a line without weight to speak of is a spring") {
  Catenary line;
  line.parts = {{100.0, 1e-6, 1e6}};
  const CatenaryHold found = hold(line, 60.6, 80.8); // strain 0.01
  CHECK(found.horizontal == doctest::Approx(6000.0).epsilon(1e-9));
  CHECK(found.vertical == doctest::Approx(8000.0).epsilon(1e-8));
}

TEST_CASE("the pull is continuous from slack to taut, and its slope is the stiffness") {
  for (const double friction : {0.0, 0.6}) {
    const Catenary line = chain(friction);
    double before = 0.0;
    for (double X = 300.0; X < 410.0; X += 0.5) {
      const double d = 1e-4;
      const CatenaryHold low = hold(line, X - d, 50.0), high = hold(line, X + d, 50.0),
                         at = hold(line, X, 50.0);
      CHECK(at.horizontal >= before);
      before = at.horizontal;
      CHECK(high.horizontal - low.horizontal <= 2.0 * d * 1e6);
      if (at.horizontal > 1e3)
        CHECK((high.horizontal - low.horizontal) / (2.0 * d) ==
              doctest::Approx(at.stiffness(0, 0)).epsilon(1e-4));
    }
  }
}

TEST_CASE("an upside-down line of the opposite weight is the same line") {
  Catenary heavy, buoyant;
  heavy.parts = {{100.0, 50.0, 1e6}};
  buoyant.parts = {{100.0, -50.0, 1e6}};
  for (const double Z : {-70.0, 0.0, 30.0}) {
    const CatenaryHold a = hold(heavy, 55.0, Z), b = hold(buoyant, 55.0, -Z);
    CHECK(a.horizontal == doctest::Approx(b.horizontal).epsilon(1e-12));
    CHECK(a.vertical == doctest::Approx(-b.vertical).epsilon(1e-12));
  }
}

TEST_CASE("both ends carry the weight of the line and of what hangs on it") {
  const Catenary line = mixed();
  const CatenaryHold found = hold(line, 150.0, 120.0);
  CHECK(found.vertical - found.anchor_vertical ==
        doctest::Approx(120.0 * 1500.0 + 80.0 * 20.0 + 60.0 * 900.0 - 2e4).epsilon(1e-12));
  CHECK(found.anchor_horizontal == found.horizontal);
}

TEST_CASE("cutting a line in two changes nothing") {
  Catenary whole = chain(0.4), cut = whole;
  cut.parts = {{150.0, 1200.0, 5e7}, {90.0, 1200.0, 5e7}, {160.0, 1200.0, 5e7}};
  cut.loads = {{}, {}};
  for (const double X : {340.0, 360.0, 380.0, 392.0, 396.0, 402.0}) {
    const CatenaryHold a = hold(whole, X, 50.0), b = hold(cut, X, 50.0);
    CHECK(a.horizontal == doctest::Approx(b.horizontal).epsilon(1e-11));
    CHECK(a.vertical == doctest::Approx(b.vertical).epsilon(1e-11));
    CHECK(a.anchor_horizontal == doctest::Approx(b.anchor_horizontal).epsilon(1e-9));
  }
}

TEST_CASE("clumps and buoys: every place is met, and without friction the stiffness is symmetric") {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int k = 0; k < 3000; ++k) {
    Catenary line;
    line.bed = k % 2 == 0;
    const int parts = 1 + k % 4;
    for (int i = 0; i < parts; ++i) {
      const bool floats = !line.bed && i % 3 == 1;
      line.parts.push_back({between(10.0, 500.0),
                            (floats ? -1.0 : 1.0) * std::pow(10.0, between(0.0, 4.0)),
                            std::pow(10.0, between(4.0, 9.0))});
      if (i > 0)
        line.loads.push_back({line.bed ? between(0.0, 1e5) : between(-1e5, 1e5)});
    }
    const double L = line.length(), Z = line.bed ? between(0.0, 0.9) * L : between(-0.9, 0.9) * L,
                 X = between(0.0, 1.05) * std::sqrt(L * L - Z * Z);
    const CatenaryHold found = hold(line, X, Z);
    REQUIRE(std::isfinite(found.horizontal));
    if (found.horizontal == 0.0)
      continue;
    const CatenaryReach there = reach(line, found.horizontal, found.vertical);
    CHECK(std::hypot(there.X - X, there.Z - Z) < 1e-10 * L);
    CHECK(found.stiffness(0, 1) == doctest::Approx(found.stiffness(1, 0)).epsilon(1e-6));
  }
}

TEST_CASE("the profile ends at the anchor and at the fairlead") {
  const Catenary line = chain(1.0);
  const CatenaryHold found = hold(line, 385.0, 50.0);
  const std::array<double, 3> s{0.0, 300.0, 400.0};
  const std::vector<LinePoint> points = profile(line, found, 385.0, s);
  CHECK(points[0].x == doctest::Approx(0.0));
  CHECK(points[0].tension == doctest::Approx(0.0));
  CHECK(points[1].x == doctest::Approx(300.12376460806934).epsilon(1e-9));
  CHECK(points[1].z == doctest::Approx(0.737877751713082).epsilon(1e-7));
  CHECK(points[1].tension == doctest::Approx(122613.16208315105).epsilon(1e-9));
  CHECK(points[2].x == doctest::Approx(385.0).epsilon(1e-12));
  CHECK(points[2].z == doctest::Approx(50.0).epsilon(1e-12));
}

TEST_CASE("a fairlead below the bed has no answer") {
  CHECK(std::isnan(hold(chain(), 300.0, -1.0).horizontal));
}

TEST_CASE("at the surface: forces are derivatives of the energy, and their slopes are exact") {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  int crossing = 0;
  for (int k = 0; k < 2000; ++k) {
    Catenary line;
    const int parts = 1 + k % 3;
    for (int i = 0; i < parts; ++i) {
      const double weight = between(100.0, 2000.0);
      line.parts.push_back({between(30.0, 200.0), weight, std::pow(10.0, between(6.0, 9.0)),
                            weight * between(0.0, 5.0)});
      if (i > 0) {
        const double lift = between(0.0, 3e5);
        line.loads.push_back({between(-1.0, 0.2) * lift, lift, between(0.5, 4.0)});
      }
    }
    const double L = line.length(), Z = between(-0.9, 0.9) * L,
                 X = between(0.1, 1.02) * std::sqrt(L * L - Z * Z),
                 above = between(std::min(0.0, Z), std::max(0.0, Z)) + between(-5.0, 5.0);
    const CatenaryHold at = hold(line, X, Z, above);
    REQUIRE(std::isfinite(at.horizontal));
    if (at.horizontal < 1.0)
      continue;
    ++crossing;
    const auto stored = [&](double x, double z, double y) {
      return energy(line, hold(line, x, z, y), x, z, y);
    };
    const double d = 1e-4;
    const auto slope = [&](double dx, double dz, double dy) {
      return (stored(X + d * dx, Z + d * dz, above + d * dy) -
              stored(X - d * dx, Z - d * dz, above - d * dy)) /
             (2.0 * d);
    };
    const double scale = 1e-5 * (at.tension() + std::abs(at.anchor_vertical)) +
                         1e-12 * std::abs(stored(X, Z, above)) / d;
    CAPTURE(k);
    CHECK(std::abs(slope(1, 0, 0) - at.horizontal) < scale);
    CHECK(std::abs(slope(0, 1, 1) - at.vertical) < scale);         // the fairlead goes up
    CHECK(std::abs(slope(0, -1, 0) + at.anchor_vertical) < scale); // the anchor goes up
    const CatenaryHold up = hold(line, X, Z - d, above), down = hold(line, X, Z + d, above),
                       b_up = hold(line, X, Z + d, above + d),
                       b_down = hold(line, X, Z - d, above - d);
    const double K = 1e-4 * (std::abs(at.stiffness(1, 1)) + std::abs(at.by_anchor[1]) +
                             std::abs(at.stiffness(0, 0)));
    CHECK(std::abs((down.anchor_vertical - up.anchor_vertical) / (2.0 * d) - at.anchor_stiffness) <
          K);
    CHECK(std::abs((down.vertical - up.vertical) / (2.0 * d) - at.by_anchor[1]) < K);
    CHECK(std::abs((down.horizontal - up.horizontal) / (2.0 * d) - at.by_anchor[0]) < K);
    CHECK(std::abs((b_up.vertical - b_down.vertical) / (2.0 * d) - at.stiffness(1, 1)) < K);
    CHECK(std::abs((b_up.anchor_vertical - b_down.anchor_vertical) / (2.0 * d) - at.by_anchor[1]) <
          K);
    CHECK(std::abs(at.stiffness(0, 1) - at.stiffness(1, 0)) < K);
  }
  CHECK(crossing > 1000);
}

TEST_CASE("cut at the surface, a line on a bed is one of two weights") {
  for (const double friction : {0.0, 0.7})
    for (const double X : {330.0, 370.0, 385.0, 393.0}) {
      Catenary line = chain(friction);
      line.parts[0].buoyancy = 900.0;
      const double above = 12.0;
      const CatenaryHold found = hold(line, X, 50.0, above);
      const CatenaryReach at = reach(line, std::max(found.horizontal, 1e-3), found.vertical, above);
      double low = 0.0, high = 400.0; // unstretched length below the surface
      for (int k = 0; k < 200; ++k) {
        const double s = 0.5 * (low + high);
        (profile(line, found, X, std::array{s}, above)[0].z < 50.0 - above ? low : high) = s;
      }
      Catenary cut = chain(friction);
      cut.parts = {{low, 1200.0, 5e7}, {400.0 - low, 2100.0, 5e7}};
      cut.loads = {{}};
      const CatenaryHold same = hold(cut, X, 50.0);
      CHECK(found.horizontal == doctest::Approx(same.horizontal).epsilon(1e-9));
      CHECK(found.vertical == doctest::Approx(same.vertical).epsilon(1e-9));
      CHECK(found.anchor_horizontal == doctest::Approx(same.anchor_horizontal).epsilon(1e-8));
      CHECK(at.on_bed == doctest::Approx(same.on_bed).epsilon(1e-6));
      const double d = 1e-4;
      const CatenaryHold a = hold(line, X - d, 50.0, above), b = hold(line, X + d, 50.0, above),
                         u = hold(line, X, 50.0 - d, above - d),
                         v = hold(line, X, 50.0 + d, above + d);
      CHECK((b.vertical - a.vertical) / (2.0 * d) ==
            doctest::Approx(found.stiffness(1, 0)).epsilon(1e-5));
      CHECK((v.vertical - u.vertical) / (2.0 * d) ==
            doctest::Approx(found.stiffness(1, 1)).epsilon(1e-5));
      CHECK((v.horizontal - u.horizontal) / (2.0 * d) ==
            doctest::Approx(found.stiffness(0, 1)).epsilon(1e-5));
    }
}
