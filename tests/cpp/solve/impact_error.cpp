/// What an impact makes of an error: a ball that falls on a floor, in closed form.

#include "hydrodae/solve/impact_error.h"

#include "../support.h"
#include "hydrodae/system/system.h"

namespace {

using namespace hydrodae;

const char* const ball = R"(
[solver]
end_time = 1.0
[[body]]
name = "ball"
motion = "heave"
mass = 2.0
center_of_gravity = [0.0, 0.0, 1.0]
[[joint]]
name = "rail"
type = "prismatic"
body_a = "ground"
body_b = "ball"
point = [0.0, 0.0, 1.0]
axis = [0.0, 0.0, 1.0]
[[constraint]]
name = "floor"
type = "stop"
joint = "rail"
lower = -1.0
restitution = 0.6
)";

} // namespace

TEST_CASE("an error goes over an impact as that of a ball that falls") {
  const double g = 9.81, e = 0.6;
  for (const double speed : {3.0, 0.2, 1e-3}) {
    CAPTURE(speed);
    const model::Scene scene = io::parse_case(ball, "");
    const system::System built = system::build(scene);
    system::Regime s(built);
    const Index q0 = s.bodies.front().q0;
    solve::Switching switching(s, 1e-14);
    VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
    y[q0] -= 1.0;
    y[s.u0] = yp[q0] = -speed;
    yp[s.u0] = -g;
    const VectorX y0 = y, yp0 = yp;
    REQUIRE(switching.settle(0.5, y, yp).has_value());
    REQUIRE(switching.hit().has_value());
    REQUIRE(y[s.u0] == doctest::Approx(e * speed));
    const solve::ImpactError impact(s, switching, *switching.hit(), 0.5, y0, yp0, y, yp);
    const VectorX unit = VectorX::Ones(s.lambda0);
    for (const auto& [height, rate] :
         {std::pair{1e-9, 0.0}, std::pair{0.0, 1e-9}, std::pair{-2e-9, 3e-9}}) {
      VectorX error = VectorX::Zero(s.lambda0);
      error[q0] = height;
      error[s.u0] = rate;
      impact(error, unit);
      CHECK(error[q0] == doctest::Approx(-e * height).epsilon(1e-6));
      CHECK(error[s.u0] ==
            doctest::Approx(-e * rate + (1.0 + e) * g * height / speed).epsilon(1e-6));
    }
  }
}

TEST_CASE("an error that is larger than the impact is followed no further than a fall through it") {
  const double g = 9.81, e = 0.6, speed = 1e-3, height = 1e-2;
  const model::Scene scene = io::parse_case(ball, "");
  const system::System built = system::build(scene);
  system::Regime s(built);
  const Index q0 = s.bodies.front().q0;
  solve::Switching switching(s, 1e-14);
  VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  y[q0] -= 1.0;
  y[s.u0] = yp[q0] = -speed;
  yp[s.u0] = -g;
  const VectorX y0 = y, yp0 = yp;
  REQUIRE(switching.settle(0.5, y, yp).has_value());
  const solve::ImpactError impact(s, switching, *switching.hit(), 0.5, y0, yp0, y, yp);
  VectorX error = VectorX::Zero(s.lambda0);
  error[q0] = height;
  impact(error, VectorX::Ones(s.lambda0));
  CHECK(std::abs(error[s.u0]) < 2.0 * (1.0 + e) * std::sqrt(2.0 * g * height));
  CHECK(std::abs(error[s.u0]) > 0.5 * std::sqrt(2.0 * g * height));
}
