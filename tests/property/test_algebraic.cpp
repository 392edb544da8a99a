/// A law with an algebraic unknown: two springs in series, whose joint has no mass. In the
/// Jacobian, in the linear model, at rest, and by every method.

#include <doctest/doctest.h>

#include "hydrodae/build/build.h"
#include "hydrodae/element/laws.h"
#include "hydrodae/integrate/integrator.h"
#include "hydrodae/math/dual.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/residual.h"
#include "scenes.h"

namespace {

using namespace hydrodae;
using system::Regime;
using system::System;

/// f = -k1 e - d w,   0 = k1 e - k2 (s - e) - c (s - e)^3,   w' = s' - w
struct SeriesSprings {
  static constexpr std::string_view type = "series_springs";
  static constexpr element::Port port = element::Port::along_joint;
  static constexpr int n_states = 2, n_algebraic = 1;
  std::string name = "springs";
  double first = 300.0, second = 200.0, hardening = 0.0, damping = 0.0;

  const SeriesSprings& law() const { return *this; }
  std::array<element::Unknown, n_states> unknowns() const {
    return {{{"slip", "m/s", 1.0}, {"elongation", "m", 0.01}}};
  }
  template <class S> void operator()(const element::In<S>& in, const element::Out<S>& out) const {
    const S left = *in.x - in.z[1];
    *out.load = S(-first) * in.z[1] - S(damping) * in.z[0];
    out.z_dot[0] = *in.v - in.z[0];
    out.z_dot[1] = S(first) * in.z[1] - S(second) * left - S(hardening) * left * left * left;
  }
  double stiffness() const { return first * second / (first + second); }
};

/// A weight of 2 kg that slides up and down, on a spring.
model::Scene weight(double stiffness) {
  model::Scene scene;
  model::Body body;
  body.name = "weight";
  body.mass = 2.0;
  body.inertia = Vector3(1.0, 1.0, 1.0);
  scene.bodies.push_back(body);
  model::Joint slide;
  slide.name = "slide";
  slide.type = "prismatic";
  slide.body_a = "ground";
  slide.body_b = "weight";
  slide.axis = Vector3::UnitZ();
  slide.point = Vector3::Zero();
  scene.joints.push_back(slide);
  element::PtoLinear spring;
  spring.name = "spring";
  spring.joint = "slide";
  spring.stiffness = stiffness;
  std::get<std::vector<element::PtoLinear>>(scene.forces->lists) = {spring};
  scene.solver.end_time = 1.0;
  scene.output.step = 0.1;
  return scene;
}

/// The same on two springs.
System on_series(const SeriesSprings& springs) {
  System s = build::build(weight(0.0));
  system::ElementList list;
  list.laws = std::make_shared<const element::Laws<SeriesSprings>>(std::vector{springs});
  list.ports = s.elements.front().ports;
  s.elements.push_back(list);
  system::number(s);
  return s;
}

/// y at the end of a second, and at 0.5 s.
std::array<VectorX, 2> run(const Regime& s, const std::string& method) {
  SolverOptions options;
  options.method = method;
  options.rtol = 1e-8;
  options.end_time = 1.0;
  if (method == "gauss" || method == "lobatto_iiic" || method == "generalized_alpha")
    options.step = 1e-3;
  VectorX y = system::initial_state(s), yp;
  const system::Pattern pattern = system::find_pattern(s);
  statics::consistent_start(s, pattern, y, yp);
  const auto integrator = integrate::make_integrator(s, pattern, options, 0.0, y, yp);
  std::array<VectorX, 2> out{y, y};
  for (double t = 0.0, before = 0.0; t < 1.0; before = t) {
    t = integrator->step(1.0, 1.0);
    if (before < 0.5 && t >= 0.5)
      integrator->interpolate(0.5, out[0], yp);
  }
  integrator->interpolate(1.0, out[1], yp);
  return out;
}

} // namespace

TEST_CASE("the Jacobian holds the row of an algebraic unknown") {
  SeriesSprings springs;
  springs.hardening = 50.0;
  springs.damping = 7.0;
  const System built = on_series(springs);
  const Regime s(built);
  const Index e = s.z0 + 1;
  CHECK(s.is_algebraic(e));
  CHECK_FALSE(s.is_algebraic(s.z0));
  CHECK(s.names[e] == "forces/springs elongation");
  test::Random random;
  const system::Pattern pattern = system::find_pattern(s);
  const VectorX y = test::random_state(s, random), yp = test::random_state(s, random);
  system::JacobianWorkspace ws(s);
  system::JacobianParts parts(pattern);
  system::jacobian(s, pattern, ws, 0.0, y.data(), yp.data(), parts);
  for (const bool rates : {false, true})
    for (Index c = 0; c < s.n; ++c) {
      VecX<Dual> dy = y.cast<Dual>(), dyp = yp.cast<Dual>(), r(s.n);
      (rates ? dyp : dy)[c].b = 1.0;
      system::Workspace<Dual> dual(s);
      system::residual<Dual>(s, dual, 0.0, dy.data(), dyp.data(), r.data());
      const VectorX ours = test::dense(pattern, rates ? parts.by_yp : parts.by_y).col(c);
      for (Index i = 0; i < s.n; ++i)
        CHECK(ours[i] == doctest::Approx(r[i].b).epsilon(1e-12));
    }
}

TEST_CASE("two springs in series are one in the linear model and at rest") {
  const SeriesSprings springs;
  System one = build::build(weight(springs.stiffness())), two = on_series(springs);
  const VectorX rest_one = statics::move_to_equilibrium(one).y,
                rest = statics::move_to_equilibrium(two).y;
  const Regime of_one(one), of_two(two);
  CHECK(rest.head(two.n_q).isApprox(rest_one.head(one.n_q), 1e-10));
  const auto a = statics::linear_matrices(of_one, system::find_pattern(of_one), rest_one),
             b = statics::linear_matrices(of_two, system::find_pattern(of_two), rest);
  CHECK((a.stiffness - b.stiffness).norm() < 1e-9 * a.stiffness.norm());
  CHECK((a.damping - b.damping).norm() < 1e-9);
  CHECK(b.state_by_state.rows() == 1); // the slip
  const element::AtRest law = element::at_rest(*two.elements.back().laws)[0];
  CHECK(law.stiffness(0) == doctest::Approx(springs.stiffness()));
}

TEST_CASE("every method carries an algebraic unknown") {
  const SeriesSprings springs;
  const System one = build::build(weight(springs.stiffness())), two = on_series(springs);
  for (const char* method :
       {"ida", "radau", "gauss", "lobatto_iiic", "generalized_alpha", "explicit_rk"}) {
    CAPTURE(method);
    const auto single = run(Regime(one), method), series = run(Regime(two), method);
    for (std::size_t k = 0; k < 2; ++k) {
      const double size = single[k].head(one.z0).norm();
      CHECK((single[k].head(one.z0) - series[k].head(two.z0)).norm() < 1e-5 * size);
      // s = z of the weight from its reference pose
      double s = 0.0;
      for (Index i = 0; i < 3; ++i)
        s += series[k][two.bodies[0].q0 + i];
      const double share = springs.second / (springs.first + springs.second);
      CHECK(series[k][two.z0 + 1] == doctest::Approx(share * s).epsilon(1e-4));
    }
  }
}
