/// The past of a body whose motion is given, against closed forms.

#include "hydrodae/system/history.h"
#include "hydrodae/build/build.h"

#include <cmath>

#include "../support.h"
#include "hydrodae/element/pto_linear.h"
#include "hydrodae/hydro/database.h"
#include "hydrodae/math/bspline.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::tests {
namespace {

constexpr double a = 0.4, b = 1.3, w = 0.9; // K = e^(-a t) cos(b t), U = sin(w t)
constexpr double end = 12.0;

/// A body that heaves with the kernel e^(-a t) cos(b t), up to 60 s.
model::Scene heaving() {
  auto db = std::make_shared<hydro::Database>();
  db->rho = 1000.0;
  db->gravity = 9.81;
  db->coordinates = {"buoy.heave"};
  db->bodies.push_back({"buoy", Vector3::Zero(), hydro::Hydrostatics{}, false, {}, {}});
  hydro::RadiationKernel kernel;
  kernel.step = 0.02;
  kernel.inputs = kernel.outputs = db->coordinates;
  kernel.added_mass_inf = MatrixX::Constant(1, 1, 1.0);
  for (int k = 0; k < 3001; ++k) {
    const double t = kernel.step * k;
    kernel.values.push_back(MatrixX::Constant(1, 1, std::exp(-a * t) * std::cos(b * t)));
  }
  db->kernel = kernel;
  model::Scene scene;
  model::Body body;
  body.name = "buoy";
  body.motion = {"heave"};
  body.mass = 1.0;
  body.hydro = "buoy";
  scene.bodies.push_back(body);
  scene.solver.end_time = end;
  scene.hydro = model::HydroOptions{};
  scene.hydro->radiation = "convolution";
  scene.database = db;
  return scene;
}

/// y, y' of the heaving body at t.
void motion(const system::Regime& s, double t, VectorX& y, VectorX& yp) {
  y = system::initial_state(s);
  yp = VectorX::Zero(s.n);
  y[s.u0] = std::sin(w * t);
  yp[s.u0] = w * std::cos(w * t);
}

/// int_0^t K(tau) U(t - tau) dtau, from the impulse response 1 / (p + a - i b).
double exact(double t) {
  using C = std::complex<double>;
  const C p(-a, b), i(0.0, 1.0);
  auto one = [&](C q) { // int_0^t e^(p tau) e^(q (t - tau)) dtau
    return (std::exp(q * t) - std::exp(p * t)) / (q - p);
  };
  auto real_kernel = [&](C q) { // with Re e^(p tau)
    return 0.5 * (one(q) + std::conj(one(std::conj(q))));
  };
  return ((real_kernel(i * w) - real_kernel(-i * w)) / (2.0 * i)).real();
}

double convolution(const system::Regime& s, const system::History& history, double t) {
  const system::Past& past = history.at(t);
  CHECK(past.t == t);
  VectorX y, yp;
  motion(s, t, y, yp);
  return past.memory[0] + past.by_U(0, 0) * y[s.u0] + past.by_U_dot(0, 0) * yp[s.u0];
}

/// Follows the motion in steps of about h, of lengths that vary by a factor of three; what it is
/// inside them is known, or the cubic stands for it.
void follow(const system::Regime& s, double h, bool known, system::History& history) {
  const system::History::Inside inside = [&](double at, VectorX& y, VectorX& yp) {
    motion(s, at, y, yp);
  };
  VectorX y, yp;
  double t = 0.0;
  for (int k = 0; t < end - 1.5 * h; ++k) {
    motion(s, t, y, yp);
    history.append(t, y, yp, known ? inside : nullptr, 7);
    t += h * (1.0 + 0.5 * std::sin(2.3 * k));
  }
}

/// Error at the end, behind steps of which the ends are known.
double error(double h) {
  const system::System built = build::build(heaving());
  const system::Regime s(built);
  system::History history(s);
  follow(s, h, false, history);
  return std::abs(convolution(s, history, end) - exact(end));
}

/// Error at the end of the last step.
double accepted_error(double h, bool known) {
  const system::System built = build::build(heaving());
  const system::Regime s(built);
  system::History history(s);
  follow(s, h, known, history);
  const double t = history.last_time();
  return std::abs(convolution(s, history, t) - exact(t));
}

/// A cart on a slide with a spring of 3 N/m and a damper of 2 N s/m that act late.
model::Scene sliding(double delay) {
  model::Scene scene;
  scene.solver.end_time = 1.0;
  model::Body body;
  body.name = "cart";
  body.motion = {"surge", "sway", "heave"};
  body.mass = 1.0;
  scene.bodies.push_back(body);
  model::Joint slide;
  slide.name = "slide";
  slide.type = "prismatic";
  slide.body_a = "ground";
  slide.body_b = "cart";
  slide.axis = Vector3(1, 0, 0);
  scene.joints.push_back(slide);
  element::PtoLinear pto;
  pto.name = "pto";
  pto.joint = "slide";
  pto.stiffness = 3.0;
  pto.damping = 2.0;
  pto.delay = delay;
  std::get<std::vector<element::PtoLinear>>(scene.forces->lists).push_back(pto);
  return scene;
}

} // namespace

