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

constexpr double ball_gravity = 9.81, ball_restitution = 0.6;

/// What an impact of the ball at `speed` makes of an error of its height and rate.
Eigen::Vector2d after_impact(double speed, double height, double rate) {
  const model::Scene scene = io::parse_case(ball, "");
  const system::System built = system::build(scene);
  system::Regime s(built);
  const Index q0 = s.bodies.front().q0;
  solve::Switching switching(s, 1e-14);
  VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  y[q0] -= 1.0;
  y[s.u0] = yp[q0] = -speed;
  yp[s.u0] = -ball_gravity;
  const VectorX y0 = y, yp0 = yp;
  REQUIRE(switching.settle(0.5, y, yp).has_value());
  REQUIRE(switching.hit().has_value());
  REQUIRE(y[s.u0] == doctest::Approx(ball_restitution * speed));
  const solve::ImpactError impact(s, switching, *switching.hit(), 0.5, y0, yp0, y, yp);
  VectorX error = VectorX::Zero(s.lambda0);
  error[q0] = height;
  error[s.u0] = rate;
  impact(error, VectorX::Ones(s.lambda0));
  return {error[q0], error[s.u0]};
}

} // namespace

TEST_CASE("an error goes over an impact as that of a ball that falls") {
  constexpr double g = ball_gravity, e = ball_restitution;
  for (const double speed : {3.0, 0.2, 1e-3}) {
    CAPTURE(speed);
    for (const auto& [height, rate] :
         {std::pair{1e-9, 0.0}, std::pair{0.0, 1e-9}, std::pair{-2e-9, 3e-9}}) {
      const Eigen::Vector2d error = after_impact(speed, height, rate);
      CHECK(error[0] == doctest::Approx(-e * height).epsilon(1e-6));
      CHECK(error[1] == doctest::Approx(-e * rate + (1.0 + e) * g * height / speed).epsilon(1e-6));
    }
  }
}

TEST_CASE("an error that is larger than the impact is followed no further than a fall through it") {
  constexpr double height = 1e-2;
  const double rate = std::abs(after_impact(1e-3, height, 0.0)[1]);
  CHECK(rate < 2.0 * (1.0 + ball_restitution) * std::sqrt(2.0 * ball_gravity * height));
  CHECK(rate > 0.5 * std::sqrt(2.0 * ball_gravity * height));
}
