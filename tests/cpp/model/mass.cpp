#include "hydrodae/model/mass.h"

#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/math/rotation.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;
using model::Body;

namespace {

Body buoy(std::vector<std::string> motion) {
  Body b;
  b.name = "buoy";
  b.motion = std::move(motion);
  b.mass = 2.0;
  b.inertia = Vector3(2, 3, 4);
  return b;
}

bool same(const Matrix3& a, const Matrix3& b) { return (a - b).norm() < 1e-14 * b.norm(); }

} // namespace

TEST_CASE("an inertia tensor from moments and products") {
  Body b = buoy({"rigid"});
  b.products_of_inertia = Vector3(0.1, 0.2, 0.3);
  Matrix3 expected;
  expected << 2, 0.1, 0.3, 0.1, 3, 0.2, 0.3, 0.2, 4;
  CHECK(same(model::inertia_tensor(b), expected));
}

TEST_CASE("an inertia tensor from principal moments and axes") {
  Body b = buoy({"rigid"});
  b.principal_axes = Vector3(0, 0, pi / 2); // the first axis lies along y
  CHECK(same(model::inertia_tensor(b), Vector3(3, 2, 4).asDiagonal().toDenseMatrix()));
  b.principal_axes = Vector3(0, pi / 6, 0); // the first axis is (cos, 0, -sin)
  const double c = std::cos(pi / 6), s = std::sin(pi / 6);
  const double xx = 2 * c * c + 4 * s * s, zz = 2 * s * s + 4 * c * c, xz = (4 - 2) * s * c;
  Matrix3 expected;
  expected << xx, 0, xz, 0, 3, 0, xz, 0, zz;
  CHECK(same(model::inertia_tensor(b), expected));
  // about (1, 1, 1) by 120 degrees: x -> y -> z -> x
  b.principal_axes = Vector3(1, 1, 1).normalized() * (2 * pi / 3);
  CHECK(same(model::inertia_tensor(b), Vector3(4, 2, 3).asDiagonal().toDenseMatrix()));
}

TEST_CASE("principal moments are those of a mass distribution") {
  Body b = buoy({"rigid"});
  b.principal_axes = Vector3(0.1, -0.2, 0.3);
  CHECK(verdict(b) == "");
  b.products_of_inertia = Vector3(0, 0.1, 0);
  CHECK(verdict(b) ==
        "body.buoy.principal_axes_deg: body 'buoy': principal_axes_deg and products_of_inertia "
        "exclude each other: with principal axes, 'inertia' holds the principal moments");
  b.products_of_inertia.setZero();
  b.inertia = Vector3(2, 3, 5.1);
  CHECK(verdict(b) == "body.buoy.inertia: body 'buoy': no mass distribution has this inertia: the "
                      "largest principal moment exceeds the sum of the other two; principal "
                      "moments 2, 3, 5.1 kg m2");
  b.inertia = Vector3(2, 0, 2); // a thin rod
  CHECK(verdict(b) == "");
  b.inertia = Vector3(2, 2, 2);
  b.principal_axes.reset();
  b.products_of_inertia = Vector3(0, 3, 0);
  CHECK(contains(verdict(b), "a moment is negative; principal moments -1, 2, 5 kg m2"));
}

TEST_CASE("a body that pitches needs a moment of inertia about y only") {
  Body b = buoy({"planar"});
  b.inertia = Vector3(5, -1, 0);
  CHECK(contains(verdict(b), "Iyy must be >= 0 kg m2, because the body is free in pitch"));
  b.principal_axes = Vector3(0, 0, pi / 2); // turns the first moment to y
  CHECK(verdict(b) == "");
}

