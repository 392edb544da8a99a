/// Joints that are out of line with each other, start velocities that do not fit, drives that
/// contradict each other.

#include <cmath>
#include <filesystem>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/io/case_reader.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {

/// The door benchmark, its lower hinge moved by `offset` [m] and tilted by `tilt` [rad], all
/// lengths times `size`.
model::Scene door(double offset, double tilt, double size = 1.0) {
  const auto root = std::filesystem::path(__FILE__).parent_path() / "../../../cases/benchmarks";
  model::Scene scene = io::read_case((root / "door.toml").string());
  model::Joint& lower = scene.joints[1];
  lower.point[1] += offset;
  lower.axis = *lower.axis + tilt * Vector3::UnitY();
  for (model::Joint& j : scene.joints)
    j.point *= size;
  scene.bodies[0].center_of_gravity *= size;
  scene.bodies[0].inertia.value *= size * size;
  return scene;
}

/// Crank from the origin to (0.5, 0, 0.5), rod to the slider at (2, 0, 0).
model::Scene slider_crank() {
  model::Scene scene;
  scene.bodies = {bar("crank", {0.25, 0, 0.25}, "planar"), bar("rod", {1.25, 0, 0.25}, "planar"),
                  bar("slider", {2, 0, 0}, "surge")};
  scene.joints = {pin("c", "ground", "crank", {0, 0, 0}), pin("p", "crank", "rod", {0.5, 0, 0.5}),
                  pin("s", "rod", "slider", {2, 0, 0})};
  scene.solver.end_time = 1.0;
  scene.output.step = 0.1;
  return scene;
}

/// By hand, for the crank at 2 rad/s: its end goes (1, 0, -1); the rod, (1.5, 0, -0.5) long, turns
/// at -2/3 rad/s; the slider goes at 4/3 m/s.
void check_velocities(const system::System& s, double rate) {
  const double part = 0.5 * rate;
  CHECK(s.bodies[0].angular_velocity[1] == doctest::Approx(2.0 * part).epsilon(1e-9));
  CHECK((s.bodies[0].velocity - part * Vector3(0.5, 0, -0.5)).norm() < 1e-9);
  CHECK(s.bodies[1].angular_velocity[1] == doctest::Approx(-2.0 / 3.0 * part).epsilon(1e-9));
  CHECK(s.bodies[2].velocity[0] == doctest::Approx(4.0 / 3.0 * part).epsilon(1e-9));
}

Index mobility_of(const model::Scene& scene) {
  const system::System built = build::build(scene);
  return build::mobility(system::Regime(built));
}

bool noted(const system::System& s, const std::string& part) {
  for (const std::string& note : s.notes)
    if (contains(note, part))
      return true;
  return false;
}

model::Constraint drive(const std::string& name, double rate) {
  model::DrivenCoordinate c;
  c.name = name;
  c.joint = "c";
  c.drive.rate = rate;
  return c;
}

} // namespace

TEST_CASE("hinges that are out of line by next to nothing leave the door its motion, and tell") {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const double misfit : {1e-12, 1e-8, 1e-6})
      for (const bool tilted : {false, true}) {
        CAPTURE(size);
        CAPTURE(misfit);
        const system::System built =
            build::build(tilted ? door(0, misfit, size) : door(misfit, 0, size));
        const system::Regime s(built);
        CHECK(s.n_lambda == 5);
        CHECK(build::mobility(s) == 1);
        CHECK(noted(built, "is out of line with") == (misfit > 1e-10));
      }
}

TEST_CASE("hinges that would lock the door are refused with the reason") {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const double misfit : {1e-4, 1e-2})
      for (const bool tilted : {false, true}) {
        const std::string message = message_of(
            [&] { build::build(tilted ? door(0, misfit, size) : door(misfit, 0, size)); });
        CHECK(contains(message, "joints are inconsistent: "));
        CHECK(contains(message, "is out of line with"));
        CHECK(contains(message, "solver.tolerance_assembly = "));
      }
  model::Scene scene = door(1e-4, 0);
  scene.solver.force = true;
  CHECK(mobility_of(scene) == 0);
}

