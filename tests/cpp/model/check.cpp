#include <limits>

#include "hydrodae/joint/types.h"
#include "hydrodae/model/motion.h"
#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;
using model::Body;
using model::Joint;
using model::Scene;

namespace {

using Six = std::array<bool, 6>;

Body body(std::vector<std::string> motion) {
  Body b;
  b.name = "buoy";
  b.motion = std::move(motion);
  b.mass = 2.0;
  b.inertia = Vector3(1, 1, 1);
  return b;
}

Six six(const char* text) { // "101010"
  Six out{};
  for (std::size_t i = 0; i < 6; ++i)
    out[i] = text[i] == '1';
  return out;
}

hydro::MemoryFit fit(const std::string& name, std::vector<std::string> inputs, int states) {
  hydro::MemoryFit f;
  f.passive = true;
  f.name = name;
  f.inputs = f.outputs = std::move(inputs);
  f.states = states;
  return f;
}

/// A wet, planar buoy; its database has all coordinates and two fits that cover it.
struct Wet {
  Scene scene;
  std::shared_ptr<hydro::Database> database = std::make_shared<hydro::Database>();

  Wet() {
    database->path = "hydro.h5";
    database->gravity = 9.81;
    for (std::string_view name : model::coordinate_names)
      database->coordinates.push_back("float." + std::string(name));
    database->bodies = {{"float", Vector3(0, 0, -1), hydro::Hydrostatics{}, false, {}, {}}};
    database->fits = {fit("large", {"float.surge", "float.heave", "float.pitch"}, 9),
                      fit("small", {"float.pitch", "float.surge", "float.heave"}, 4),
                      fit("heave", {"float.heave"}, 2)};
    scene.hydro.emplace();
    scene.bodies = {body({"planar"})};
    scene.bodies[0].hydro = "float";
    scene.bodies[0].center_of_gravity = Vector3(0, 0, -1);
    scene.database = database;
  }
  Body& buoy() { return scene.bodies[0]; }
};

} // namespace

TEST_CASE("words of motion") {
  CHECK(free_coordinates(body({"fixed"})) == six("000000"));
  CHECK(free_coordinates(body({"heave"})) == six("001000"));
  CHECK(free_coordinates(body({"planar"})) == six("101010"));
  CHECK(free_coordinates(body({"point"})) == six("111000"));
  CHECK(free_coordinates(body({"rigid"})) == six("111111"));
  CHECK(free_coordinates(body({"yaw", "surge"})) == six("100001"));
  CHECK(verdict(body({"plane"})).starts_with("body.buoy.motion: body 'buoy': unknown motion"));
  CHECK(contains(verdict(body({"planar", "sway"})), "'planar' stands alone"));
  CHECK(contains(verdict(body({"sway", "sway"})), "'sway' twice"));
  CHECK(contains(verdict(body({"roll", "pitch"})), "two of roll, pitch and yaw"));
  CHECK(contains(verdict(body({})), "motion is empty"));
}

TEST_CASE("axes that move are the free coordinates closed under rotation") {
  CHECK(moving_axes(body({"heave"})) == six("001000"));
  CHECK(moving_axes(body({"planar"})) == six("101010"));
  CHECK(moving_axes(body({"heave", "pitch"})) == six("101010"));
  CHECK(moving_axes(body({"sway", "pitch"})) == six("010010"));
  CHECK(moving_axes(body({"heave", "roll"})) == six("011100"));
  CHECK(moving_axes(body({"sway", "yaw"})) == six("110001"));
  CHECK(moving_axes(body({"heave", "roll", "pitch", "yaw"})) == six("111111"));
  CHECK(moving_axes(body({"roll", "pitch", "yaw"})) == six("000111"));
  Body turned = body({"heave"});
  turned.initial.rotation = Vector3(0, 0.1, 0);
  CHECK(moving_axes(turned) == six("111000"));
}

TEST_CASE("a memory that is not passive is refused unless forced") {
  Wet wet;
  for (hydro::MemoryFit& f : wet.database->fits)
    f.passive = false;
  CHECK(contains(verdict(wet.scene), "the memory fit is not passive"));
  wet.scene.solver.force = true;
  CHECK(verdict(wet.scene) == "");
}

