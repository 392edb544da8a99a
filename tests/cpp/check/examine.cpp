/// What a scene costs, and which coordinates nothing moves.

#include "hydrodae/check/examine.h"
#include "hydrodae/build/build.h"

#include <doctest/doctest.h>

#include "hydrodae/io/case_reader.h"
#include "hydrodae/simulation.h"

namespace {

using namespace hydrodae;

const std::string solver = "\n[solver]\nend_time = 1.0\n";

std::string body(const std::string& name, const std::string& extra) {
  return "[[body]]\nname = '" + name + "'\nmass = 2.0\ninertia = [0.15, 0.2, 0.3]\n" + extra + "\n";
}

std::string joined_by(const std::string& name, const std::string& type, const std::string& a,
                      const std::string& b, const std::string& extra) {
  return "[[joint]]\nname = '" + name + "'\ntype = '" + type + "'\nbody_a = '" + a +
         "'\nbody_b = '" + b + "'\n" + extra + "\n";
}

/// Two bars that swing about y, modelled with rigid bodies.
std::string pendulums(const std::string& extra = "") {
  return body("arm", "center_of_gravity = [0.5, 0, 0]") +
         body("bob", "center_of_gravity = [1.5, 0, -0.3]\n" + extra) +
         joined_by("top", "revolute", "ground", "arm", "point = [0, 0, 0]\naxis = [0, 1, 0]") +
         joined_by("middle", "revolute", "arm", "bob", "point = [1, 0, 0]\naxis = [0, 1, 0]") +
         solver;
}

std::string report(const std::string& text) { return examine(io::parse_case(text, ".")); }

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("costs add up to the whole system") {
  const system::System built = build::build(io::parse_case(pendulums(), "."));
  const system::Regime s(built);
  const system::Pattern pattern = system::find_pattern(s);
  Index unknowns = 0, multipliers = 0, nonzeros = 0;
  for (const check::ElementCost& c : check::element_costs(s, pattern)) {
    unknowns += c.unknowns;
    multipliers += c.multipliers;
    nonzeros += c.nonzeros;
    if (c.name == "joint top")
      CHECK(c.multipliers == 10);
    if (c.name == "body arm")
      CHECK(c.unknowns == 14);
  }
  CHECK(unknowns + multipliers == s.n);
  CHECK(multipliers == s.n_lambda + s.n_mu);
  CHECK(nonzeros == pattern.nonzeros());
}

TEST_CASE("rigid bodies that move in a plane are told, unless something moves them out of it") {
  const std::string plane = report(pendulums());
  CHECK(says(plane, "never excited: sway, roll, yaw of body 'bob'"));
  CHECK(says(plane, "body 'arm' with motion = \"planar\""));
  CHECK(says(plane, "cost of each element"));
  // Products of inertia would throw them out of the plane, but the hinges hold them in it.
  CHECK(says(report(pendulums("products_of_inertia = [0.002, 0.003, 0]")),
             "sway, roll, yaw of body"));
  const std::string ball = body("bob", "center_of_gravity = [1, 0, 0]\ninitial.velocity = "
                                       "[0, 0.3, 0]\ninitial.angular_velocity = [0, 0, 0.3]") +
                           joined_by("top", "spherical", "ground", "bob", "point = [0, 0, 0]") +
                           solver;
  CHECK(says(report(ball), "could be less") == false);
}

TEST_CASE("what hangs on a drive is moved by it, though all is at rest at the start") {
  const std::string slide = body("sled", "center_of_gravity = [0, 0, 0]\nmotion = 'planar'") +
                            "[environment]\ngravity = 0.0\n";
  const std::string drive = "[[constraint]]\nname = 'motor'\ntype = 'coordinate'\nbody = 'sled'\n"
                            "coordinate = 'surge'\ndrive = { amplitude = 1.0, period = 3.0, ramp = "
                            "5.0 }\n";
  CHECK(says(report(slide + solver), "never excited: surge, heave, pitch of body 'sled'"));
  CHECK(says(report(slide + drive + solver), "never excited: heave, pitch of body 'sled'"));
}

TEST_CASE("what a driven body pulls by a spring is moved by it, though slack at the start") {
  const std::string bodies = body("sled", "center_of_gravity = [0, 0, 0]\nmotion = 'surge'") +
                             body("tow", "center_of_gravity = [1, 0, 0]\nmotion = 'surge'") +
                             "[environment]\ngravity = 0.0\n";
  const std::string drive = "[[constraint]]\nname = 'motor'\ntype = 'coordinate'\nbody = 'tow'\n"
                            "coordinate = 'surge'\ndrive = { rate = 0.1 }\n";
  const std::string spring = "[[force]]\nname = 'rope'\ntype = 'spring_damper'\nstiffness = 10.0\n"
                             "body_a = 'tow'\nbody_b = 'sled'\npoint_a = [1, 0, 0]\n"
                             "point_b = [0, 0, 0]\n";
  CHECK(says(report(bodies + drive + solver), "never excited: surge of body 'sled'"));
  CHECK(says(report(bodies + drive + spring + solver), "never excited") == false);
}

TEST_CASE("a joint that a stop needs is not replaced") {
  const std::string rail =
      body("a", "center_of_gravity = [0, 0, 0]") +
      joined_by("rail", "prismatic", "ground", "a", "point = [0,0,0]\naxis = [0,0,1]");
  const std::string stop =
      "[[constraint]]\nname = 'end'\ntype = 'stop'\njoint = 'rail'\nlower = -1.0\n";
  CHECK(says(report(rail + solver), "joint 'rail' as motion"));
  CHECK(says(report(rail + stop + solver), "joint 'rail' as motion") == false);
}

TEST_CASE("joints that an eliminated coordinate replaces are told") {
  const std::string bodies =
      body("a", "center_of_gravity = [0, 0, 0]") + body("b", "center_of_gravity = [0, 0, 1]");
  const std::string text = report(
      bodies + joined_by("rail", "prismatic", "ground", "a", "point = [0,0,0]\naxis = [0,0,1]") +
      joined_by("weld", "fixed", "a", "b", "point = [0,0,0.5]") + solver);
  CHECK(says(text, "joint 'rail' as motion = \"heave\" of body 'a'"));
  CHECK(says(text, "bodies 'a' and 'b', which joint 'weld' fixes to each other, as one body"));
}
