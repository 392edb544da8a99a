/// What is known ahead of the loads that follow the time.

#include "hydrodae/system/forcing.h"
#include "hydrodae/build/build.h"

#include <doctest/doctest.h>

#include "support.h"

using namespace hydrodae;
using namespace hydrodae::tests;

TEST_CASE("a line in waves that hangs between fixed points gives no body a motion") {
  const model::Scene scene = read(R"(
[environment]
water_density = 1025.0
water_depth = 50.0
[[wave]]
name = "w"
type = "regular"
height = 1.0
period = 8.0
[[body]]
name = "idle"
motion = ["surge"]
mass = 1.0
center_of_gravity = [0.0, 10.0, 0.0]
[[force]]
type = "line"
name = "line"
point_a = [-20.0, 0.0, -40.0]
point_b = [0.0, 0.0, -5.0]
length = [45.0]
segments = [8]
mass = [20.0]
diameter = [0.1]
stiffness = [1e7]
drag = [1.0]
[solver]
end_time = 10.0
)");
  const system::System built = build::build(scene);
  const system::Regime regime(built);
  system::Forcing forcing(regime, 10.0, 0.1);
  CHECK(forcing.motion().cwiseAbs().maxCoeff() == 0.0);
}