TEST_CASE("masses and inertias are physical") {
  CHECK(verdict(body({"rigid"})) == "");
  Body b = body({"point"});
  b.inertia = Vector3::Zero();
  CHECK(verdict(b) == "");
  b.mass = 0.0;
  CHECK(verdict(b) == ""); // constraints may hold it
  b = body({"planar"});
  b.inertia = Vector3(0, 1, 0);
  CHECK(verdict(b) == "");
  b.inertia = Vector3(1, -1, 1);
  CHECK(contains(verdict(b), "Iyy must be >= 0 kg m2, because the body is free in pitch"));
  b = body({"rigid"});
  b.inertia = Vector3(1, 1, 2.1);
  CHECK(contains(verdict(b), "exceeds the sum of the other two"));
  b.inertia = Vector3(1, 1, 2); // a flat plate: the limit
  CHECK(verdict(b) == "");
  b.inertia = Vector3(1, 1, 1);
  b.products_of_inertia = Vector3(1.5, 0, 0); // eigenvalues 1 +- 1.5, 1
  CHECK(contains(verdict(b), "a moment is negative"));
}

TEST_CASE("locked coordinates have no velocity") {
  Body b = body({"planar"});
  b.initial.velocity = Vector3(1, 0, 1);
  b.initial.displacement = Vector3(0, 1, 0); // for ever there
  CHECK(verdict(b) == "");
  b.initial.velocity = Vector3(0, 1, 0);
  CHECK(verdict(b).starts_with("body.buoy.initial.velocity: body 'buoy': initial velocity along "
                               "sway, which is locked"));
  b = body({"planar"});
  b.initial.angular_velocity = Vector3(0, 0, 1);
  CHECK(contains(verdict(b), "initial angular velocity along yaw"));
  b = body({"planar"});
  b.initial.rotation = Vector3(0.1, 0, 0);
  CHECK(contains(verdict(b), "initial rotation along roll"));
  b = body({"heave"});
  b.initial.rotation = Vector3(0.1, 0, 0);
  CHECK(verdict(b) == "");
}

TEST_CASE("names") {
  Scene scene;
  scene.bodies = {body({"heave"}), body({"heave"})};
  CHECK(verdict(scene) == "body.buoy.name: two body entries have the name 'buoy'");
  scene.bodies[1].name = "ground";
  CHECK(verdict(scene) == "body.ground.name: 'ground' is the name of the fixed world");
  scene.bodies[1].name = "a/b";
  CHECK(contains(verdict(scene), "may hold letters, digits, _ and - only"));
  scene.bodies[1].name = "";
  CHECK(contains(verdict(scene), "may hold letters"));
  scene.bodies.clear();
  CHECK(verdict(scene) == "body: the case has no [[body]]");
}

TEST_CASE("joints") {
  const auto verdict_of = [](auto change) {
    Scene scene;
    scene.bodies = {body({"rigid"})};
    Joint joint;
    joint.name = "j";
    joint.type = "revolute";
    joint.body_a = "ground";
    joint.body_b = "buoy";
    joint.axis = Vector3(0, 1, 0);
    change(joint);
    scene.joints = {joint};
    return verdict(scene);
  };
  CHECK(verdict_of([](Joint&) {}) == "");
  CHECK(contains(verdict_of([](Joint& j) { j.type = "hinge"; }), "unknown type 'hinge'"));
  CHECK(contains(verdict_of([](Joint& j) { j.body_a = "boy"; }), "did you mean 'buoy'?"));
  CHECK(verdict_of([](Joint& j) { j.body_a = "buoy"; }) ==
        "joint.j.body_b: joint 'j': joins 'buoy' with itself");
  CHECK(contains(verdict_of([](Joint& j) { j.axis.reset(); }), "needs the key 'axis'"));
  CHECK(contains(verdict_of([](Joint& j) { j.axis = Vector3::Zero(); }), "no length"));
  CHECK(
      contains(verdict_of([](Joint& j) { j.axis_x = Vector3(0, -2, 0); }), "other than the axis"));
  CHECK(verdict_of([](Joint& j) { j.axis_x = Vector3(1, 1, 0); }) == "");
  CHECK(verdict_of([](Joint& j) { j.type = "fixed"; }) == "");
}

