/// Closing loops at the start, redundant rows, mobility.

#include <cmath>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/core/error.h"
#include "hydrodae/measure/observer.h"
#include "hydrodae/statics/consistent_start.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {
/// Crank and rocker upright on the ground, 1 m apart, joined by a coupler at height 1 m.
model::Scene four_bar(const std::string& motion) {
  model::Scene scene;
  scene.bodies = {bar("crank", {0, 0, 0.5}, motion), bar("coupler", {0.5, 0, 1.0}, motion),
                  bar("rocker", {1.0, 0, 0.5}, motion)};
  scene.joints = {pin("a", "ground", "crank", {0, 0, 0}), pin("b", "crank", "coupler", {0, 0, 1}),
                  pin("c", "coupler", "rocker", {1, 0, 1}),
                  pin("d", "rocker", "ground", {1, 0, 0})};
  scene.solver.end_time = 1.0;
  return scene;
}

double largest_gap(const system::System& s) {
  system::Workspace<double> ws(s);
  double largest = 0.0;
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      largest = std::max(
          largest, std::abs(joint::basic_row<double>(row.kind, j.A, j.B, j.parameters,
                                                     system::joint_geometry<double>(j, ws.bodies))
                                .value));
  return largest;
}

/// The reactions of all joints at the start.
std::vector<Vector6> reactions(const system::System& built) {
  const system::Regime s(built);
  const system::Pattern pattern = system::find_pattern(s);
  VectorX y = system::initial_state(s), yp;
  statics::consistent_start(s, pattern, y, yp);
  measure::Observer observer(s);
  return observer.observe(0.0, y, yp).reactions;
}

} // namespace

TEST_CASE("a loop that is open at the start is closed by a small motion, which is told") {
  model::Scene scene = four_bar("planar");
  scene.bodies[1].initial.displacement = {0.03, 0.0, -0.02};
  const system::System s = build::build(scene);
  CHECK(largest_gap(s) < 1e-12);
  for (const system::BodyData& b : s.bodies)
    CHECK((b.position - b.reference).norm() < 0.05);
  REQUIRE(!s.notes.empty());
  CHECK(s.notes.front().find("moved body 'c") != std::string::npos);
}

TEST_CASE("a closed loop starts at the angle that its joint is given") {
  model::Scene scene = four_bar("planar");
  scene.joints[0].initial.angle = 0.6;
  scene.joints[0].initial.angle_rate = -2.0;
  const system::System s = build::build(scene);
  CHECK(largest_gap(s) < 1e-12);
  CHECK(2.0 * std::atan2(s.bodies[0].orientation[2], s.bodies[0].orientation[0]) ==
        doctest::Approx(0.6).epsilon(1e-9));
  CHECK(s.bodies[0].angular_velocity[1] == doctest::Approx(-2.0).epsilon(1e-9));
  CHECK(s.bodies[2].angular_velocity[1] == doctest::Approx(-2.0).epsilon(1e-9)); // parallelogram
  CHECK(s.bodies[1].angular_velocity.norm() < 1e-9);
}

TEST_CASE("a loop that cannot close names a joint and its gap") {
  model::Scene scene = four_bar("planar");
  scene.joints[3].point = {1, 0, 0};
  scene.bodies[2].initial.displacement = {0, 0, 0};
  model::Joint far = pin("far", "ground", "rocker", {1, 0, 0});
  far.type = "distance";
  far.axis.reset();
  far.point = {30, 0, 0};
  far.point_b = Vector3(1, 0, 0);
  far.length = 5.0;
  scene.joints.push_back(far);
  try {
    build::build(scene);
    FAIL("built");
  } catch (const ModelError& error) {
    CHECK(std::string(error.what()).find("stays open by") != std::string::npos);
    CHECK(error.key.starts_with("joint."));
  }
}

TEST_CASE("a spatial four-bar with full hinges has three redundant rows and mobility one") {
  const system::System built = build::build(four_bar("rigid"));
  const system::Regime s(built);
  CHECK(build::mobility(s) == 1);
  CHECK(s.n_u - s.n_lambda == 1);
  REQUIRE(!built.notes.empty());
  CHECK(built.notes.front().find("3 redundant constraint rows") != std::string::npos);
}

TEST_CASE("a level parallelogram is a singular pose, not redundant") {
  model::Scene scene = four_bar("planar");
  scene.joints[0].initial.angle = 0.5 * pi; // all bars on one line
  const system::System built = build::build(scene);
  const system::Regime s(built);
  CHECK(s.n_u - s.n_lambda == 1);
  CHECK(build::mobility(s) == 2);
  bool told = false;
  for (const std::string& note : built.notes)
    told = told || note.find("singular pose") != std::string::npos;
  CHECK(told);
}

TEST_CASE("two hinges share the load of one door evenly") {
  model::Scene scene;
  scene.solver.end_time = 1.0;
  scene.bodies = {bar("door", {0.5, 0, 0}, "rigid")};
  scene.joints = {pin("top", "ground", "door", {0, 0, 0.8}, Vector3::UnitZ()),
                  pin("bottom", "ground", "door", {0, 0, -0.8}, Vector3::UnitZ())};
  const system::System built = build::build(scene);
  const system::Regime s(built);
  CHECK(s.n_lambda == 5);
  CHECK(build::mobility(s) == 1);
  const std::vector<Vector6> r = reactions(s);
  const double weight = 2.0 * 9.81;
  CHECK(r[0][2] == doctest::Approx(0.5 * weight));
  CHECK(r[1][2] == doctest::Approx(0.5 * weight));
  // Both together hold the weight and its moment about the axis of the hinges.
  const double moment_y = r[0][4] + r[1][4] + 0.8 * (r[0][0] - r[1][0]);
  CHECK(moment_y == doctest::Approx(-0.5 * weight));
  CHECK(r[0][0] + r[1][0] == doctest::Approx(0.0).epsilon(1e-9));
}

TEST_CASE("a hinge starts at any angle, a lock turned over does not") {
  model::Scene scene;
  scene.solver.end_time = 1.0;
  scene.bodies = {bar("arm", {0, 0, 0.5}, "rigid")};
  for (const double angle : {-3.0, -1.7, 1.7, 2.5}) {
    scene.joints = {pin("hinge", "ground", "arm", {0, 0, 0})};
    scene.joints[0].initial.angle = angle;
    CHECK_NOTHROW(reactions(build::build(scene)));
  }
  scene.joints[0].initial.angle.reset();
  scene.joints[0].type = "fixed";
  scene.bodies[0].initial.rotation = {0, pi, 0};
  scene.bodies[0].initial.displacement = {0, 0, -1.0};
  CHECK_THROWS_AS(reactions(build::build(scene)), ModelError);
}
