/// Volume and water plane of bodies against closed forms and against the gradient of the loads.

#include "hydrodae/hull/floating.h"

#include <doctest/doctest.h>

#include "hull/meshes.h"
#include "hydrodae/hull/loads.h"

namespace hydrodae::test_hull_floating {

namespace {

const hull::WaveField still({1000.0, 9.81});

} // namespace

TEST_CASE("a box that floats upright: exact") {
  constexpr double L = 7.0, B = 4.0, T = 1.5, H = 4.0;
  const hull::Mesh mesh = tests::box(L, B, H).mesh();
  hull::Workspace work(mesh, still);
  const hull::Pose pose{{20.0, 30.0, 0.5 * H - T}, Matrix3::Identity()};
  const hull::Floating f = hull::floating(mesh, still, pose, work);
  CHECK(f.volume == doctest::Approx(L * B * T).epsilon(1e-13));
  CHECK((f.buoyancy - Vector3(0.0, 0.0, -0.5 * H + 0.5 * T)).norm() < 1e-13);
  CHECK(f.wetted_area == doctest::Approx(L * B + 2 * (L + B) * T).epsilon(1e-13));
  CHECK(f.plane_area == doctest::Approx(L * B).epsilon(1e-13));
  CHECK(f.plane_xx == doctest::Approx(B * L * L * L / 12).epsilon(1e-13));
  CHECK(f.plane_yy == doctest::Approx(L * B * B * B / 12).epsilon(1e-13));
  CHECK(std::abs(f.plane_x) + std::abs(f.plane_y) + std::abs(f.plane_xy) < 1e-11);
}

TEST_CASE("in any pose the water plane gives the gradient of the loads of still water") {
  tests::MeshArrays arrays = tests::cylinder(2.0, -1.7, 2.9, 12, 4, 2);
  for (Vector3& v : arrays.vertices)
    v += Vector3(0.3, -0.2, 0.1 * v[0]);
  const hull::Mesh mesh = arrays.mesh();
  hull::Workspace work(mesh, still);
  for (double angle : {0.0, 0.3, -0.7}) {
    const Matrix3 R =
        rotation_matrix<double>(quaternion_from_rotation_vector(Vector3(angle, 0.4 * angle, 1.0)));
    const hull::Pose pose{{1.0, 2.0, 0.2}, R};
    const hull::Floating f = hull::floating(mesh, still, pose, work);
    Matrix6 gradient;
    const Vector6 load = hull::loads(mesh, still, pose, {}, work, &gradient).hydrostatic;
    const Matrix3 C = f.stiffness(9810.0);
    CHECK((gradient.block<3, 3>(2, 2) + C).norm() < 1e-12 * C.norm());
    CHECK(load[2] == doctest::Approx(9810.0 * f.volume).epsilon(1e-12));
    const Vector3 moment = cross<double>(f.buoyancy, load.head<3>());
    CHECK((load.tail<3>() - moment).norm() < 1e-11 * load.norm());
  }
}

TEST_CASE("a body in the air displaces nothing, and one beneath the water has no water plane") {
  const hull::Mesh mesh = tests::sphere(1.0, 2).mesh();
  hull::Workspace work(mesh, still);
  const hull::Floating air =
      hull::floating(mesh, still, {{0.0, 0.0, 2.0}, Matrix3::Identity()}, work);
  CHECK(air.volume == 0.0);
  CHECK(air.buoyancy.norm() == 0.0);
  const hull::Floating deep =
      hull::floating(mesh, still, {{0.0, 0.0, -5.0}, Matrix3::Identity()}, work);
  CHECK(deep.volume == doctest::Approx(mesh.volume).epsilon(1e-12));
  CHECK((deep.buoyancy - mesh.centroid).norm() < 1e-12);
  CHECK(std::abs(deep.plane_area) < 1e-12);
}

} // namespace hydrodae::test_hull_floating
