/// Joints with parameters, constraints and the forces between bodies, as structs.

#include "hydrodae/joint/types.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/motion.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;
using model::Body;
using model::Constraint;
using model::Coupler;
using model::DrivenCoordinate;
using model::Joint;
using model::Scene;

namespace {

Body body(const std::string& name, const std::string& motion) {
  Body b;
  b.name = name;
  b.motion = {motion};
  b.mass = 2.0;
  b.inertia = Vector3(1, 1, 1);
  return b;
}

Joint make_joint(const std::string& name, const std::string& type, const std::string& body_a,
                 const std::string& body_b) {
  Joint j;
  j.name = name;
  j.type = type;
  j.body_a = body_a;
  j.body_b = body_b;
  j.point = Vector3(1, 0, 0);
  if (joint::find_joint_type(type)->needs_axis)
    j.axis = Vector3(0, 0, 1);
  if (type == "distance" || type == "telescope")
    j.point_b = Vector3(1, 0, -2);
  if (type == "screw")
    j.pitch = 0.1;
  if (type == "path")
    j.path = {{0, 0, 0}, {1, 0, 0.2}, {2, 0, 0}};
  return j;
}

DrivenCoordinate coordinate(const std::string& owner) {
  DrivenCoordinate c;
  c.name = "c";
  c.joint = owner;
  return c;
}

Coupler coupler(const std::string& owner, const std::string& other) {
  Coupler c;
  c.name = "c";
  c.joint = owner;
  c.joint_b = other;
  return c;
}

/// Two rigid bodies, a planar one and a point, and one joint of each kind that the tests need.
Scene machine() {
  Scene scene;
  scene.bodies = {body("a", "rigid"), body("b", "rigid"), body("p", "point"),
                  body("sled", "planar")};
  scene.joints = {
      make_joint("hinge", "revolute", "ground", "a"), make_joint("tube", "cylindrical", "a", "b"),
      make_joint("table", "planar", "ground", "b"), make_joint("ball", "spherical", "a", "b")};
  scene.solver.end_time = 10.0;
  return scene;
}

std::string verdict_of(const Joint& j) {
  Scene scene = machine();
  scene.joints = {j};
  return verdict(scene);
}

std::string verdict_of(const Constraint& c) {
  Scene scene = machine();
  scene.constraints = {c};
  return verdict(scene);
}

template <class C, class Change> std::string verdict_of(C c, const Change& change) {
  change(c);
  return verdict_of(Constraint(c));
}

using Names = std::vector<std::string>;

Names motions(const std::string& type) {
  return joint::motion_names(*joint::find_joint_type(type));
}

} // namespace

TEST_CASE("motions of joints are named by kind and order") {
  CHECK(motions("fixed").empty());
  CHECK(motions("distance").empty());
  CHECK(motions("revolute") == Names{"angle"});
  CHECK(motions("sliding") == Names{"displacement"});
  CHECK(motions("cylindrical") == Names{"angle", "displacement"});
  CHECK(motions("universal") == Names{"angle", "angle_2"});
  CHECK(motions("planar") == Names{"angle", "displacement", "displacement_2"});
}

TEST_CASE("every joint of the table needs its own keys") {
  for (const joint::JointType& type : joint::joint_types()) {
    const std::string name(type.name), head = "a " + name + " joint ";
    CAPTURE(name);
    const Joint good = make_joint("j", name, "a", "b");
    CHECK(verdict_of(good) == "");
    Joint j = good;
    if (type.needs_axis) {
      j.axis = std::nullopt;
      CHECK(verdict_of(j) == "joint.j: joint 'j': " + head + "needs the key 'axis'");
    }
    j = good;
    if (type.has_two_points()) {
      j.point_b = std::nullopt;
      CHECK(verdict_of(j) ==
            "joint.j: joint 'j': " + head + "needs the key 'point_b', the point on body B");
    }
    j = good;
    if (name == "screw") {
      j.pitch = 0.0;
      CHECK(verdict_of(j) == "joint.j.pitch: joint 'j': a screw joint needs the key 'pitch' "
                             "[m per turn], and not zero");
    }
    if (name == "path") {
      j.path.clear();
      CHECK(verdict_of(j) == "joint.j: joint 'j': a path joint needs the key 'path', the points of "
                             "the curve that body A carries");
    }
  }
  Joint rope = make_joint("rope", "distance", "a", "ground");
  rope.point_b = rope.point;
  CHECK(verdict_of(rope) == "joint.rope.point_b: joint 'rope': point and point_b coincide: their "
                            "distance has no direction");
}

