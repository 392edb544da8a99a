/// Bound waves of second order against the equations of the flow, Stokes' wave and each other.

#include "hydrodae/sea/second_order.h"

#include <doctest/doctest.h>

#include "hydrodae/sea/dispersion.h"

namespace {

using namespace hydrodae;

constexpr double pull = 9.81; ///< of gravity [m/s2]

std::vector<sea::Component> three_waves(double depth, double scale) {
  std::vector<sea::Component> out;
  for (const auto& [w, heading, a, phase] :
       {std::array{0.7, 0.3, 1.2, 0.4}, std::array{1.1, -0.6, 0.5, 2.0},
        std::array{1.3, 1.4, 0.2, -1.0}})
    out.push_back({w, sea::wavenumber(w, depth, pull), heading, scale * a, phase});
  return out;
}

sea::WaveField with_bound(const std::vector<sea::Component>& waves, double depth) {
  sea::WaveField field(waves, depth, 0.0, Vector3::Zero());
  const sea::BoundWaves bound = sea::bound_waves(waves, depth, pull, 1000);
  field.terms.append(bound.terms);
  return field;
}

struct Surface {
  sea::FluidPoint<double> water;
  sea::FluidGradient slope;
};

Surface surface_at(const sea::WaveField& field, double t, double x, double y) {
  Surface out;
  const Vector3 none = Vector3::Zero();
  sea::fluid_on_line<double>(field, t, {x, y, 0.0}, none, 1, &out.water, &out.slope);
  return out;
}

/// Rest of the two conditions at the surface z = eta, expanded about z = 0 to the second order: the
/// surface moves with the water, and the pressure on it has no slope.
Eigen::Vector2d surface_rest(const std::vector<sea::Component>& waves, double depth,
                             const sea::WaveField& whole) {
  const sea::WaveField linear(waves, depth, 0.0, Vector3::Zero());
  constexpr double h = 1e-4, t = 3.0, x = 1.0, y = -2.0;
  const Surface a = surface_at(whole, t, x, y), one = surface_at(linear, t, x, y);
  const double rate = (surface_at(whole, t + h, x, y).water.elevation -
                       surface_at(whole, t - h, x, y).water.elevation) /
                      (2.0 * h);
  const double eta = one.water.elevation;
  const Vector3 &u = one.water.velocity, slope = one.slope.elevation;
  const double kinematic = rate + u.head<2>().dot(slope.head<2>()) - a.water.velocity[2] -
                           eta * one.slope.velocity(2, 2);
  // Slope along x of phi_t + g eta + |u|^2 / 2 + eta phi_tz, with u_t = grad phi_t.
  const auto vertical = [&](double at) {
    const Surface s = surface_at(linear, t, at, y);
    return s.water.elevation * s.water.acceleration[2];
  };
  const double dynamic = a.water.acceleration[0] + pull * a.slope.elevation[0] +
                         u.dot(one.slope.velocity.col(0)) +
                         (vertical(x + h) - vertical(x - h)) / (2.0 * h);
  return {kinematic, dynamic};
}

} // namespace

TEST_CASE("bound waves meet both conditions at the surface to the second order") {
  for (const double depth : {9.0, 30.0, double(INFINITY)}) {
    CAPTURE(depth);
    const std::vector<sea::Component> waves = three_waves(depth, 1.0);
    const sea::WaveField linear(waves, depth, 0.0, Vector3::Zero());
    CHECK(surface_rest(waves, depth, with_bound(waves, depth)).norm() < 1e-7);
    CHECK(surface_rest(waves, depth, linear).norm() > 1e-2);
  }
}

TEST_CASE("a regular wave: Stokes' second harmonic and set-down") {
  for (const double depth : {10.0, 15.0, 40.0}) {
    CAPTURE(depth);
    const double w = 0.9, a = 0.8, k = sea::wavenumber(w, depth, pull),
                 c = 1.0 / std::tanh(k * depth);
    const sea::SecondOrder second({{w, k, 0.7, a, 0.0}}, depth, pull);
    const double harmonic = 0.25 * k * a * a * c * (3.0 * c * c - 1.0),
                 down = -0.5 * k * a * a / std::sinh(2.0 * k * depth);
    CHECK(second.elevation(0.0, 0.0, 0.0) == doctest::Approx(down + harmonic).epsilon(1e-12));
    CHECK(second.elevation(0.5 * pi / w, 0.0, 0.0) ==
          doctest::Approx(down - harmonic).epsilon(1e-12));
  }
}

TEST_CASE("the terms and the quadratic form are the same elevation") {
  const double depth = 20.0;
  const std::vector<sea::Component> waves = three_waves(depth, 1.0);
  const sea::SecondOrder second(waves, depth, pull);
  sea::WaveField terms(waves, depth, 0.0, Vector3::Zero());
  const sea::BoundWaves bound = sea::bound_waves(waves, depth, pull, 1000);
  CHECK(bound.all == 9); // three doubles, three sums, three differences
  CHECK(bound.elevation == 1.0);
  terms.terms.clear();
  terms.terms.append(bound.terms);
  for (const double t : {0.0, 4.0, 171.3})
    CHECK(sea::elevation(terms, t, 13.0, -4.0) ==
          doctest::Approx(second.elevation(t, 13.0, -4.0)).epsilon(1e-12));
  const sea::BoundWaves few = sea::bound_waves(waves, depth, pull, 4);
  CHECK(few.terms.size() == 5); // and the set-down
  CHECK(few.elevation < 1.0);
}

TEST_CASE("a current over the depth: straight lines, constant beyond, exact slopes") {
  const std::vector<sea::Layer> profile = sea::layers({{-2.0, 1.0, 0.0}, {-10.0, 0.5, 90.0}});
  Vector3 slope;
  CHECK(sea::current_at<double>(profile, 3.0, &slope).isApprox(Vector3(1.0, 0.0, 0.0), 1e-14));
  CHECK(slope.norm() == 0.0);
  CHECK(sea::current_at<double>(profile, -6.0, &slope).isApprox(Vector3(0.5, 0.25, 0.0), 1e-14));
  CHECK(slope.isApprox(Vector3(0.0625, -0.03125, 0.0) * 2.0, 1e-14));
  CHECK(sea::current_at<double>(profile, -90.0)[1] == doctest::Approx(0.5));
  sea::WaveField field({}, 12.0, 0.0, Vector3::Zero());
  field.profile = profile;
  std::array<sea::FluidPoint<double>, 5> water;
  sea::fluid_on_line<double>(field, 0.0, {0, 0, 2}, {0, 0, -4}, 5, water.data());
  CHECK(water[2].velocity.isApprox(Vector3(0.5, 0.25, 0.0), 1e-14));
  CHECK(water[4].velocity.norm() == 0.0); // beneath the bed
}
