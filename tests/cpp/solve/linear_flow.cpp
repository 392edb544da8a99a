/// Small changes of a sprung mass, carried along by the linearised equations, in closed form.

#include "hydrodae/solve/linear_flow.h"
#include "hydrodae/solve/saddle_point.h"

#include <cmath>

#include "../support.h"
#include "hydrodae/system/system.h"

namespace {

using namespace hydrodae;

const char* const mass = R"(
[solver]
end_time = 1.0
[[body]]
name = "mass"
motion = "surge"
mass = 2.0
center_of_gravity = [0.0, 0.0, 0.0]
[[joint]]
name = "rail"
type = "prismatic"
body_a = "ground"
body_b = "mass"
point = [0.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[force]]
name = "spring"
type = "pto_linear"
joint = "rail"
stiffness = 18.0
)";

} // namespace

TEST_CASE("a change of a sprung mass swings as it does") {
  const double w = 3.0, end = 2.0;
  const model::Scene scene = io::parse_case(mass, "");
  const system::System built = system::build(scene);
  const system::Regime s(built);
  const Index q0 = s.bodies.front().q0;
  const system::Pattern pattern = system::find_pattern(s);
  const VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  double before = 0.0;
  for (const int substeps : {20, 40, 80}) {
    CAPTURE(substeps);
    solve::LinearFlow flow(s, pattern, 0.0, y, yp);
    REQUIRE(flow.look(end, y, yp, substeps));
    VectorX change = VectorX::Zero(s.lambda0);
    change[q0] = 1e-3;
    for (int i = 0; i < substeps; ++i)
      REQUIRE(flow.step(change));
    const double off = std::hypot(change[q0] - 1e-3 * std::cos(w * end),
                                  change[s.u0] / w + 1e-3 * std::sin(w * end));
    CHECK(off < 1e-3 * std::pow(w * end / substeps, 2));
    if (before > 0.0) // of second order
      CHECK(before / off == doctest::Approx(4.0).epsilon(0.05));
    before = off;
    VectorX since_last, since_first = VectorX::Zero(s.n_error_groups());
    flow.compare(VectorX::Constant(s.n_error_groups(), w), since_last, since_first);
    CHECK(since_last.maxCoeff() < 1e-12);
    CHECK(flow.effect(change).norm() < 1e-12);
  }
}

namespace {

const char* const pendulum = R"(
[solver]
end_time = 1.0
[[body]]
name = "bob"
motion = "point"
mass = 2.0
center_of_gravity = [0.0, 0.0, -1.0]
[[joint]]
name = "rod"
type = "distance"
body_a = "ground"
body_b = "bob"
point = [0.0, 0.0, 0.0]
point_b = [0.0, 0.0, -1.0]
)";

} // namespace

TEST_CASE("a change of a pendulum that swings far is carried as by its own equation") {
  const model::Scene scene = io::parse_case(pendulum, "");
  const system::System built = system::build(scene);
  const system::Regime s(built);
  const Index q0 = s.bodies.front().q0;
  const system::Pattern pattern = system::find_pattern(s);
  const double g = 9.81, h = 1e-3; // 2.5 s: through the bottom, to the other side and back
  solve::Equations equations(s, pattern, 1.0);
  solve::SaddlePoint saddle(equations);
  double angle = 2.8, rate = 0.0, d = 0.0, v = 1.0; // from below; and a change of them
  VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  const auto pose = [&](double t) {
    y.segment<3>(q0) << std::sin(angle), 0.0, -std::cos(angle);
    y.segment<3>(s.u0) << rate * std::cos(angle), 0.0, rate * std::sin(angle);
    REQUIRE(saddle.accelerations(t, y, yp));
  };
  pose(0.0);
  VectorX change = VectorX::Zero(s.lambda0);
  change.segment<3>(s.u0) << v * std::cos(angle), 0.0, v * std::sin(angle);
  solve::LinearFlow flow(s, pattern, 0.0, y, yp);
  for (int i = 1; i <= 2500; ++i) {
    for (int k = 0; k < 10; ++k) { // leapfrog
      rate -= 0.05 * h * g * std::sin(angle), v -= 0.05 * h * g * std::cos(angle) * d;
      angle += 0.1 * h * rate, d += 0.1 * h * v;
      rate -= 0.05 * h * g * std::sin(angle), v -= 0.05 * h * g * std::cos(angle) * d;
    }
    pose(h * i);
    REQUIRE(flow.look(h * i, y, yp, 1));
    REQUIRE(flow.step(change));
    const double along = change[q0] * std::cos(angle) + change[q0 + 2] * std::sin(angle);
    CHECK(along == doctest::Approx(d).epsilon(1e-3).scale(2.0));
  }
}
