/// Hydrostatic loads of a mesh against closed forms.

#include <doctest/doctest.h>

#include <array>

#include "hull/meshes.h"
#include "hydrodae/hull/loads.h"

namespace hydrodae::test_hull_still_water {

namespace {

const hull::Water water{1000.0, 9.81};
constexpr double weight = 9810.0; ///< rho g
const hull::WaveField still(water);

Vector6 load_at(const hull::Mesh& mesh, const hull::Pose& pose, hull::Workspace& work) {
  return hull::loads(mesh, still, pose, {}, work).hydrostatic;
}

hull::Pose raised(double z) { return {{0.0, 0.0, z}, Matrix3::Identity()}; }

} // namespace

TEST_CASE("a sphere at several draughts: rho g V of the cap, second order in the mesh") {
  constexpr double R = 2.0;
  for (double draught : {0.3, 1.1, 2.0, 3.2, 4.0}) {
    CAPTURE(draught);
    const double exact = weight * pi * draught * draught * (3 * R - draught) / 3;
    std::array<double, 3> error{};
    for (int k = 0; k < 3; ++k) {
      const hull::Mesh mesh = tests::sphere(R, 3 + k).mesh();
      hull::Workspace work(mesh, still);
      const Vector6 load = load_at(mesh, raised(R - draught), work);
      error[std::size_t(k)] = load[2] / exact - 1;
      CHECK(std::abs(load[0]) + std::abs(load[1]) < 1e-10 * exact);
      CHECK(load.tail<3>().norm() < 1e-10 * exact);
    }
    CHECK(std::abs(error[2]) * exact < 2e-3 * weight * 4 * pi / 3 * R * R * R);
    for (int k = 0; k < 2; ++k) {
      const double order = std::log2(error[std::size_t(k)] / error[std::size_t(k) + 1]);
      CHECK(order > 1.8);
      CHECK(order < 2.2);
    }
  }
}

TEST_CASE("a wall-sided box: GZ = sin(phi) (GM + 1/2 BM tan^2 phi), to rounding") {
  constexpr double L = 7.0, B = 4.0, T = 1.5, H = 4.0, KG = 1.2;
  tests::MeshArrays arrays = tests::box(L, B, H);
  for (Vector3& v : arrays.vertices)
    v[2] += 0.5 * H - KG; // origin at the centre of gravity
  const hull::Mesh mesh = arrays.mesh();
  hull::Workspace work(mesh, still);
  const double V = L * B * T, BM = B * B / (12 * T), GM = 0.5 * T + BM - KG;
  for (double phi : {0.05, 0.2, 0.4, -0.35, 0.6}) {
    CAPTURE(phi);
    // Wall-sided: with equal volume the water plane passes the same point of the middle line.
    const double z = std::cos(phi) * (KG - T);
    const hull::Pose pose{{1.0, 2.0, z}, rotation_about_axis<double>(0, phi)};
    const Vector6 load = load_at(mesh, pose, work);
    const double GZ = std::sin(phi) * (GM + 0.5 * BM * std::tan(phi) * std::tan(phi));
    CHECK(load[2] == doctest::Approx(weight * V).epsilon(1e-13));
    CHECK(load[3] == doctest::Approx(-weight * V * GZ).epsilon(1e-12));
    CHECK(load.head<2>().norm() < 1e-12 * weight * V);
    CHECK(std::abs(load[4]) + std::abs(load[5]) < 1e-11 * weight * V);
  }
}

TEST_CASE("a body in the air has no load, and one beneath the water the load of its volume") {
  const hull::Mesh mesh = tests::sphere(1.0, 2).mesh();
  hull::Workspace work(mesh, still);
  Matrix6 gradient;
  CHECK(hull::loads(mesh, still, raised(1.001), {}, work, &gradient).hydrostatic.norm() == 0.0);
  CHECK(gradient.norm() == 0.0);
  for (double z : {-1.5, -300.0}) {
    const Vector6 load = hull::loads(mesh, still, raised(z), {}, work, &gradient).hydrostatic;
    CHECK(load[2] == doctest::Approx(weight * mesh.volume).epsilon(1e-12));
    CHECK(gradient.norm() < 1e-9 * weight * std::abs(z));
  }
}

TEST_CASE("the stiffness of a floating box is that of its water plane") {
  constexpr double L = 7.0, B = 4.0, T = 1.5, H = 4.0;
  const hull::Mesh mesh = tests::box(L, B, H).mesh();
  hull::Workspace work(mesh, still);
  Matrix6 gradient;
  hull::loads(mesh, still, raised(0.5 * H - T), {}, work, &gradient);
  const double V = L * B * T, zB = -0.5 * T, zG = 0.5 * H - T;
  // The moment about the body's origin: -rho g (S_yy + V (z_B - z_G)) for a rotation about x.
  CHECK(gradient(2, 2) == doctest::Approx(-weight * L * B).epsilon(1e-12));
  CHECK(gradient(3, 3) ==
        doctest::Approx(-weight * (L * B * B * B / 12 + V * (zB - zG))).epsilon(1e-12));
  CHECK(gradient(4, 4) ==
        doctest::Approx(-weight * (B * L * L * L / 12 + V * (zB - zG))).epsilon(1e-12));
  gradient(2, 2) = gradient(3, 3) = gradient(4, 4) = 0.0;
  CHECK(gradient.norm() < 1e-10 * weight * V);
}

} // namespace hydrodae::test_hull_still_water
