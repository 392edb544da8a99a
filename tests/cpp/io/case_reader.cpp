#include "hydrodae/io/case_reader.h"

#include <fstream>

#include "hydrodae/core/text.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/scene_tables.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {

template <class T> const std::vector<T>& forces(const model::Scene& scene) {
  return std::get<std::vector<T>>(scene.forces->lists);
}

std::string force_types() {
  std::vector<std::string> names;
  model::for_each_force_type(
      [&]<class Force>(std::type_identity<Force>) { names.emplace_back(Force::type); });
  return joined(names);
}

void check_messages(const std::vector<BadInput>& table) {
  for (const BadInput& bad : table) {
    const std::string text = replaced(flap_case, bad.old, bad.by);
    CHECK(message_of([&] { read(text); }) == bad.message);
  }
}

} // namespace

TEST_CASE("a case becomes a scene") {
  const model::Scene scene = read(flap_case);
  CHECK(scene.title == "flap");
  CHECK(scene.text == flap_case);
  CHECK(scene.bodies.size() == 2);
  CHECK(scene.bodies[0].motion == std::vector<std::string>{"fixed"});
  CHECK(scene.bodies[1].mass.value == 10.0);
  CHECK(scene.bodies[1].inertia.value == Vector3(1, 2, 3));
  CHECK(*scene.joints[0].axis == Vector3(0, 1, 0));
  CHECK(*scene.joints[0].initial.angle == doctest::Approx(pi / 2).epsilon(1e-15));
  CHECK_FALSE(scene.joints[0].initial.displacement.has_value());
  CHECK(forces<element::PtoLinear>(scene)[0].damping == 5.0);
  CHECK(forces<element::PtoLinear>(scene)[0].stiffness == 0.0);
  CHECK(forces<element::MooringMatrix>(scene).empty());
  CHECK(scene.solver.end_time == 10.0);
  CHECK(scene.output.step == 0.5);
}

TEST_CASE("every form of a value is understood") {
  const std::string mooring = R"([[force]]
name = "mooring"
type = "mooring_matrix"
body = "flap"
stiffness = [1, 2, 3, 4, 5, 6]
damping = [[1, 2, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0],
           [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1]]
)";
  const model::Scene scene =
      read(replaced(flap_case, "motion = \"planar\"", "motion = [\"heave\", \"pitch\"]") + mooring);
  CHECK(scene.bodies[1].motion == std::vector<std::string>{"heave", "pitch"});
  const element::MooringMatrix& force = forces<element::MooringMatrix>(scene)[0];
  CHECK(force.stiffness.diagonal() == (Vector6() << 1, 2, 3, 4, 5, 6).finished());
  CHECK(force.stiffness.sum() == 21.0);
  CHECK(force.damping(0, 1) == 2.0);
  CHECK(force.damping(1, 0) == 0.0);
}

TEST_CASE("a wrong key is told with its place and the nearest name") {
  check_messages({
      {"damping = 5.0", "dampping = 5.0",
       "case.toml:32:1: unknown key 'dampping' in [[force]] 'pto1' of type pto_linear; did you "
       "mean 'damping'? "
       "(valid: name, type, joint, coordinate, damping, stiffness, neutral, delay)"},
      {"gravity = 9.81", "  zzz = 9.81",
       "case.toml:4:3: unknown key 'zzz' in [environment]; valid: gravity, water_density, "
       "water_depth, air_pressure, air_density"},
      {"[solver]", "[solvr]",
       "case.toml:34:2: unknown key 'solvr' in the case; did you mean 'solver'? (valid: title, "
       "missing, "
       "environment, seabed, hydro, pose_table, sea, wave, second_order, body, mode, attachment, "
       "joint, "
       "constraint, "
       "marker, force, morison, chamber, piston, outlet, gauge, "
       "controller, solver, "
       "output)"},
      {"angle_deg", "angle_dg",
       "case.toml:26:13: unknown key 'angle_dg' in initial of [[joint]] 'hinge' of type revolute; "
       "did you mean "
       "'angle_deg'? (valid: angle_deg, angle_rate)"},
      {"mass = 10.0\n", "",
       "case.toml:12:1: missing key 'mass' in [[body]] 'flap' (Mass, or that of the water "
       "displaced in the reference pose (equilibrium) [kg])"},
      {"name = \"flap\"\n", "",
       "case.toml:12:1: missing key 'name' in [[body]] #2 (Name of the body)"},
      {"[solver]\nend_time = 10.0\n", "", "case.toml:1:1: missing table [solver]"},
      {"[[force]]", "[force]", "case.toml:28:1: 'force' must be a list of tables: write [[force]]"},
      {"[solver]", "[[solver]]", "case.toml:34:1: 'solver' must be one table: write [solver]"},
      {"type = \"pto_linear\"\n", "",
       "case.toml:28:1: missing key 'type' in [[force]] 'pto1' (Kind of force: " + force_types() +
           ")"},
      {"type = \"pto_linear\"", "type = \"pto_liner\"",
       "case.toml:30:1: key 'type' in [[force]] 'pto1': unknown value 'pto_liner'; did you mean "
       "'pto_linear'? (valid: " +
           force_types() + ")"},
      {"initial = { angle_deg = 90.0 }", "initial = 90.0",
       "case.toml:26:1: initial of [[joint]] 'hinge' must be a table, such as initial = { ... }"},
  });
}