TEST_CASE("an opened door with hinges a little out of line starts where it is given") {
  model::Scene scene = door(1e-8, 0);
  scene.joints[0].initial.angle = 0.5;
  const system::System built = build::build(scene);
  const system::Regime s(built);
  CHECK(s.n_lambda == 5);
  const Matrix3 turn = rotation_matrix<double>(s.bodies[0].orientation);
  CHECK(std::acos(0.5 * (turn.trace() - 1.0)) == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("velocities that are not given follow from those that are") {
  model::Scene scene = slider_crank();
  SUBCASE("rate of a joint") { scene.joints[0].initial.angle_rate = 2.0; }
  SUBCASE("turn of a body") { scene.bodies[0].initial.angular_velocity = Vector3(0, 2, 0); }
  SUBCASE("velocity of the slider") { scene.bodies[2].initial.velocity = Vector3(4.0 / 3.0, 0, 0); }
  SUBCASE("a drive") { scene.constraints = {drive("motor", 2.0)}; }
  const system::System s = build::build(scene);
  check_velocities(s, 2.0);
  CHECK(noted(s, "velocities that the case does not give follow from the constraints"));
}

TEST_CASE("velocities given to some digits are projected and told, contradictions are refused") {
  model::Scene scene = slider_crank();
  scene.bodies[0].initial.angular_velocity = Vector3(0, 2, 0);
  scene.bodies[0].initial.velocity = Vector3(0.5 + 1e-8, 0, -0.5);
  CHECK(!noted(build::build(scene), "projected from"));
  scene.bodies[0].initial.velocity = Vector3(0.50002, 0, -0.5);
  CHECK(noted(build::build(scene), "'crank': initial velocity projected from [0.50002, 0, -0.5]"));
  scene.bodies[0].initial.velocity = Vector3(0.6, 0, -0.5);
  const std::string message = message_of([&] { build::build(scene); });
  CHECK(contains(message, "body 'crank': initial velocity = [0.6, 0, -0.5] m/s does not fit"));
  scene.bodies[0].initial.velocity = Vector3(0.5, 0, -0.5);
  scene.constraints = {drive("motor", 3.0)};
  CHECK(contains(message_of([&] { build::build(scene); }), "does not fit the constraints"));
}

// The mast turns about its pin as a blow to the boat would leave it: m (1 + w) + I w = 0.
TEST_CASE("what no velocity is given for starts with the least kinetic energy") {
  model::Scene scene;
  scene.bodies = {bar("boat", {0, 0, 0}, "rigid"), bar("mast", {0, 0, 2}, "rigid")};
  scene.joints = {pin("step", "boat", "mast", {0, 0, 1})};
  scene.bodies[0].initial.velocity = Vector3(1, 0, 0);
  scene.bodies[0].initial.angular_velocity = Vector3(0, 0, 0.5);
  scene.solver.end_time = 1.0;
  const system::System s = build::build(scene);
  CHECK((s.bodies[1].velocity - Vector3(1.0 / 11.0, 0, 0)).norm() < 1e-8);
  CHECK((s.bodies[1].angular_velocity - Vector3(0, -10.0 / 11.0, 0.5)).norm() < 1e-8);
}

TEST_CASE("two drives of one freedom must agree at all times") {
  model::Scene scene = slider_crank();
  scene.constraints = {drive("a", 2.0), drive("b", 2.0)};
  CHECK(noted(build::build(scene), "1 redundant constraint row"));
  scene.constraints[1] = drive("b", 2.1);
  CHECK(contains(message_of([&] { build::build(scene); }), "their rates differ by 0.1 rad/s"));
}

TEST_CASE("a pose that the joints do not allow is refused where the case gives it") {
  model::Scene scene = slider_crank();
  scene.bodies[1].initial.displacement = {2, 0, 3};
  CHECK(contains(message_of([&] { build::build(scene); }),
                 "body 'rod': the initial pose contradicts the joints"));
}
