/// Mechanisms in case files: joints with parameters, constraints with their drives, forces between
/// bodies.

#include "hydrodae/io/case_reader.h"
#include "hydrodae/model/forces.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {

const std::string crank_case = R"(title = "crank"

[[body]]
name = "wheel"
mass = 10.0
center_of_gravity = [0.0, 0.0, 0.0]
inertia = [1.0, 2.0, 2.5]
principal_axes_deg = [0.0, 0.0, 90.0]

[[body]]
name = "weight"
motion = "point"
mass = 3.0
center_of_gravity = [0.0, 0.0, -2.0]

[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "wheel"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]

[[joint]]
name = "rope"
type = "distance"
body_a = "wheel"
body_b = "weight"
point = [0.0, 0.0, -0.5]
point_b = [0.0, 0.0, -2.0]
length = 1.5

[[constraint]]
name = "crank"
type = "coordinate"
joint = "hinge"
[constraint.drive]
amplitude = 0.1
period = 5
phase_deg = 90.0

[[constraint]]
name = "lift"
type = "coordinate"
body = "weight"
coordinate = "sway"
level = "velocity"
drive = { time = [0, 5, 10], values = [1.0, 2.0, 5.0] }

[[force]]
name = "spring"
type = "spring_damper"
body_a = "ground"
body_b = "weight"
point_a = [5.0, 0.0, -2.0]
point_b = [0.0, 0.0, -2.0]
stiffness = 7.0

[[force]]
name = "wind"
type = "constant_load"
body = "wheel"
moment = [0.0, 3.0, 0.0]

[solver]
end_time = 10.0
)";

std::string message(const std::string& old, const std::string& by) {
  return message_of([&] { read(replaced(crank_case, old, by)); });
}