namespace {

/// A box of 2 x 4 x 6 m about the origin, as a solid.
std::shared_ptr<const hull::Mesh> box(const Vector3& center_of_gravity) {
  hull::Vertices v(8, 3);
  for (int i = 0; i < 8; ++i)
    v.row(i) << (i & 1 ? 1.0 : -1.0), (i & 2 ? 2.0 : -2.0), (i & 4 ? 3.0 : -3.0);
  hull::Triangles t(12, 3);
  t << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1,
      3, 7, 1, 7, 5;
  return std::make_shared<const hull::Mesh>(hull::make_mesh(v, t, center_of_gravity));
}

model::Scene floating_box() {
  model::Scene scene;
  scene.environment.water_density = 1000.0;
  Body b = buoy({"rigid"});
  b.mass.word = "equilibrium";
  b.center_of_gravity = Vector3(0.1, 0.0, -0.5);
  b.hull = box(b.center_of_gravity);
  b.mesh = "box.stl";
  b.hydrostatics = "mesh";
  scene.bodies.push_back(b);
  return scene;
}

std::string refusal(model::Scene scene) {
  try {
    model::fill_in_masses(scene);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("the mass of equilibrium is that of the displaced water") {
  model::Scene scene = floating_box();
  model::fill_in_masses(scene);
  CHECK(scene.bodies[0].mass.value == doctest::Approx(1000.0 * 2 * 4 * 3).epsilon(1e-12));
  scene.bodies[0].hydrostatics = "linear"; // the mesh gives no buoyancy then
  CHECK(contains(refusal(scene), "needs what the body displaces: 'hydro', 'mesh' with"));
  scene.bodies[0].volume = 7.0;
  model::fill_in_masses(scene);
  CHECK(scene.bodies[0].mass.value == doctest::Approx(7000.0).epsilon(1e-15));
  scene.environment.water_density.reset();
  CHECK(contains(refusal(scene), "needs the density of the water"));
}

TEST_CASE("a body in the air has no mass of equilibrium") {
  model::Scene scene = floating_box();
  scene.bodies[0].center_of_gravity[2] = 10.0; // the mesh moves with it
  CHECK(contains(refusal(scene), "displaces no water in the reference pose"));
}

TEST_CASE("the inertia of a solid that fills the mesh is about its centroid") {
  model::Scene scene = floating_box();
  Body& b = scene.bodies[0];
  b.mass = 12.0;
  b.inertia.word = "mesh";
  model::fill_in_masses(scene);
  const Matrix3 J = model::inertia_tensor(b);
  CHECK(same(J, Vector3(16.0 + 36.0, 4.0 + 36.0, 4.0 + 16.0).asDiagonal().toDenseMatrix()));
  b.products_of_inertia = Vector3(1, 0, 0);
  CHECK(contains(refusal(scene), "inertia = \"mesh\" has its own products of inertia"));
  b.products_of_inertia.setZero();
  b.hull.reset();
  CHECK(contains(refusal(scene), "inertia = \"mesh\" needs 'mesh', the file of the surface"));
}

TEST_CASE("the products of inertia of a skew solid") {
  model::Scene scene = floating_box();
  Body& b = scene.bodies[0];
  const Vector3 turn(0.3, -0.7, 0.5);
  const Matrix3 R = rotation_matrix<double>(quaternion_from_rotation_vector(turn));
  hull::Vertices v = (R * b.hull->vertices.matrix().transpose()).transpose();
  b.hull = std::make_shared<const hull::Mesh>(
      hull::make_mesh(v, b.hull->triangles, Vector3(3.0, 2.0, 1.0)));
  b.mass = 12.0;
  b.inertia.word = "mesh";
  model::fill_in_masses(scene);
  const Matrix3 expected = R * Vector3(52, 40, 20).asDiagonal() * R.transpose();
  CHECK((model::inertia_tensor(b) - expected).norm() < 1e-12 * expected.norm());
}

TEST_CASE("radii of gyration stand for moments") {
  model::Scene scene = floating_box();
  Body& b = scene.bodies[0];
  b.mass = 3.0;
  b.radii_of_gyration = Vector3(1.0, 2.0, 0.5);
  CHECK(contains(refusal(scene), "give either 'inertia' or 'radii_of_gyration'"));
  b.inertia = Vector3::Zero();
  model::fill_in_masses(scene);
  CHECK(same(model::inertia_tensor(b), Vector3(3, 12, 0.75).asDiagonal().toDenseMatrix()));
}