TEST_CASE("a wrong value is told with its place and what was expected") {
  check_messages({
      {"mass = 10.0", "mass = \"heavy\"",
       "case.toml:15:1: key 'mass' in [[body]] 'flap': expected a number [kg] or "
       "\"equilibrium\", got the string 'heavy'"},
      {"mass = 10.0", "mass = -1",
       "case.toml:15:1: key 'mass' in [[body]] 'flap': must be >= 0 kg, got -1 kg"},
      {"mass = 10.0", "mass = nan",
       "case.toml:15:1: key 'mass' in [[body]] 'flap': must be finite, got nan kg"},
      {"inertia = [1.0, 2.0, 3.0]", "inertia = [1.0, 2.0]",
       "case.toml:17:1: key 'inertia' in [[body]] 'flap': expected 3 numbers [kg m2], got a list "
       "of 2 items"},
      {"inertia = [1.0, 2.0, 3.0]", "inertia = [1.0, 2.0, true]",
       "case.toml:17:1: key 'inertia' in [[body]] 'flap': expected a number [kg m2], got true"},
      {"name = \"flap\"", "name = 3",
       "case.toml:13:1: key 'name' in [[body]] #2: expected a string, got 3"},
      {"motion = \"planar\"", "motion = \"plannar\"",
       "case.toml:14:1: key 'motion' in [[body]] 'flap': unknown value 'plannar'; did you mean "
       "'planar'? (valid: fixed, planar, point, rigid, surge, sway, heave, roll, pitch, yaw)"},
      {"type = \"revolute\"", "type = \"revolut\"",
       "case.toml:21:1: key 'type' in [[joint]] 'hinge': unknown value 'revolut'; did you mean "
       "'revolute'? (valid: spherical, revolute, prismatic, fixed, universal, cylindrical, planar, "
       "sliding, screw, distance, telescope, path)"},
      {"end_time = 10.0", "end_time = 0",
       "case.toml:35:1: key 'end_time' in [solver]: must be > 0 s, got 0 s"},
      {"end_time = 10.0", "end_time = 10.0\nmax_order = 9",
       "case.toml:36:1: key 'max_order' in [solver]: must be >= 1 and <= 5, got 9"},
      {"end_time = 10.0", "end_time = 10.0\nmax_order = 2.5",
       "case.toml:36:1: key 'max_order' in [solver]: expected an integer, got 2.5"},
  });
  CHECK(contains(message_of([] { read("title = \"a\"\ntitle = \"b\"\n"); }), "case.toml:2:"));
  CHECK(contains(message_of([] { read("mass = = 3\n"); }), "case.toml:1:"));
}

TEST_CASE("a scene that contradicts itself is told with the place of the key") {
  check_messages({
      {"body_b = \"flap\"", "body_b = \"flop\"",
       "case.toml:23:1: joint 'hinge': body_b = 'flop' is no body; did you mean 'flap'? (valid: "
       "ground, base, flap)"},
      {"name = \"flap\"", "name = \"base\"",
       "case.toml:13:1: two body entries have the name 'base'"},
      {"axis = [0.0, 1.0, 0.0]\n", "",
       "case.toml:19:1: joint 'hinge': a revolute joint needs the key 'axis'"},
      {"joint = \"hinge\"", "joint = \"hing\"",
       "case.toml:31:1: force 'pto1': joint = 'hing' is no joint; did you mean 'hinge'? (valid: "
       "hinge)"},
      {"angle_deg = 90.0", "displacement = 1.0",
       "case.toml:26:13: unknown key 'displacement' in initial of [[joint]] 'hinge' of type "
       "revolute; valid: angle_deg, angle_rate"},
  });
}

