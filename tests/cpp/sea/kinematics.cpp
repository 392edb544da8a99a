/// Motion of the water under waves against closed forms and the equations of the flow.

#include "hydrodae/sea/kinematics.h"

#include <doctest/doctest.h>

#include "hydrodae/math/dual.h"
#include "hydrodae/sea/dispersion.h"

namespace {

using namespace hydrodae;
using Point = sea::FluidPoint<double>;

constexpr double gravity = 9.81;

std::vector<sea::Component> waves(double depth) {
  std::vector<sea::Component> out;
  for (const auto& [w, heading, a, phase] :
       {std::array{0.6, 0.3, 1.2, 0.4}, std::array{1.1, -1.0, 0.5, 2.0},
        std::array{2.3, 3.0, 0.2, -1.0}})
    out.push_back({w, sea::wavenumber(w, depth, gravity), heading, a, phase});
  return out;
}

Point at(const sea::WaveField& field, double t, const Vector3& x,
         sea::FluidGradient* gradient = nullptr) {
  Point out;
  sea::fluid_on_line<double>(field, t, x, Vector3(Vector3::Zero()), 1, &out, gradient);
  return out;
}

} // namespace

TEST_CASE("a regular wave: closed form at crest and node, shallow and very deep water") {
  for (double depth : {8.0, 25.0, 1e5, double(INFINITY)}) {
    CAPTURE(depth);
    const double w = 0.9, a = 0.7, k = sea::wavenumber(w, depth, gravity), z = -3.0;
    const sea::WaveField field({{w, k, 0.0, a, 0.0}}, depth, 0.0, Vector3::Zero());
    const double deep = std::exp(k * z);
    const double C = k * depth < 300 ? std::cosh(k * (z + depth)) / std::sinh(k * depth) : deep;
    const double D = k * depth < 300 ? std::sinh(k * (z + depth)) / std::sinh(k * depth) : deep;
    const Point crest = at(field, 0.0, {0, 5, z}), node = at(field, 0.25 * 2.0 * pi / w, {0, 5, z});
    CHECK(crest.elevation == doctest::Approx(a));
    CHECK(crest.velocity[0] == doctest::Approx(a * w * C).epsilon(1e-12));
    CHECK(crest.acceleration[2] == doctest::Approx(-a * w * w * D).epsilon(1e-12));
    CHECK(node.velocity[2] == doctest::Approx(-a * w * D).epsilon(1e-12));
    CHECK(node.acceleration[0] == doctest::Approx(-a * w * w * C).epsilon(1e-12));
    CHECK(at(field, 0.0, {0, 0, 2.0}).velocity[0] ==
          doctest::Approx(at(field, 0, {0, 0, 0}).velocity[0]));
  }
}

TEST_CASE("the flow has no divergence and no rotation, and its gradients are exact") {
  const Vector3 current(0.4, -0.2, 0.0);
  const sea::WaveField field(waves(12.0), 12.0, 30.0, current);
  const Vector3 x(3.0, -2.0, -4.0);
  sea::FluidGradient g;
  at(field, 17.0, x, &g);
  CHECK(std::abs(g.velocity.trace()) < 1e-15);
  CHECK((g.velocity - g.velocity.transpose()).norm() < 1e-15);
  constexpr double h = 1e-6;
  for (int j = 0; j < 3; ++j) {
    const Vector3 dx = h * Vector3::Unit(j);
    const Point plus = at(field, 17.0, x + dx), minus = at(field, 17.0, x - dx);
    CHECK((plus.velocity - minus.velocity - 2 * h * g.velocity.col(j)).norm() < 1e-9 * h * 1e3);
    CHECK((plus.acceleration - minus.acceleration - 2 * h * g.acceleration.col(j)).norm() <
          1e-6 * h);
    CHECK(std::abs(plus.elevation - minus.elevation - 2 * h * g.elevation[j]) < 1e-6 * h);
  }
  // Grown, the acceleration is the rate of the velocity; the free surface moves with the water.
  const Point later = at(field, 50.0 + h, x), sooner = at(field, 50.0 - h, x);
  CHECK(((later.velocity - sooner.velocity) / (2 * h) - at(field, 50.0, x).acceleration).norm() <
        1e-8);
  const Vector3 top(x[0], x[1], 0.0);
  const double rise =
      (at(field, 50.0 + h, top).elevation - at(field, 50.0 - h, top).elevation) / (2 * h);
  CHECK(rise == doctest::Approx(at(field, 50.0, top).velocity[2] - current[2]).epsilon(1e-7));
  CHECK(at(field, 50.0, {0, 0, -12.0}).velocity[2] == doctest::Approx(0.0));
  CHECK(at(field, 50.0, {0, 0, -12.1}).velocity.norm() == 0.0);
}

