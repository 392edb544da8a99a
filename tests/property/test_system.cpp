/// Purity, momentum and energy of the equations of motion.

#include <doctest/doctest.h>

#include "hydrodae/build/build.h"
#include "hydrodae/measure/observer.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/system/residual.h"
#include "scenes.h"

namespace {

using namespace hydrodae;
using system::Regime;
using system::System;

VectorX evaluate(const Regime& s, system::Workspace<double>& ws, const VectorX& y,
                 const VectorX& yp) {
  VectorX r(s.n);
  system::residual<double>(s, ws, 0.0, y.data(), yp.data(), r.data());
  return r;
}

} // namespace

TEST_CASE("residual and Jacobian are pure: a call leaves no trace in the next") {
  test::Random random;
  for (const test::NamedScene& named : test::all_scenes()) {
    CAPTURE(named.name);
    const System built = build::build(named.scene);
    Regime s(built);
    const auto history = test::random_history(s, random, -0.01);
    const system::Pattern pattern = system::find_pattern(s);
    system::Workspace<double> used(s), fresh(s);
    system::JacobianWorkspace used_j(s), fresh_j(s);
    system::JacobianParts first(pattern), second(pattern);
    const VectorX y = test::random_state(s, random), other = test::random_state(s, random);
    const VectorX yp = test::random_state(s, random);
    evaluate(s, used, other, yp);
    system::jacobian(s, pattern, used_j, 0.0, other.data(), yp.data(), first);
    CHECK(evaluate(s, used, y, yp) == evaluate(s, fresh, y, yp));
    system::jacobian(s, pattern, used_j, 0.0, y.data(), yp.data(), first);
    system::jacobian(s, pattern, fresh_j, 0.0, y.data(), yp.data(), second);
    CHECK(first.by_y == second.by_y);
    CHECK(first.by_yp == second.by_yp);
    if (!history)
      continue;
    // Trials at many other times, and then one that is forgotten and asked again.
    const VectorX before = evaluate(s, used, y, yp);
    VectorX trial(s.n);
    for (int k = 1; k < 60; ++k)
      system::residual<double>(s, used, 0.01 * k, other.data(), yp.data(), trial.data());
    CHECK(evaluate(s, used, y, yp) == before);
  }
}

TEST_CASE("the consistent start satisfies all equations") {
  for (const test::NamedScene& named : test::all_scenes()) {
    CAPTURE(named.name);
    const System built = build::build(named.scene);
    const Regime s(built);
    const system::Pattern pattern = system::find_pattern(s);
    VectorX y = system::initial_state(s), yp;
    REQUIRE_NOTHROW(statics::consistent_start(s, pattern, y, yp));
    system::Workspace<double> ws(s);
    const VectorX r = evaluate(s, ws, y, yp);
    const double size = 1.0 + yp.cwiseAbs().maxCoeff() + y.cwiseAbs().maxCoeff();
    CHECK(r.cwiseAbs().maxCoeff() < 1e-9 * size);
  }
}

TEST_CASE("added mass conserves energy in all axes: power of its load is minus d(U.AU/2)/dt") {
  test::Random random;
  for (const std::string axes : {"body", "mean", "yaw"}) {
    CAPTURE(axes);
    model::Scene scene = test::two_bodies(*joint::find_joint_type("spherical"), {"rigid"}, random);
    test::add_hydro(scene, axes, "none", random);
    scene.joints.clear();
    System built = build::build(scene);
    test::turn_mean_axes(built);
    const Regime s(built);
    // Positions, velocities and accelerations at random; q' as the kinematics demand.
    VectorX y = test::random_state(s, random), yp = test::random_state(s, random);
    for (const system::BodyData& b : s.bodies) {
      y.segment<4>(b.q0 + 3).normalize();
      y[s.sigma(b)] = 0.0;
    }
    system::Workspace<double> ws(s);
    VectorX rest = yp;
    rest.head(s.n_q).setZero();
    yp.head(s.n_q) = -evaluate(s, ws, y, rest).head(s.n_q);
    measure::Observer observer(s);
    auto fluid = [&](double h) { // kinetic energy of the fluid along the motion
      const VectorX moved = y + h * yp;
      return observer.observe(0.0, moved, yp).kinetic_added_mass;
    };
    const double h = 1e-5;
    const double rate = (fluid(h) - fluid(-h)) / (2.0 * h);
    const measure::Observation& o = observer.observe(0.0, y, yp);
    const auto index = std::find(o.components.begin(), o.components.end(), "added_mass_inf");
    const double power = o.powers[index - o.components.begin()];
    CHECK(power == doctest::Approx(-rate).epsilon(1e-7));
  }
}