TEST_CASE("a cubic B-spline passes through its samples, and is exact for a square") {
  VectorX f(12);
  for (Eigen::Index k = 0; k < f.size(); ++k)
    f[k] = std::sin(0.3 * static_cast<double>(k)) + 0.1 * static_cast<double>(k);
  const VectorX c = bspline_coefficients(f);
  for (Eigen::Index k = 0; k < f.size(); ++k)
    CHECK((c[k] + 4.0 * c[k + 1] + c[k + 2]) / 6.0 == doctest::Approx(f[k]));
  // Far from the end, where f'' = 0 is asked for, also between the samples.
  VectorX g(40);
  for (Eigen::Index k = 0; k < g.size(); ++k)
    g[k] = 2.0 - 0.5 * static_cast<double>(k * k);
  const VectorX d = bspline_coefficients(g);
  for (const double x : {0.0, 0.4, 1.3, 5.75}) {
    const auto cell = static_cast<Eigen::Index>(x);
    const auto weights = bspline_weights(x - static_cast<double>(cell));
    double value = 0.0;
    for (Eigen::Index k = 0; k < 4; ++k)
      value += weights[static_cast<std::size_t>(k)] * d[cell + k];
    CHECK(value == doctest::Approx(2.0 - 0.5 * x * x));
  }
}

TEST_CASE("the convolution with variable steps converges with order four") {
  const double coarse = error(0.4), middle = error(0.2), fine = error(0.1);
  INFO("errors " << coarse << " " << middle << " " << fine);
  CHECK(coarse < 1e-3);
  CHECK(std::log2(coarse / middle) > 3.7);
  CHECK(std::log2(middle / fine) > 3.7);
  CHECK(error(0.025) < 1e-7);
}

TEST_CASE("of steps that are known inside the convolution is as exact as they are") {
  CHECK(accepted_error(0.4, false) > 1e-5);
  CHECK(accepted_error(0.4, true) < 1e-7); // of the quadrature
}

TEST_CASE("the next step is as long as the cubic at its end may be, by the last one") {
  const system::System built = build::build(heaving());
  const system::Regime s(built);
  SolverOptions options;
  std::array<double, 2> longest{};
  for (std::size_t k = 0; k < 2; ++k) {
    options.rtol = k == 0 ? 1e-6 : 1e-12;
    system::History history(s, options);
    VectorX y, yp;
    for (const double t : {pi / 2.0 / w - 0.2, pi / 2.0 / w + 0.2}) { // about the crest of U
      motion(s, t, y, yp);
      history.append(
          t, y, yp, [&](double at, VectorX& q, VectorX& rate) { motion(s, at, q, rate); }, 7);
    }
    longest[k] = history.longest_step();
  }
  // Kernel 1, added mass 1: 8/15 h^2 (w h)^4 / 384 = rtol, and a tenth less.
  const double expected = 0.9 * std::pow(384e-6 * 15.0 / 8.0 / std::pow(w, 4), 1.0 / 6.0);
  CHECK(longest[0] == doctest::Approx(expected).epsilon(0.05));
  CHECK(longest[0] / longest[1] == doctest::Approx(10.0));
}

TEST_CASE("kinks are passed on by every delay, a derivative higher each time") {
  system::Kinks kinks({0.5, 0.8}, 1.0, 0.45, 1e-9);
  kinks.add(0.0, 1);
  CHECK(kinks.next(8) == 0.5);
  CHECK(kinks.next(0) == INFINITY); // its order is too low to see a jump of the acceleration
  CHECK(kinks.pass(0.3) == system::Kinks::none);
  CHECK(kinks.pass(0.5) == 2);
  CHECK(kinks.next(8) == 0.8);
  CHECK(kinks.pass(0.8) == 2);
  CHECK(kinks.next(8) == 1.0);
  CHECK(kinks.next(1) == INFINITY);
  CHECK(kinks.pass(1.0) == 3);
  CHECK(kinks.next(8) == doctest::Approx(1.3)); // by both delays in either order: one instant
  CHECK(kinks.pass(1.3) == 3);
  CHECK(kinks.next(8) == 1.5);
}

TEST_CASE("of short delays the kinks do not matter") {
  system::Kinks kinks({0.01}, 1.0, 0.009, 1e-6);
  kinks.add(0.0, 2);
  CHECK(kinks.next(8) == INFINITY);
}