TEST_CASE("points of a line are the points one by one, upwards, downwards, out of the water, "
          "through the bed") {
  for (double depth : {6.0, 400.0, double(INFINITY)}) {
    const sea::WaveField field(waves(depth), depth, 0.0, Vector3::Zero());
    for (const Vector3& step : {Vector3(0.3, 0.2, 0.9), Vector3(-0.1, 0.4, -0.7),
                                Vector3(1.0, 0.0, 0.0), Vector3(0.0, 0.0, -40.0)}) {
      const Vector3 start(1.0, 2.0, step[2] > 0 ? -7.5 : 2.5);
      std::array<Point, 14> line;
      std::array<sea::FluidGradient, 14> gradients;
      sea::fluid_on_line<double>(field, 3.0, start, step, 14, line.data(), gradients.data());
      for (int j = 0; j < 14; ++j) {
        sea::FluidGradient g;
        const Point own = at(field, 3.0, start + j * step, &g);
        const auto k = static_cast<std::size_t>(j);
        CHECK((line[k].velocity - own.velocity).norm() < 1e-13);
        CHECK((line[k].acceleration - own.acceleration).norm() < 1e-13);
        CHECK((gradients[k].velocity - g.velocity).norm() < 1e-13);
        if (own.velocity.norm() > 0.0)
          CHECK(line[k].elevation == doctest::Approx(own.elevation).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("many waves at once are the waves one by one in dual numbers, gradients too") {
  for (double depth : {9.0, 60.0, double(INFINITY)})
    for (std::size_t count : {1u, 8u, 203u}) {
      std::vector<sea::Component> components;
      for (std::size_t j = 0; j < count; ++j) {
        const double w = 0.3 + 2.7 * (static_cast<double>(j) + 0.5) / static_cast<double>(count);
        components.push_back({w, sea::wavenumber(w, depth, gravity), 0.1 * static_cast<double>(j),
                              0.4 / std::sqrt(count),
                              std::fmod(2.4 * static_cast<double>(j * j), 6.0)});
      }
      sea::WaveField field(components, depth, 20.0, Vector3(0.5, 0.1, 0.0));
      field.terms.push_back({0.0, 0.0, 0.0, 1.0, 0.0, -0.1, 0.0, 0.0}); // a set-down
      REQUIRE(field.terms.size() == count + 1);
      for (int i = 0; i < 40; ++i) {
        const Vector3 x(0.9 * i, -0.7 * i, 1.5 - 0.3 * i);
        sea::FluidGradient g;
        const Point own = at(field, 1.3 * i, x, &g);
        for (int j = 0; j < 3; ++j) {
          Vec3<Dual> moved = x.cast<Dual>();
          moved[j].b = 1.0;
          sea::FluidPoint<Dual> d;
          sea::fluid_on_line<Dual>(field, 1.3 * i, moved, Vec3<Dual>::Zero(), 1, &d);
          CHECK(std::abs(d.elevation.a - own.elevation) < 1e-13);
          CHECK(std::abs(d.elevation.b - g.elevation[j]) < 1e-13);
          for (int k = 0; k < 3; ++k) {
            CHECK(std::abs(d.velocity[k].a - own.velocity[k]) < 1e-13);
            CHECK(std::abs(d.velocity[k].b - g.velocity(k, j)) < 1e-13);
            CHECK(std::abs(d.acceleration[k].a - own.acceleration[k]) < 1e-13);
            CHECK(std::abs(d.acceleration[k].b - g.acceleration(k, j)) < 1e-13);
          }
        }
      }
      field.terms.keep(count);
      CHECK(field.terms.size() == count);
      field.terms.keep(count - 1);
      CHECK(field.terms.size() == count - 1);
    }
}