TEST_CASE("a path says what keeps it from being one") {
  const auto flaw = [](std::vector<Vector3> points) {
    Joint j = make_joint("j", "path", "a", "b");
    j.path = std::move(points);
    return verdict_of(j);
  };
  const std::string head = "joint.j.path: joint 'j': the path ";
  CHECK(flaw({{0, 0, 0}}) == head + "needs two points or more");
  CHECK(flaw({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}) == head + "points 2 and 3 are the same");
  CHECK(flaw({{0, 0, 0}, {1, 0, 0}, {0.2, 0, 0.3}}).find("turns by more than 60 degrees") !=
        std::string::npos);
  std::vector<Vector3> circle;
  for (int k = 0; k <= 24; ++k)
    circle.emplace_back(std::cos(pi * k / 12), 0, std::sin(pi * k / 12));
  CHECK(flaw(circle).find("comes back near itself") != std::string::npos);
  circle.resize(24); // 345 degrees
  CHECK(flaw(circle) == "");
}

TEST_CASE("a point has no rotation that a joint could hold") {
  for (const joint::JointType& type : joint::joint_types()) {
    const std::string name(type.name);
    CAPTURE(name);
    const bool joins_points = name == "spherical" || name == "distance" || name == "telescope";
    const std::string reason = "body 'p' is a point: it has no rotation for a " + name +
                               " joint to hold; use spherical, distance, sliding or path";
    const std::string as_a = verdict_of(make_joint("j", name, "p", "a"));
    const std::string as_b = verdict_of(make_joint("j", name, "ground", "p"));
    if (name == "sliding" || name == "path") {
      CHECK(as_b == "");
      CHECK(as_a == "joint.j.body_a: joint 'j': body 'p' is a point: it cannot carry the " +
                        std::string(name == "path" ? "curve" : "axis") + " of a " + name +
                        " joint; make it body_b");
    } else {
      CHECK(as_a == (joins_points ? "" : "joint.j.body_a: joint 'j': " + reason));
      CHECK(as_b == (joins_points ? "" : "joint.j.body_b: joint 'j': " + reason));
    }
  }
}

TEST_CASE("a coordinate constraint means one coordinate that exists") {
  CHECK(verdict_of(coordinate("hinge")) == "");
  CHECK(verdict_of(coordinate("hing")) ==
        "constraint.c.joint: constraint 'c': joint = 'hing' is no joint; did you mean 'hinge'? "
        "(valid: hinge, tube, table, ball)");
  CHECK(verdict_of(coordinate("ball")) ==
        "constraint.c.joint: constraint 'c': joint 'ball' has no coordinate: a spherical joint has "
        "no motion of its own");
  CHECK(verdict_of(coordinate("table"),
                   [](DrivenCoordinate& c) { c.coordinate = "displacement_2"; }) == "");
  CHECK(verdict_of(coordinate("table"),
                   [](DrivenCoordinate& c) { c.coordinate = "displacement_3"; }) ==
        "constraint.c.coordinate: constraint 'c': coordinate = 'displacement_3' is no motion of "
        "joint 'table'; did you mean 'displacement_2'? (valid: angle, displacement, "
        "displacement_2)");
  CHECK(verdict_of(coordinate("hinge"), [](DrivenCoordinate& c) { c.joint.reset(); }) ==
        "constraint.c: constraint 'c': needs the key 'joint' or 'body' that has the coordinate");
  CHECK(verdict_of(coordinate("hinge"), [](DrivenCoordinate& c) { c.body = "sled"; }) ==
        "constraint.c.body: constraint 'c': has both 'joint' and 'body'; a coordinate belongs to "
        "one of them");
}

TEST_CASE("a coordinate constraint of a body means a free coordinate") {
  DrivenCoordinate c = coordinate("");
  c.joint.reset();
  c.body = "sled";
  CHECK(verdict_of(c) ==
        "constraint.c: constraint 'c': needs the key 'coordinate', a free coordinate of body "
        "'sled'; valid: surge, heave, pitch");
  c.coordinate = "heave";
  CHECK(verdict_of(c) == "");
  c.coordinate = "sway";
  CHECK(verdict_of(c) ==
        "constraint.c.coordinate: constraint 'c': coordinate = 'sway' is no free coordinate of "
        "body 'sled'; valid: surge, heave, pitch");
  c.body = "sledge";
  CHECK(verdict_of(c) ==
        "constraint.c.body: constraint 'c': body = 'sledge' is no body; did you mean 'sled'? "
        "(valid: a, b, p, sled)");
}