const std::vector<BadInput> bad_inputs = {
    {"amplitude = 0.1", "amplitud = 0.1",
     "case.toml:38:1: unknown key 'amplitud' in drive of [[constraint]] 'crank' of type "
     "coordinate; did you mean "
     "'amplitude'? (valid: constant, rate, amplitude, period, phase_deg, ramp, time, values, "
     "python)"},
    {"period = 5", "period = 0",
     "case.toml:39:1: key 'period' in drive of [[constraint]] 'crank': must be > 0 s, got 0 s"},
    {"period = 5\n", "",
     "case.toml:38:1: constraint 'crank': drive has an 'amplitude' but no 'period' of its sine"},
    {"period = 5", "period = 5\nramp = -1",
     "case.toml:40:1: key 'ramp' in drive of [[constraint]] 'crank': must be >= 0 s, got -1 s"},
    {"joint = \"hinge\"", "joint = \"hing\"",
     "case.toml:36:1: constraint 'crank': joint = 'hing' is no joint; did you mean 'hinge'? "
     "(valid: hinge, rope)"},
    {"coordinate = \"sway\"", "coordinate = \"pitch\"",
     "case.toml:46:1: constraint 'lift': coordinate = 'pitch' is no free coordinate of body "
     "'weight'; valid: surge, sway, heave"},
    {"level = \"velocity\"", "level = \"speed\"",
     "case.toml:47:1: key 'level' in [[constraint]] 'lift': unknown value 'speed'; valid: "
     "position, velocity"},
    {"drive = { time = [0, 5, 10], values = [1.0, 2.0, 5.0] }", "drive = 2.0",
     "case.toml:48:1: drive of [[constraint]] 'lift' must be a table, such as drive = { ... }"},
    {"time = [0, 5, 10]", "time = [0, 5, 9]",
     "case.toml:48:11: constraint 'lift': the table of drive goes from 0 s to 9 s, but the run "
     "goes from 0 s to 10 s (solver.end_time)"},
    {"time = [0, 5, 10]", "time = [0, 10]",
     "case.toml:48:11: constraint 'lift': the table of drive needs as many times as values; "
     "'time' has 2 numbers, 'values' has 3 numbers"},
    {"time = [0, 5, 10]", "time = 10",
     "case.toml:48:11: key 'time' in drive of [[constraint]] 'lift': expected a list of numbers "
     "[s], got 10"},
    {"time = [0, 5, 10]", "time = []",
     "case.toml:48:11: key 'time' in drive of [[constraint]] 'lift': expected a list of numbers "
     "[s], got a list of 0 items"},
    {"time = [0, 5, 10]", "time = [0, \"5\", 10]",
     "case.toml:48:11: key 'time' in drive of [[constraint]] 'lift': expected a number [s], got "
     "the string '5'"},
    {"time = [0, 5, 10]", "time = [0, inf]",
     "case.toml:48:11: key 'time' in drive of [[constraint]] 'lift': must be finite, got inf s"},
    {"name = \"lift\"", "name = \"crank\"",
     "case.toml:43:1: two constraint entries have the name 'crank'"},
    {"type = \"coordinate\"\njoint", "type = \"coordinat\"\njoint",
     "case.toml:35:1: key 'type' in [[constraint]] 'crank': unknown value 'coordinat'; did you "
     "mean 'coordinate'? (valid: coordinate, coupler, stop)"},
    {"[[force]]\nname = \"spring\"", "[constraints]\n[[force]]\nname = \"spring\"",
     "case.toml:50:2: unknown key 'constraints' in the case; did you mean 'constraint'? (valid: "
     "title, missing, environment, seabed, hydro, pose_table, sea, wave, second_order, body, mode, "
     "attachment, joint, "
     "constraint, "
     "marker, force, morison, "
     "chamber, piston, outlet, gauge, "
     "controller, solver, "
     "output)"},
    {"point_b = [0.0, 0.0, -2.0]\nlength = 1.5\n", "",
     "case.toml:24:1: joint 'rope': a distance joint needs the key 'point_b', the point on body "
     "B"},
    {"point_b = [0.0, 0.0, -2.0]\nlength", "point_b = [0.0, 0.0, -0.5]\nlength",
     "case.toml:30:1: joint 'rope': point and point_b coincide: their distance has no "
     "direction"},
    {"length = 1.5", "length = 0",
     "case.toml:31:1: key 'length' in [[joint]] 'rope': must be > 0 m, got 0 m"},
    {"length = 1.5", "length = 1.5\npitch = 1",
     "case.toml:32:1: unknown key 'pitch' in [[joint]] 'rope' of type distance; valid: name, type, "
     "body_a, body_b, point, point_b, length, one_sided, restitution, contact_time"},
    {"axis = [0.0, 1.0, 0.0]", "axis = [0.0, 1.0, 0.0]\ninitial = { displacement = 1.0 }",
     "case.toml:23:13: unknown key 'displacement' in initial of [[joint]] 'hinge' of type "
     "revolute; "
     "valid: angle_deg, angle_rate"},
    {"body = \"weight\"\ncoordinate", "body = \"weight\"\nratio = 2\ncoordinate",
     "case.toml:46:1: unknown key 'ratio' in [[constraint]] 'lift' of type coordinate; valid: "
     "name, "
     "type, joint, body, coordinate, level, drive"},
    {"body_b = \"wheel\"", "body_b = \"weight\"",
     "case.toml:20:1: joint 'hinge': body 'weight' is a point: it has no rotation for a revolute "
     "joint to hold; use spherical, distance, sliding or path"},
    {"body_b = \"weight\"\npoint_a = [5.0", "body_b = \"wheight\"\npoint_a = [5.0",
     "case.toml:54:1: force 'spring': body_b = 'wheight' is no body; did you mean 'weight'? "
     "(valid: ground, wheel, weight)"},
    {"point_a = [5.0", "force = 1.0\npoint_a = [0.0",
     "case.toml:57:1: force 'spring': point_a and point_b coincide in the reference pose: the "
     "force has no direction there, and is not zero (a linear spring with length = 0 is)"},
    {"body = \"wheel\"", "body = \"wheal\"",
     "case.toml:62:1: force 'wind': body = 'wheal' is no body; did you mean 'wheel'? (valid: "
     "wheel, weight)"},
    {"principal_axes_deg", "products_of_inertia = [0.1, 0, 0]\nprincipal_axes_deg",
     "case.toml:9:1: body 'wheel': principal_axes_deg and products_of_inertia exclude each "
     "other: with principal axes, 'inertia' holds the principal moments"},
};

} // namespace

