/// Small changes of a sprung mass, carried along by the linearised equations, in closed form.

#include "hydrodae/solve/linear_flow.h"

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