TEST_CASE("a drive is a function on the whole run") {
  const auto verdict_with = [](std::vector<double> time, std::vector<double> values) {
    return verdict_of(coordinate("hinge"), [&](DrivenCoordinate& c) {
      c.drive.time = std::move(time);
      c.drive.values = std::move(values);
    });
  };
  const std::string head = "constraint.c.drive.time: constraint 'c': ";
  CHECK(verdict_with({0, 4, 10}, {1, 2, 3}) == "");
  CHECK(verdict_with({-1, 11}, {1, 2}) == "");
  CHECK(verdict_with({0, 4, 10}, {1, 2}) ==
        head + "the table of drive needs as many times as values; 'time' has 3 numbers, 'values' "
               "has 2 numbers");
  CHECK(verdict_with({}, {1}) ==
        "constraint.c.drive.values: constraint 'c': the table of drive needs as many times as "
        "values; 'time' has 0 numbers, 'values' has 1 number");
  CHECK(verdict_with({0}, {1}) == head + "the table of drive needs two points or more, it has one");
  CHECK(verdict_with({0, 4, 4, 10}, {1, 2, 3, 4}) ==
        head + "the times of drive must ascend, but 4 s follows 4 s");
  CHECK(verdict_with({0, 9.5}, {1, 2}) ==
        head + "the table of drive goes from 0 s to 9.5 s, but the run goes from 0 s to 10 s "
               "(solver.end_time)");
  CHECK(contains(verdict_with({0.5, 10}, {1, 2}), "goes from 0.5 s to 10 s, but the run"));
  CHECK(verdict_of(coordinate("hinge"), [](DrivenCoordinate& c) { c.drive.amplitude = 1.0; }) ==
        "constraint.c.drive.amplitude: constraint 'c': drive has an 'amplitude' but no 'period' of "
        "its sine");
}

TEST_CASE("a coupler joins two motions of joints") {
  CHECK(verdict_of(coupler("hinge", "tube")) == "");
  CHECK(verdict_of(coupler("tube", "tube"), [](Coupler& c) { c.coordinate_b = "displacement"; }) ==
        "");
  CHECK(verdict_of(coupler("tube", "tube"), [](Coupler& c) { c.coordinate_b = "angle"; }) ==
        "constraint.c.joint_b: constraint 'c': couples a motion of 'tube' with itself");
  CHECK(verdict_of(coupler("hinge", "tub")) ==
        "constraint.c.joint_b: constraint 'c': joint_b = 'tub' is no joint; did you mean 'tube'? "
        "(valid: hinge, tube, table, ball)");
  CHECK(contains(verdict_of(coupler("hinge", "ball")), "joint 'ball' has no coordinate"));
  CHECK(contains(
      verdict_of(coupler("hinge", "tube"), [](Coupler& c) { c.coordinate_b = "displacment"; }),
      "constraint.c.coordinate_b: constraint 'c': coordinate_b = 'displacment' is no "
      "motion of joint 'tube'; did you mean 'displacement'?"));
  CHECK(verdict_of(coupler("hinge", "tube"), [](Coupler& c) { c.ratio = 0.0; }) ==
        "constraint.c.ratio: constraint 'c': ratio must not be zero");
}

TEST_CASE("names of constraints are unique") {
  Scene scene = machine();
  scene.constraints = {coordinate("hinge"), coordinate("tube")};
  CHECK(verdict(scene) == "constraint.c.name: two constraint entries have the name 'c'");
  scene.constraints[1]->name = "c/d";
  CHECK(contains(verdict(scene), "constraint name 'c/d' may hold letters, digits, _ and - only"));
  scene.constraints[1]->name = "hinge"; // the name of a joint is free for a constraint
  CHECK(verdict(scene) == "");
}

