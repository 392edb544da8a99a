/// Linear hydrostatics at any yaw.

#include "hydrodae/water/hydrostatics.h"

#include <doctest/doctest.h>

#include "hydrodae/element/body_state.h"
#include "hydrodae/math/rotation.h"

namespace {

using namespace hydrodae;
using element::BodyState;
using Numbers = std::array<double, element::body_numbers>;

/// A box barge whose centre of buoyancy is off its centre of gravity.
water::YawHydrostatics barge() {
  element::LinearWrench law;
  law.constant << 0.0, 0.0, 1.3e5, 2e4, -5e4, 0.0;
  law.stiffness.diagonal() << 0.0, 0.0, 2.2e5, 132.7e3, 1239e3, 0.0;
  law.stiffness(2, 4) = law.stiffness(4, 2) = -3e4;
  law.stiffness(3, 4) = law.stiffness(4, 3) = 1e4;
  water::YawHydrostatics out;
  out.add("barge", law, -0.4);
  return out;
}

/// Place and attitude, z-y-x angles.
BodyState<double> pose(double z, double yaw, double pitch, double roll) {
  BodyState<double> b;
  b.v = b.w = b.v_dot = b.w_dot = Vector3::Zero();
  b.r = Vector3(3.0, 1.0, z);
  b.R = rotation_about_axis<double>(2, yaw) * rotation_about_axis<double>(1, pitch) *
        rotation_about_axis<double>(0, roll);
  return b;
}

Vector6 load(const water::YawHydrostatics& laws, const BodyState<double>& b) {
  Numbers in;
  element::write(b, in.data());
  Vector6 out;
  laws.evaluate(0.0, in.data(), nullptr, out.data());
  return out;
}

double energy(const water::YawHydrostatics& laws, const BodyState<double>& b) {
  Numbers in;
  element::write(b, in.data());
  double out = 0.0;
  laws.energy(in.data(), nullptr, &out);
  return out;
}

/// The pose moved by h along one of its six coordinates: world axes, then turns in body axes.
BodyState<double> moved(BodyState<double> b, int c, double h) {
  if (c < 3)
    b.r[c] += h;
  else
    b.R = b.R * rotation_about_axis<double>(c - 3, h);
  return b;
}

} // namespace

TEST_CASE("hydrostatics at any yaw are the gradient of their energy, and their Jacobian theirs") {
  const water::YawHydrostatics laws = barge();
  constexpr double h = 1e-5;
  for (const BodyState<double>& b :
       {pose(-0.4, 0.0, 0.0, 0.0), pose(-0.1, 2.0, 0.05, -0.06), pose(0.2, -1.0, 0.0706, 0.0707),
        pose(-0.7, 4.0, -0.5, 0.9), pose(0.0, 1.0, 1.2, 2.5)}) {
    Numbers in;
    element::write(b, in.data());
    Eigen::Matrix<double, 6, 18> J;
    laws.jacobian(0.0, in.data(), nullptr, J.data());
    CHECK(J.rightCols<12>().isZero(0.0));
    for (int c = 0; c < 6; ++c) {
      const BodyState<double> plus = moved(b, c, h), minus = moved(b, c, -h);
      CHECK(load(laws, b)[c] ==
            doctest::Approx(-(energy(laws, plus) - energy(laws, minus)) / (2.0 * h))
                .epsilon(1e-7)
                .scale(1e5));
      const Vector6 slope = (load(laws, plus) - load(laws, minus)) / (2.0 * h);
      CHECK((J.col(c) - slope).norm() < 1e-7 * 2e6);
    }
  }
}

TEST_CASE("hydrostatics at any yaw are K of the database along the axes of the body") {
  const water::YawHydrostatics laws = barge();
  const Vector6 rest = load(laws, pose(-0.4, 0.7, 0.0, 0.0));
  for (const double angle : {1e-4, 0.1, 0.11, 1.5}) { // K about one axis at any angle
    CHECK(load(laws, pose(-0.4, 0.7, 0.0, angle))[3] - rest[3] ==
          doctest::Approx(-132.7e3 * angle).epsilon(1e-10));
    CHECK(load(laws, pose(-0.4, 0.7, angle, 0.0))[4] - rest[4] ==
          doctest::Approx(-1239e3 * angle).epsilon(1e-10));
  }
  CHECK(load(laws, pose(-0.2, 0.7, 0.0, 0.0))[2] - rest[2] == doctest::Approx(-0.2 * 2.2e5));
}

TEST_CASE("hydrostatics at any yaw do no work along a closed path") {
  const water::YawHydrostatics laws = barge();
  constexpr int steps = 400; // of a smooth closed path: the sum is exact to rounding
  double work = 0.0, size = 0.0;
  const auto place = [](double a) {
    return std::array{-0.4 + 0.3 * std::sin(a), a + 0.4 * std::sin(2.0 * a), 0.4 * std::cos(a),
                      0.5 * std::sin(a + 0.3)};
  };
  for (int k = 0; k < steps; ++k) {
    const double a = 2.0 * pi * k / steps;
    const auto [z, yaw, pitch, roll] = place(a);
    const double z_a = 0.3 * std::cos(a), yaw_a = 1.0 + 0.8 * std::cos(2.0 * a),
                 pitch_a = -0.4 * std::sin(a), roll_a = 0.5 * std::cos(a + 0.3);
    const BodyState<double> b = pose(z, yaw, pitch, roll);
    const Vector3 turn =
        Vector3(roll_a, 0.0, 0.0) +
        rotation_about_axis<double>(0, roll).transpose() *
            (Vector3(0.0, pitch_a, 0.0) +
             rotation_about_axis<double>(1, pitch).transpose() * Vector3(0.0, 0.0, yaw_a));
    const Vector6 f = load(laws, b);
    const double power = f[2] * z_a + f.tail<3>().dot(turn);
    work += power;
    size += std::abs(power);
  }
  CHECK(std::abs(work) < 1e-12 * size);
}