TEST_CASE("overrides replace and add values") {
  const model::Scene scene = read(flap_case, {{"solver.rtol", "1e-8"},
                                              {"solver.end_time", "20"},
                                              {"joint.hinge.initial.angle_deg", "180"},
                                              {"body.base.initial.displacement", "[1, 2, 3]"},
                                              {"force.pto1.stiffness", "7"},
                                              {"body.flap.motion", "[\"pitch\"]"},
                                              {"title", "bare_word"}});
  CHECK(scene.solver.rtol == 1e-8);
  CHECK(scene.solver.end_time == 20.0);
  CHECK(*scene.joints[0].initial.angle == doctest::Approx(pi));
  CHECK(scene.bodies[0].initial.displacement == Vector3(1, 2, 3));
  CHECK(forces<element::PtoLinear>(scene)[0].stiffness == 7.0);
  CHECK(scene.bodies[1].motion == std::vector<std::string>{"pitch"});
  CHECK(scene.title == "bare_word");
  CHECK(scene.overrides.front() == "body.base.initial.displacement = [1, 2, 3]");
  CHECK(contains(scene.text, "\n# solver.rtol = 1e-8\n"));
  CHECK(read(scene.text).solver.rtol == 1e-6); // they are noted as comments only
}

TEST_CASE("a wrong override is told with its key") {
  const auto message = [](const char* key, const char* value) {
    return message_of([&] { read(flap_case, {{key, value}}); });
  };
  CHECK(message("joint.hing.type", "\"fixed\"") ==
        "--set joint.hing.type: no joint 'hing'; did you mean 'hinge'? (valid: hinge)");
  CHECK(message("solver.rtoll", "1") ==
        "--set solver.rtoll: unknown key 'rtoll' in [solver]; did you mean 'rtol'? (valid: method, "
        "formulation, start, end_time, rtol, step, max_step, max_order, order, spectral_radius, "
        "baumgarte_time, energy_guard, branch_guard, accuracy, tolerance_assembly, "
        "force, length_scale, time_scale)");
  CHECK(
      message("solvr.rtol", "1").starts_with("--set solvr.rtol: unknown key 'solvr' in the case"));
  CHECK(message("solver.rtol", "3") ==
        "--set solver.rtol: key 'rtol' in [solver]: must be >= 1e-13 and <= 0.1, got 3");
  CHECK(
      message("solver.rtol", "[1,").starts_with("--set solver.rtol: the value '[1,' is not TOML"));
  CHECK(message("solver.rtol", "1\nother = 2").starts_with("--set solver.rtol: the value"));
  CHECK(message("joint.hinge", "1") == "--set joint.hinge: expected joint.<name>.<key>");
  CHECK(message("title.x", "1") == "--set title.x: 'title' is a value, it holds no keys");
  CHECK(message("solver..rtol", "1").starts_with("--set solver..rtol: expected a dotted key"));
  CHECK(
      message("hydro.axes", "mean") ==
      "--set hydro.axes: missing key 'database' in [hydro] (Path of hydro.h5, relative to the case "
      "file)");
  CHECK(message("joint.hinge.body_b", "flop")
            .starts_with("--set joint.hinge.body_b: joint 'hinge': body_b = 'flop' is no body"));
}

TEST_CASE("results in place of a case are told as what they are") {
  CHECK(message_of([] { read("\x89HDF\r\n\x1a\n"); }) ==
        "case.toml: is an HDF5 file, as results and databases are; a case is a TOML file");
}

TEST_CASE("files are named in errors") {
  const TemporaryFolder folder;
  const std::string path = folder / "case.toml";
  CHECK(message_of([&] { io::read_case(path); }) ==
        path + ": cannot read the case file: No such file or directory");
  CHECK(message_of([&] { io::read_case(folder.path()); }) ==
        folder.path() + ": is a folder; give the case file in it");
  std::ofstream(path) << replaced(flap_case, "[[joint]]",
                                  "[hydro]\ndatabase = \"no.h5\"\n\n[[joint]]");
  CHECK(message_of([&] { io::read_case(path); }) ==
        path + ":20:1: key 'database' in [hydro]: " + (folder / "no.h5") + ": no such file");
  std::ofstream(path) << flap_case;
  CHECK(io::read_case(path).path == path);
}
