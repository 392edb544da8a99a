/// Where a motion leaves linear theory.

#include "hydrodae/session/linear_limits.h"

#include <doctest/doctest.h>

#include "hydrodae/math/rotation.h"

namespace {

using namespace hydrodae;
using session::LinearLimits;
using system::BodyState;

LinearLimits one_body() {
  LinearLimits limits;
  limits.tenth_wave = 5.0;
  LinearLimits::Body body;
  body.name = "float";
  body.mean = rotation_about_axis<double>(2, 0.5);
  body.place = Vector3(10.0, 0.0, -2.0);
  body.half_draught = 1.5;
  limits.bodies.push_back(body);
  limits.state.bodies.emplace_back();
  return limits;
}

std::vector<BodyState<double>> state(const Vector3& moved, double yaw, double pitch) {
  BodyState<double> s;
  s.v = s.w = s.v_dot = s.w_dot = Vector3::Zero();
  s.p = Vector4(1.0, 0.0, 0.0, 0.0); // not read
  s.r = Vector3(10.0, 0.0, -2.0) + moved;
  s.R = rotation_about_axis<double>(2, yaw) * rotation_about_axis<double>(1, pitch);
  return {s};
}

constexpr double degree = pi / 180.0;

} // namespace

TEST_CASE("limits count from the mean pose, its yaw and place included") {
  LinearLimits limits = one_body();
  session::watch(limits, 0.0, state(Vector3(4.9, 0.0, 1.4), 0.5, 14.0 * degree));
  CHECK(session::notes(limits).empty());
  session::watch(limits, 2.5, state(Vector3::Zero(), 0.5 + 16.0 * degree, 0.0));
  session::watch(limits, 3.0, state(Vector3::Zero(), 0.5, 40.0 * degree));
  session::watch(limits, 4.0, state(Vector3(0.0, 0.0, -1.6), 0.5, 17.0 * degree));
  session::watch(limits, 5.0, state(Vector3(-3.0, 4.2, 0.0), 0.5, 0.0));
  const std::vector<std::string> notes = session::notes(limits);
  REQUIRE(notes.size() == 3);
  CHECK(notes[0] == "beyond linear theory: body 'float' turns by 16 deg at t = 2.5 s, at most 40 "
                    "deg (limit 15 deg)");
  CHECK(notes[1].find("rises or sinks by 1.6 m at t = 4 s") != std::string::npos);
  CHECK(notes[2].find("off its place in the waves by 5.2 m at t = 5 s") != std::string::npos);
}

TEST_CASE("where the hydrodynamics follow the yaw, tilt alone counts") {
  LinearLimits limits = one_body();
  limits.bodies[0].free_yaw = true;
  session::watch(limits, 0.0, state(Vector3::Zero(), 2.0, 14.0 * degree));
  CHECK(session::notes(limits).empty());
  session::watch(limits, 1.0, state(Vector3::Zero(), 2.0, 16.0 * degree));
  CHECK(session::notes(limits).size() == 1);
}
