#include "hydrodae/model/mass.h"

#include <cmath>

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
