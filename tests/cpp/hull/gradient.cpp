/// Loads and their gradient against a second program, by duals, in random poses.

#include <doctest/doctest.h>

#include <random>

#include "hull/meshes.h"
#include "hull/oracle.h"

namespace hydrodae::test_hull_gradient {

using hull::Stretching;

namespace {

std::vector<hull::Wave> sea(double depth) {
  std::vector<hull::Wave> out{
      {0.0, 0.11, 0.4, 0.7, 0.3}, {0.0, 0.25, -2.0, 0.4, 2.0}, {0.0, 0.8, 1.3, 0.15, -1.0}};
  for (hull::Wave& w : out)
    w.omega = std::sqrt(9.81 * w.wavenumber *
                        (std::isfinite(depth) ? std::tanh(w.wavenumber * depth) : 1.0));
  return out;
}

/// Compares with the oracle in random poses. The body is not symmetric about its origin.
void compare(const hull::Water& water, const std::vector<hull::Wave>& waves, unsigned seed,
             int poses) {
  CAPTURE(int(water.stretching));
  CAPTURE(water.bernoulli);
  CAPTURE(water.depth);
  tests::MeshArrays arrays = tests::cylinder(2.0, -1.7, 2.9, 12, 4, 2);
  for (Vector3& v : arrays.vertices)
    v += Vector3(0.3, -0.2, 0.1 * v[0]);
  const hull::Mesh mesh = arrays.mesh();
  const hull::WaveField field(water, waves, mesh.radius);
  hull::Workspace work(mesh, field);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int k = 0; k < poses; ++k) {
    CAPTURE(k);
    const Vector3 theta(draw(random), draw(random), 2 * draw(random));
    const hull::Pose pose{{50 * draw(random), 50 * draw(random), 2 * draw(random)},
                          rotation_matrix<double>(quaternion_from_rotation_vector(theta))};
    const double t = 100 * draw(random);
    Matrix6 gradient;
    const hull::Loads found = hull::loads(mesh, field, pose, {t}, work, &gradient);
    const hull::Loads plain = hull::loads(mesh, field, pose, {t}, work);
    const auto truth = tests::oracle<double>(mesh, water, waves, pose, t, Vector6::Zero());
    const double size = truth.norm();
    CHECK((found.hydrostatic - truth.head<6>()).norm() <= 1e-12 * size);
    CHECK((found.dynamic - truth.tail<6>()).norm() <= 1e-12 * size);
    CHECK((found.hydrostatic - plain.hydrostatic).norm() <= 1e-14 * size);
    CHECK((found.dynamic - plain.dynamic).norm() <= 1e-14 * size);
    const Matrix6 exact = tests::oracle_gradient(mesh, water, waves, pose, t);
    CHECK((gradient - exact).norm() <= 1e-11 * exact.norm());
  }
}

} // namespace

TEST_CASE("still water: loads and gradient of a clipped mesh in 50 poses") {
  compare({1025.0, 9.81}, {}, 3, 50);
}

TEST_CASE("waves: loads and gradient of a clipped mesh in 180 poses, however they are continued") {
  unsigned seed = 10;
  for (Stretching stretching :
       {Stretching::vertical, Stretching::wheeler, Stretching::extrapolated})
    for (bool bernoulli : {false, true})
      for (double depth : {9.0, double(INFINITY)})
        compare({1025.0, 9.81, depth, stretching, bernoulli}, sea(depth), ++seed, 15);
}

TEST_CASE("the gradient is the slope of the load from pose to pose") {
  const double depth = 9.0;
  const hull::Mesh mesh = tests::cylinder(2.0, -2.0, 3.0, 12, 4, 2).mesh();
  for (Stretching stretching :
       {Stretching::vertical, Stretching::wheeler, Stretching::extrapolated, Stretching::none}) {
    CAPTURE(int(stretching));
    const hull::WaveField field({1025.0, 9.81, depth, stretching, true}, sea(depth), mesh.radius);
    hull::Workspace work(mesh, field);
    const Matrix3 R = rotation_matrix<double>(quaternion_from_rotation_vector({0.2, -0.3, 0.5}));
    const hull::Pose pose{{1.0, 2.0, -0.3}, R};
    Matrix6 gradient;
    hull::loads(mesh, field, pose, {4.0}, work, &gradient);
    constexpr double h = 1e-5;
    for (int j = 0; j < 6; ++j) {
      const auto moved = [&](double by) -> Vector6 {
        hull::Pose p = pose;
        if (j < 3)
          p.position[j] += by;
        else
          p.rotation = rotation_about_axis<double>(j - 3, by) * R;
        const hull::Loads l = hull::loads(mesh, field, p, {4.0}, work);
        return l.hydrostatic + l.dynamic;
      };
      const Vector6 slope = (moved(h) - moved(-h)) / (2 * h);
      CHECK((slope - gradient.col(j)).norm() < 1e-7 * gradient.norm());
    }
  }
}

} // namespace hydrodae::test_hull_gradient