TEST_CASE("the database covers the scene") {
  CHECK(verdict(Wet().scene) == "");
  {
    Wet w;
    w.scene.environment.gravity = 9.80665;
    CHECK(verdict(w.scene).starts_with("environment.gravity: gravity is 9.80665 m/s2, but"));
  }
  {
    Wet w; // which states no gravity
    w.database->gravity = 9.80665;
    CHECK(verdict(w.scene) == "");
    CHECK(model::water(w.scene).gravity == 9.80665);
    w.scene.database.reset();
    CHECK(model::water(w.scene).gravity == 9.81);
  }
  {
    Wet w;
    w.buoy().hydro = "flaot";
    CHECK(verdict(w.scene).starts_with("body.buoy.hydro: "));
    CHECK(contains(verdict(w.scene), "did you mean 'float'?"));
  }
  {
    Wet w;
    w.buoy().center_of_gravity = Vector3(0, 0, -1.00001);
    CHECK(contains(verdict(w.scene),
                   "the database is about the point [0, 0, -1] m, but the center_of_gravity is "
                   "[0, 0, -1.00001] m; make the database for it with: hydrodae hdb import ... "
                   "--cog float=0,0,-1.00001"));
  }
  {
    Wet w;
    w.database->bodies[0].hydrostatics.reset();
    CHECK(contains(verdict(w.scene), "holds no hydrostatics of 'float'"));
  }
  {
    Wet w;
    w.scene.hydro.reset();
    CHECK(contains(verdict(w.scene), "needs a table [hydro]"));
  }
  {
    Wet w;
    w.database->coordinates.erase(w.database->coordinates.begin());
    CHECK(verdict(w.scene) == "hydro.database: hydro.h5 lacks coordinates that move: float.surge");
  }
  {
    Wet w;
    w.buoy().hydro.reset();
    CHECK(contains(verdict(w.scene), "no [[body]] has the key 'hydro'"));
  }
  {
    Wet w;
    w.scene.bodies.push_back(w.buoy());
    w.scene.bodies[1].name = "second";
    CHECK(contains(verdict(w.scene), "already belongs to another body"));
  }
}

TEST_CASE("the memory fit with the fewest states that covers what moves") {
  Wet w;
  CHECK(model::memory_fit(w.scene)->name == "small");
  w.buoy().motion = {"heave"};
  CHECK(model::memory_fit(w.scene)->name == "heave");
  w.scene.hydro->fit = "large";
  CHECK(model::memory_fit(w.scene)->name == "large");
  w.scene.hydro->radiation = "none";
  CHECK(model::memory_fit(w.scene) == nullptr);

  w.scene.hydro->radiation = "exponential";
  w.scene.hydro->fit = "heav";
  CHECK(contains(verdict(w.scene), "hydro.fit: no exponential fit 'heav' in hydro.h5; did you mean "
                                   "'heave'?"));
  w.scene.hydro->fit = "heave";
  w.buoy().motion = {"planar"};
  CHECK(contains(verdict(w.scene),
                 "does not cover coordinates that move: float.surge, float.pitch; "
                 "make one with: hydrodae hdb fit"));
  w.scene.hydro->fit.reset();
  w.buoy().motion = {"rigid"};
  CHECK(contains(verdict(w.scene),
                 "'heave' lacks float.surge, float.sway, float.roll, float.pitch, "
                 "float.yaw"));
  w.database->fits.clear();
  CHECK(contains(verdict(w.scene), "hydro.database: hydro.h5 holds no exponential fit"));
}

TEST_CASE("a summary shows what is in the scene") {
  const std::string text = model::summary(Wet().scene);
  CHECK(contains(text, "buoy: planar, 2 kg, hydro 'float'"));
  CHECK(contains(text, "6 coordinates, 3 move, mean axes"));
  CHECK(contains(text, "fit 'small' with 4 states for 3 coordinates, passive"));
}

TEST_CASE("model errors are located by the longest key that is known") {
  Scene scene;
  scene.path = "case.toml";
  scene.places = {{"joint.j", {"case.toml", 7, 1}}, {"joint.j.axis", {"case.toml", 9, 1}}};
  const CaseError axis = located(scene, ModelError("joint.j.axis", "x"));
  CHECK(std::string(axis.what()) == "case.toml:9:1: x");
  CHECK(axis.key == "joint.j.axis");
  CHECK(axis.place.line == 9);
  CHECK(axis.fault == "x");
  CHECK(located(scene, ModelError("joint.j.initial.angle_deg", "x")).place.line == 7);
  CHECK(std::string(located(scene, ModelError("body.b", "x")).what()) == "case.toml: x");
}
