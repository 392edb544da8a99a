/// Buoyancy is the gradient of a potential: no work around a closed path, no drift of energy.

#include <doctest/doctest.h>

#include <array>

#include "hull/meshes.h"
#include "hydrodae/hull/loads.h"

namespace hydrodae::test_hull_energy {

namespace {

constexpr double rho = 1000.0, g = 9.81, weight = rho * g;
const hull::WaveField still({rho, g});

/// -rho g integral z dV over the displaced volume: by Gauss's theorem a sum over the wet points.
double potential(const hull::Workspace& work) {
  const hull::WetPoints& p = work.points;
  const auto z = p.height.head(p.size);
  return -weight * (0.5 * z.square() * p.weight.col(2).head(p.size)).sum();
}

/// A cone with the tip below, its plane end 1 m above the water.
hull::Mesh cone() {
  std::vector<std::array<double, 2>> line;
  for (int i = 0; i <= 6; ++i)
    line.push_back({2.0 * i / 6, 4.0 * i / 6 - 3.0});
  line.push_back({0.0, 1.0});
  return tests::turned(line, 10).mesh();
}

} // namespace

TEST_CASE("the loads of still water are minus the gradient of the potential") {
  const hull::Mesh mesh = tests::sphere(2.0, 2).mesh();
  hull::Workspace work(mesh, still);
  const Matrix3 R = rotation_matrix<double>(quaternion_from_rotation_vector({0.4, -0.7, 0.2}));
  const hull::Pose pose{{3.0, -1.0, 0.4}, R};
  const Vector6 load = hull::loads(mesh, still, pose, {}, work).hydrostatic;
  constexpr double h = 1e-4;
  for (int j = 0; j < 6; ++j) {
    const auto moved = [&](double by) {
      hull::Pose p = pose;
      if (j < 3)
        p.position[j] += by;
      else
        p.rotation = rotation_about_axis<double>(j - 3, by) * R;
      hull::loads(mesh, still, p, {}, work);
      return potential(work);
    };
    CHECK(std::abs((moved(h) - moved(-h)) / (2 * h) + load[j]) < 1e-8 * load.norm());
  }
}

TEST_CASE("no work around a closed path of poses in still water") {
  for (const hull::Mesh& mesh : {tests::box(5.0, 3.0, 2.0).mesh(), cone()}) {
    hull::Workspace work(mesh, still);
    // The load is twice differentiable along the path: the rule of equal steps has order 4 at
    // least.
    constexpr int n = 10000;
    double net = 0.0, gross = 0.0;
    for (int i = 0; i < n; ++i) {
      const double s = 2 * pi * i / n;
      const double roll = 0.5 * std::sin(s), pitch = 0.4 * std::cos(s + 1.0);
      const Vector3 position(std::sin(s), std::cos(2 * s), 0.6 * std::cos(s));
      const Vector3 velocity(std::cos(s), -2 * std::sin(2 * s), -0.6 * std::sin(s));
      const Matrix3 Rx = rotation_about_axis<double>(0, roll);
      const Matrix3 R = rotation_about_axis<double>(1, pitch) * Rx;
      const Vector3 omega =
          -0.4 * std::sin(s + 1.0) * Vector3::UnitY() +
          rotation_about_axis<double>(1, pitch) * (0.5 * std::cos(s) * Vector3::UnitX());
      const Vector6 load = hull::loads(mesh, still, {position, R}, {}, work).hydrostatic;
      const double power = load.head<3>().dot(velocity) + load.tail<3>().dot(omega);
      net += power;
      gross += std::abs(power);
    }
    CHECK(std::abs(net) < 1e-10 * gross);
    CHECK(gross > 0.0);
  }
}

TEST_CASE("a sphere and a cone bob without damping: no energy comes or goes in 100 periods") {
  for (const auto& [mesh, amplitude] :
       {std::pair{tests::sphere(1.0, 2).mesh(), 0.8}, std::pair{cone(), 0.8}}) {
    hull::Workspace work(mesh, still);
    hull::Pose pose;
    const double mass =
        hull::loads(mesh, still, pose, {}, work).hydrostatic[2] / g; // floats at z = 0
    Matrix6 gradient;
    hull::loads(mesh, still, pose, {}, work, &gradient);
    const double period = 2 * pi * std::sqrt(mass / -gradient(2, 2));
    // Order 4 by composition of leapfrog steps (Yoshida, Phys. Lett. A 150 (1990) 262): symplectic.
    const double w1 = 1.0 / (2.0 - std::cbrt(2.0)), w0 = 1.0 - 2.0 * w1;
    constexpr int steps = 200; // in a period
    double speed = 0.0, force = 0.0, least = INFINITY, most = -INFINITY;
    pose.position[2] = amplitude;
    const auto push = [&] {
      force = hull::loads(mesh, still, pose, {}, work).hydrostatic[2] - mass * g;
    };
    const auto energy = [&] {
      return 0.5 * mass * speed * speed + mass * g * pose.position[2] + potential(work);
    };
    push();
    const double start = energy(), h = period / steps;
    double lowest = 0.0;
    for (int i = 0; i < 100 * steps; ++i) {
      for (double w : {w1, w0, w1}) {
        speed += 0.5 * w * h * force / mass;
        pose.position[2] += w * h * speed;
        push();
        speed += 0.5 * w * h * force / mass;
      }
      lowest = std::min(lowest, pose.position[2]);
      least = std::min(least, energy());
      most = std::max(most, energy());
    }
    CHECK(lowest < -0.4);
    const double swing = mass * g * amplitude;
    CHECK(most - least < 5e-6 * swing);
    CHECK(std::abs(energy() - start) < 1e-6 * swing);
  }
}

} // namespace hydrodae::test_hull_energy