TEST_CASE("a delayed rate that jumps is what it was before, and from an accepted point on what it "
          "is") {
  const system::System built = build::build(sliding(0.5));
  const system::Regime s(built);
  SolverOptions options;
  options.max_step = 0.45;
  system::History history(s, options);
  VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  y[s.u0] = 0.6; // before the start it rests
  const auto go = [&](double t) {
    y[0] = 0.6 * t;
    history.append(t, y, yp);
  };
  go(0.0);
  go(0.4);
  CHECK(history.next_kink(8) == 0.5);
  CHECK(history.at(0.5).delayed[0][1] == 0.0);
  go(0.5);
  CHECK(history.jumps());
  CHECK(history.at(0.5).delayed[0][1] == doctest::Approx(0.6));
  CHECK(history.at(0.51).delayed[0][1] == doctest::Approx(0.6));
}

TEST_CASE("inside and at the ends of steps the convolution is the same before and after they are "
          "accepted") {
  const system::System built = build::build(heaving());
  const system::Regime s(built);
  system::History history(s);
  VectorX y, yp;
  for (const double t : {0.0, 0.3, 0.5, 0.9}) {
    motion(s, t, y, yp);
    history.append(t, y, yp);
  }
  const double inside = convolution(s, history, 1.1), at_end = convolution(s, history, 1.2);
  motion(s, 1.2, y, yp);
  history.append(1.2, y, yp);
  CHECK(convolution(s, history, 1.1) == inside);
  CHECK(convolution(s, history, 1.2) == doctest::Approx(at_end).epsilon(1e-13));
}

TEST_CASE("a jump of the velocity counts from its time on") {
  const system::System built = build::build(heaving());
  const system::Regime s(built);
  system::History history(s);
  VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  history.append(0.0, y, yp); // at rest until 2 s, then U = 1
  history.append(2.0, y, yp);
  y[s.u0] = 1.0;
  history.append(2.0, y, yp);
  const system::Past& past = history.at(3.0);
  using C = std::complex<double>;
  const double whole = ((std::exp(C(-a, b)) - 1.0) / C(-a, b)).real(); // int_0^1 K
  CHECK(past.memory[0] + past.by_U(0, 0) == doctest::Approx(whole).epsilon(1e-6));
}

TEST_CASE("a long history forgets what is older than the memory") {
  model::Scene scene = heaving();
  scene.hydro->memory_length = 10.0;
  const system::System built = build::build(scene);
  const system::Regime s(built);
  CHECK(s.hydro.as<water::Convolution>().length == doctest::Approx(10.0));
  system::History all(s), late(s);
  VectorX y, yp;
  for (int k = 0; k <= 4000; ++k) {
    const double t = 0.02 * k;
    motion(s, t, y, yp);
    all.append(t, y, yp);
    if (t > 69.0)
      late.append(t, y, yp);
  }
  CHECK(convolution(s, all, 80.01) == doctest::Approx(convolution(s, late, 80.01)).epsilon(1e-12));
}

TEST_CASE("the residual feels a delayed coordinate as it was") {
  const model::Scene scene = sliding(0.5);
  const system::System built = build::build(scene);
  system::Regime s(built);
  system::History history(s);
  auto x = [](double t) { return 0.3 + 0.2 * t * t * t; }; // what the polynomials hold exactly
  VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  for (const double t : {0.0, 0.4, 0.7, 1.0, 1.3}) {
    y[0] = x(t);
    y[s.u0] = yp[0] = 0.6 * t * t;
    yp[s.u0] = 1.2 * t;
    history.append(t, y, yp);
  }
  s.history = &history;
  system::Workspace<double> ws(s);
  VectorX r(s.n);
  for (const double t : {1.31, 1.5, 1.79, 0.4}) {
    CAPTURE(t);
    system::residual<double>(s, ws, t, y.data(), yp.data(), r.data());
    const double then = t - 0.5;
    const double force = then < 0.0 ? -3.0 * 0.3 : -3.0 * x(then) - 2.0 * 0.6 * then * then;
    CHECK(r[s.u0] == doctest::Approx(1.2 * 1.3 - force));
  }
}

TEST_CASE("steps are limited to the delay and to what the history carries") {
  system::System s = build::build(heaving());
  SolverOptions options;
  options.end_time = 100.0;
  options.rtol = 1e-6;
  CHECK(contains(system::limit_steps(s, options), "steps are at most"));
  CHECK(options.max_step * s.hydro.as<water::Convolution>().frequency == doctest::Approx(0.9));
  s.delays.push_back({0, 0.05});
  CHECK(contains(system::limit_steps(s, options), "the shortest delay"));
  CHECK(options.max_step == doctest::Approx(0.045));
  options.max_step = 0.0;
  options.step = 0.06;
  CHECK(contains(message_of([&] { system::limit_steps(s, options); }),
                 "step = 0.06 s is longer than 0.05 s, the shortest delay"));
}

} // namespace hydrodae::tests
