/// Rows that do not hold (open stops, slack ropes, slipping friction) beside rows that follow from
/// others: neither has a place among the unknowns.

#include <filesystem>

#include "hydrodae/build/build.h"
#include "hydrodae/check/examine.h"
#include "hydrodae/io/case_reader.h"
#include "hydrodae/measure/observer.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/simulation.h"
#include "hydrodae/statics/equilibrium.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

namespace {

/// Dry friction of 0.5 N or N m.
void add_friction(model::Scene& scene, const std::string& joint) {
  element::DryFriction friction;
  friction.name = "dry";
  friction.joint = joint;
  friction.static_load = 0.5;
  std::get<std::vector<element::DryFriction>>(scene.forces->lists).push_back(friction);
}

model::Joint jointed(const std::string& type, const std::string& name, const std::string& a,
                     const std::string& b, const Vector3& point) {
  model::Joint j;
  j.name = name;
  j.type = type;
  j.body_a = a;
  j.body_b = b;
  j.point = point;
  j.axis = Vector3::UnitY();
  return j;
}

model::Constraint stop(const std::string& name, const std::string& on, double upper) {
  model::Stop c;
  c.name = name;
  c.joint = on;
  c.upper_angle = upper;
  return c;
}

/// The door benchmark, five of whose ten rows follow from the others.
model::Scene door() {
  const auto root = std::filesystem::path(__FILE__).parent_path() / "../../../cases/benchmarks";
  return io::read_case((root / "door.toml").string());
}

/// A hanging swing of rigid bars of 1 m; three of its 20 rows are redundant.
model::Scene closed_loop() {
  model::Scene scene;
  scene.bodies = {bar("crank", {0, 0, -0.5}), bar("coupler", {0.5, 0, -1.0}),
                  bar("rocker", {1.0, 0, -0.5})};
  scene.joints = {jointed("revolute", "a", "ground", "crank", {0, 0, 0}),
                  jointed("revolute", "b", "crank", "coupler", {0, 0, -1}),
                  jointed("revolute", "c", "coupler", "rocker", {1, 0, -1}),
                  jointed("revolute", "d", "rocker", "ground", {1, 0, 0})};
  scene.solver.end_time = 1.0;
  scene.output.step = 0.1;
  return scene;
}

/// A prismatic and a revolute joint at one point: nothing is left to move.
model::Scene locked() {
  model::Scene scene;
  scene.bodies = {bar("arm", {0.5, 0, 0})};
  scene.joints = {jointed("prismatic", "slide", "ground", "arm", {0, 0, 0}),
                  jointed("revolute", "hinge", "ground", "arm", {0, 0, 0})};
  scene.solver.end_time = 1.0;
  scene.output.step = 0.1;
  return scene;
}

int dropped_rows(const system::System& s) {
  int count = 0;
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      count += row.dropped ? 1 : 0;
  return count;
}

} // namespace

TEST_CASE("open stops, slack ropes and dry friction are no redundant rows") {
  model::Scene scene = door();
  const double upper = 10.0 * pi / 180.0;
  scene.constraints = {stop("s", "upper", upper), stop("s2", "upper", upper)};
  model::Joint rope = jointed("distance", "rope", "ground", "door", {2, 0, 0});
  rope.axis.reset();
  rope.point_b = Vector3(0, 0.5, 0);
  rope.length = 3.0;
  rope.one_sided = true;
  scene.joints.push_back(rope);
  add_friction(scene, "lower");
  const system::System built = build::build(scene);
  const system::Regime s(built);
  CHECK(s.n_lambda == 5);
  CHECK(dropped_rows(built) == 5);
  for (const system::CouplerData& c : s.couplers)
    CHECK(!s.holds(c));
  bool told = false;
  for (const std::string& note : built.notes)
    told = told || note.starts_with("5 redundant constraint rows");
  CHECK(told);
  CHECK(contains(examine(scene), "5 redundant constraint rows"));
}

TEST_CASE("a closed loop with redundant rows comes to rest on its stop") {
  model::Scene scene = closed_loop();
  scene.joints[0].initial.angle = 0.5; // it would hang at 0
  scene.constraints = {stop("s", "a", 1.0)};
  scene.constraints[0].as<model::Stop>()->lower_angle = 0.2;
  scene.solver.start = "equilibrium";
  system::System built = build::build(scene);
  CHECK(system::Regime(built).n_lambda == 17);
  const auto [y, modes, instability] = statics::move_to_equilibrium(built);
  CHECK(instability.empty());
  const system::Regime s(built, modes);
  CHECK(s.n_lambda == 18);
  CHECK(2.0 * std::atan2(s.bodies[0].orientation[2], s.bodies[0].orientation[0]) ==
        doctest::Approx(0.2).epsilon(1e-9));
  // Bars of 2 kg: the stop holds what turns the swing back, 2 m g L sin(angle).
  measure::Observer observer(s);
  const double load = observer.observe(0.0, y, VectorX::Zero(s.n)).constraints[0];
  CHECK(load == doctest::Approx(4.0 * 9.81 * std::sin(0.2)).epsilon(1e-9));
  for (const char* method : {"ida", "radau", "explicit_rk"}) {
    CAPTURE(method);
    scene.solver.method = method;
    CHECK(simulate(scene, "", {}).status == "completed");
  }
}

TEST_CASE("what the joints hold stays where it is, with stops and friction on its coordinates") {
  for (const double upper : {0.0, 10.0 * pi / 180.0})
    for (const char* method : {"ida", "radau", "explicit_rk"}) {
      CAPTURE(upper);
      CAPTURE(method);
      model::Scene scene = locked();
      scene.constraints = {stop("s", "hinge", upper)};
      add_friction(scene, "hinge");
      scene.solver.method = method;
      const system::System built = build::build(scene);
      CHECK(system::Regime(built).n_lambda == 6);
      CHECK(simulate(scene, "", {}).status == "completed");
    }
}
