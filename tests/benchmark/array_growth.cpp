/// hydrodae-array-growth: time and memory against the number of bodies. n bodies that surge,
/// heave and pitch, 10 n memory states, all coupled with all (a made-up passive database).
///
///   .venv/bin/python tests/benchmark/array_growth.py        builds and runs it
///
/// A line for each n: unknowns, nonzeros of the whole Jacobian and of that without memory, seconds
/// to factorise each (the first time, and again), seconds of a run per simulated second, MiB.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include "hydrodae/build/build.h"
#include "hydrodae/linalg/newton_matrix.h"
#include "hydrodae/simulation.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/jacobian.h"

namespace {

using namespace hydrodae;
using Clock = std::chrono::steady_clock;

constexpr double radius = 5.0, spacing = 30.0; ///< [m]
constexpr int states_each = 10;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Most memory that this program has had [MiB] (Linux).
double most_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:"))
      return std::stod(line.substr(6)) / 1024.0;
  return 0.0;
}

/// Memory z' = A z + B U, load B^T z with A + A^T < 0: passive whatever B is.
std::shared_ptr<const hydro::Database> made_up(int n) {
  std::mt19937 random(7);
  const auto draw = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  auto db = std::make_shared<hydro::Database>();
  db->rho = 1025.0;
  const double volume = 2.0 / 3.0 * pi * radius * radius * radius, mass = db->rho * volume;
  const int coordinates = 3 * n;
  for (int i = 0; i < n; ++i) {
    hydro::Hydrostatics h;
    h.displaced_volume = volume;
    h.center_of_buoyancy = Vector3(spacing * i, 0.0, -3.0 / 8.0 * radius);
    h.stiffness(2, 2) = db->rho * db->gravity * pi * radius * radius;
    h.stiffness(4, 4) = 0.2 * radius * mass * db->gravity;
    const std::string name = "b" + std::to_string(i);
    db->bodies.push_back({name, Vector3(spacing * i, 0.0, -0.4 * radius), h, {}, {}});
    for (const char* dof : {"surge", "heave", "pitch"})
      db->coordinates.push_back(name + "." + dof);
  }
  VectorX unit(coordinates);
  for (int c = 0; c < coordinates; ++c)
    unit[c] = c % 3 == 2 ? radius : 1.0;
  hydro::MemoryFit fit;
  fit.name = "made up";
  fit.passive = true;
  fit.inputs = fit.outputs = db->coordinates;
  fit.added_mass_inf = MatrixX::Zero(coordinates, coordinates);
  for (int a = 0; a < coordinates; ++a)
    for (int b = 0; b < coordinates; ++b)
      fit.added_mass_inf(a, b) =
          0.5 * mass * unit[a] * unit[b] * (a == b ? 1.0 : 0.3 / (1.0 + std::abs(a - b)) / n);
  const int pairs = states_each * n / 2;
  fit.poles.resize(pairs);
  fit.input_matrix.resize(pairs, coordinates);
  for (int k = 0; k < pairs; ++k) {
    fit.poles[k] = {-0.3 - 0.2 * std::abs(draw()), 0.6 + 0.5 * std::abs(draw())};
    for (int c = 0; c < coordinates; ++c) {
      const double near = 1.0 / (1.0 + std::abs(k * coordinates / pairs - c) / 3);
      fit.input_matrix(k, c) =
          std::complex<double>(draw(), draw()) * near * unit[c] * std::sqrt(0.05 * mass);
    }
  }
  fit.output_matrix = fit.input_matrix.adjoint();
  fit.states = 2 * pairs;
  db->added_mass_inf = fit.added_mass_inf;
  db->fits.push_back(fit);
  db->omega = Eigen::Vector2d(0.2, 2.0);
  return db;
}

model::Scene array_of(int n) {
  model::Scene scene;
  scene.database = made_up(n);
  scene.hydro = model::HydroOptions{};
  scene.hydro->radiation = "exponential";
  for (int i = 0; i < n; ++i) {
    const hydro::DatabaseBody& wet = scene.database->bodies[static_cast<std::size_t>(i)];
    model::Body body;
    body.name = body.hydro.emplace(wet.name);
    body.motion = {"planar"};
    body.mass = scene.database->rho * wet.hydrostatics->displaced_volume;
    body.center_of_gravity = wet.reference_point;
    body.inertia = Vector3::Constant(0.3 * body.mass.value * radius * radius);
    body.initial.displacement = Vector3(0.0, 0.0, i % 2 == 0 ? 1.0 : -0.5);
    scene.bodies.push_back(body);
  }
  scene.solver.end_time = 20.0;
  scene.output.step = 20.0;
  return scene;
}

/// Seconds of the first factorisation, and of a later one with another alpha.
template <class Factorise> std::array<double, 2> times(Factorise&& factorise) {
  std::array<double, 2> out{};
  double alpha = 40.0;
  for (double& t : out) {
    const auto start = Clock::now();
    if (!factorise(alpha))
      std::exit(1);
    t = seconds_since(start);
    alpha = 25.0;
  }
  return out;
}

} // namespace

int main(int argc, char** argv) {
  const bool compares = argc > 2; // with the whole matrix, too
  const int n = argc > 1 ? std::atoi(argv[1]) : 10;
  const model::Scene scene = array_of(n);
  const system::System built = build::build(scene);
  const system::Regime s(built);
  const system::Pattern whole = system::find_pattern(s), less = linalg::condensed(s, whole);
  const VectorX y = system::initial_state(s), yp = VectorX::Zero(s.n);
  system::JacobianWorkspace ws(s);
  system::JacobianParts parts(less);
  const auto start = Clock::now();
  system::jacobian(s, less, ws, 0.0, y.data(), yp.data(), parts);
  const double jacobian = seconds_since(start);
  linalg::NewtonMatrix<double> newton(s, less);
  const auto own = times([&](double alpha) { return newton.factorise(parts, alpha); });
  std::array<double, 2> sparse{};
  if (compares) {
    system::JacobianParts all(whole);
    system::jacobian(s, whole, ws, 0.0, y.data(), yp.data(), all);
    linalg::SparseLu<double> lu(whole.column_start, whole.row);
    sparse = times([&](double alpha) {
      for (std::size_t k = 0; k < all.by_y.size(); ++k)
        lu.values()[k] = all.by_y[k] + alpha * all.by_yp[k];
      return lu.factorise();
    });
  }
  double run[2] = {0.0, 0.0};
  for (int k = 0; k < 2; ++k) {
    model::Scene timed = scene;
    timed.solver.method = k == 0 ? "ida" : "radau";
    run[k] = simulate(timed, "").solver_time / scene.solver.end_time;
  }
  std::printf("%d %ld %ld %ld %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.1f\n", n, static_cast<long>(s.n),
              static_cast<long>(whole.nonzeros()), static_cast<long>(less.nonzeros()), jacobian,
              sparse[0], sparse[1], own[0], own[1], run[0], run[1], most_memory());
  return 0;
}