TEST_CASE("a case with a mechanism becomes a scene") {
  const model::Scene scene = read(crank_case);
  CHECK((*scene.bodies[0].principal_axes - Vector3(0, 0, pi / 2)).norm() < 1e-15);
  CHECK_FALSE(scene.bodies[1].principal_axes.has_value());
  CHECK(*scene.joints[1].point_b == Vector3(0, 0, -2));
  CHECK(*scene.joints[1].length == 1.5);
  CHECK_FALSE(scene.joints[0].length.has_value());

  REQUIRE(scene.constraints.size() == 2);
  const auto &crank = *scene.constraints[0].as<model::DrivenCoordinate>(),
             &lift = *scene.constraints[1].as<model::DrivenCoordinate>();
  CHECK(crank.name == "crank");
  CHECK(*crank.joint == "hinge");
  CHECK_FALSE(crank.coordinate.has_value());
  CHECK(crank.level == "position");
  CHECK(crank.drive(0.0)[0] == doctest::Approx(0.1).epsilon(1e-15));
  CHECK(crank.drive(2.5)[0] == doctest::Approx(-0.1).epsilon(1e-15));
  CHECK(*lift.body == "weight");
  CHECK(*lift.coordinate == "sway");
  CHECK(lift.level == "velocity");
  CHECK(lift.drive.time == std::vector<double>{0, 5, 10});
  CHECK(lift.drive(5.0)[0] == doctest::Approx(2.0)); // the spline was made
  CHECK(lift.drive(10.0)[0] == doctest::Approx(5.0));

  const auto& spring = std::get<std::vector<element::SpringDamper>>(scene.forces->lists)[0];
  CHECK(spring.law().stiffness == 7.0);
  CHECK(spring.law().length == 5.0);
  CHECK(std::get<std::vector<element::ConstantLoad>>(scene.forces->lists)[0].moment ==
        Vector3(0, 3, 0));
}

TEST_CASE("the pitch of a screw is read") {
  const std::string screw =
      replaced(crank_case, "type = \"revolute\"", "type = \"screw\"\npitch = -0.2");
  CHECK(read(screw).joints[0].pitch == -0.2);
}

TEST_CASE("a mistake in a mechanism is told with its place") {
  for (const BadInput& bad : bad_inputs)
    CHECK(message(bad.old, bad.by) == bad.message);
  CHECK(message("[[constraint]]\nname = \"crank\"", "[constraint]\nname = \"crank\"")
            .starts_with("case.toml:"));
}

TEST_CASE("overrides address constraints and their drives") {
  const model::Scene scene = read(crank_case, {{"constraint.crank.drive.amplitude", "0.4"},
                                               {"constraint.lift.level", "position"},
                                               {"constraint.lift.drive.values", "[1, 1, 1]"},
                                               {"constraint.lift.drive.constant", "2"}});
  const auto &crank = *scene.constraints[0].as<model::DrivenCoordinate>(),
             &lift = *scene.constraints[1].as<model::DrivenCoordinate>();
  CHECK(crank.drive(0.0)[0] == doctest::Approx(0.4));
  CHECK(lift.level == "position");
  CHECK(lift.drive(3.0)[0] == doctest::Approx(3.0));
  const auto said = [](const char* key, const char* value) {
    return message_of([&] { read(crank_case, {{key, value}}); });
  };
  CHECK(said("constraint.crnk.level", "velocity") ==
        "--set constraint.crnk.level: no constraint 'crnk'; did you mean 'crank'? (valid: crank, "
        "lift)");
  CHECK(said("solver.end_time", "20") ==
        "case.toml:48:11: constraint 'lift': the table of drive goes from 0 s to 10 s, but the run "
        "goes from 0 s to 20 s (solver.end_time)");
  CHECK(said("constraint.lift.drive.time", "[0, 10, 5]") ==
        "--set constraint.lift.drive.time: constraint 'lift': the times of drive must ascend, but "
        "5 s follows 10 s");
}