TEST_CASE("forces between bodies have two ends and a direction") {
  Scene scene = machine();
  auto& springs = std::get<std::vector<element::SpringDamper>>(scene.forces->lists);
  springs.resize(1);
  element::SpringDamper& spring = springs[0];
  spring.name = "spring";
  spring.body_a = "ground";
  spring.body_b = "a";
  spring.point_b = Vector3(0, 0, 1);
  CHECK(verdict(scene) == "");
  spring.body_b = "c";
  CHECK(verdict(scene) == "force.spring.body_b: force 'spring': body_b = 'c' is no body; valid: "
                          "ground, a, b, p, sled");
  spring.body_b = "ground";
  CHECK(verdict(scene) == "force.spring.body_b: force 'spring': joins 'ground' with itself");
  spring.body_b = "a";
  spring.point_b = spring.point_a;
  spring.force = 1.0;
  CHECK(verdict(scene) == "force.spring.point_b: force 'spring': point_a and point_b coincide in "
                          "the reference pose: the force has no direction there, and is not zero "
                          "(a linear spring with length = 0 is)");
  springs.clear();
  auto& loads = std::get<std::vector<element::ConstantLoad>>(scene.forces->lists);
  loads.resize(1);
  loads[0].name = "load";
  loads[0].body = "sle";
  CHECK(verdict(scene) == "force.load.body: force 'load': body = 'sle' is no body; did you mean "
                          "'sled'? (valid: a, b, p, sled)");
}

TEST_CASE("a power take-off needs a joint with one motion") {
  Scene scene = machine();
  auto& ptos = std::get<std::vector<element::PtoLinear>>(scene.forces->lists);
  ptos.resize(1);
  ptos[0].name = "pto";
  ptos[0].joint = "hinge";
  CHECK(verdict(scene) == "");
  ptos[0].joint = "ball";
  CHECK(contains(verdict(scene), "force.pto.joint: force 'pto': joint 'ball' has no coordinate: a "
                                 "spherical joint has no motion"));
  ptos[0].joint = "tube";
  CHECK(contains(verdict(scene), "a cylindrical joint has more than one coordinate"));
}

TEST_CASE("a summary tells what joints keep and what constraints follow") {
  Scene scene = machine();
  scene.joints.push_back(make_joint("rope", "distance", "a", "p"));
  scene.joints.push_back(make_joint("nut", "screw", "a", "b"));
  DrivenCoordinate crank = coordinate("hinge");
  crank.name = "crank";
  crank.drive.amplitude = 0.1;
  crank.drive.period = 5.0;
  DrivenCoordinate motor = coordinate("table");
  motor.name = "motor";
  motor.coordinate = "displacement_2";
  motor.level = "velocity";
  motor.drive = {-0.5, 2.0, -3.0, 4.0, -pi / 6, 8.0, {0, 10}, {1, 1}, {}, false, {}};
  DrivenCoordinate lock = coordinate("tube");
  lock.name = "lock";
  DrivenCoordinate lift = lock;
  lift.name = "lift";
  lift.joint.reset();
  lift.body = "sled";
  lift.coordinate = "heave";
  lift.drive.time = lift.drive.values = {0, 5, 10};
  Coupler gear = coupler("hinge", "tube");
  gear.name = "gear";
  gear.ratio = -2.0;
  scene.constraints = {crank, motor, lock, lift, gear};
  auto& springs = std::get<std::vector<element::SpringDamper>>(scene.forces->lists);
  springs.resize(1);
  springs[0].name = "spring";
  springs[0].body_a = "ground";
  springs[0].body_b = "a";
  springs[0].point_b = Vector3(0, 0, 1);
  REQUIRE(verdict(scene) == "");

  const std::string text = model::summary(scene);
  CHECK(contains(text, "    rope: distance, a - p, length 2 m\n"));
  CHECK(contains(text, "    nut: screw, a - b, 0.1 m per turn\n"));
  CHECK(contains(text, "    hinge: revolute, ground - a\n"));
  CHECK(contains(text, "  constraints:\n"
                       "    crank: angle of hinge follows 0.1 sin(2 pi t / 5)\n"
                       "    motor: rate of displacement_2 of table follows -0.5 + 2 t - 3 sin(2 pi "
                       "t / 4 - 30 deg) grown over 8 s + a table of 2 points\n"
                       "    lock: angle of tube stays 0\n"
                       "    lift: heave of sled follows a table of 3 points\n"
                       "    gear: angle of tube moves -2 x angle of hinge\n"));
  CHECK(contains(text, "    spring: spring_damper between ground and a\n"));
}
