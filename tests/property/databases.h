#pragma once
/// Hydrodynamic databases of two bodies, with random numbers in them.

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "hydrodae/hydro/database.h"

namespace hydrodae::test {

/// Reproducible numbers in (-1, 1).
struct Random {
  std::mt19937 engine{12345};
  double operator()() { return 2.0 * (engine() / 4294967296.0) - 1.0; }
  Vector3 vector() { return {(*this)(), (*this)(), (*this)()}; }
};

inline const std::vector<std::string> dofs = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

/// A database of two bodies with coupled added mass, hydrostatics and a memory of real and complex
/// poles with dense complex input and output matrices; the first body may have modes.
inline std::shared_ptr<const hydro::Database>
random_database(Random& random, const std::vector<std::string>& modes = {}) {
  auto db = std::make_shared<hydro::Database>();
  db->rho = 1025.0;
  db->gravity = 9.81;
  const std::vector<Vector3> points = {{0.0, 0.0, 0.0}, {2.0, 0.5, -1.0}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = i == 0 ? "a" : "b";
    hydro::Hydrostatics h;
    h.displaced_volume = 0.01 + 0.003 * random();
    h.center_of_buoyancy = points[i] + 0.1 * random.vector();
    for (int k = 0; k < 36; ++k)
      h.stiffness(k) = 10.0 * random();
    db->bodies.push_back({name, points[i], h, false, {}, {}});
    for (const std::string& dof : dofs)
      db->coordinates.push_back(name + "." + dof);
  }
  const Index rigid = 12, n = rigid + std::ssize(modes);
  MatrixX root(n, n);
  for (int k = 0; k < n * n; ++k)
    root(k) = random();
  if (hydro::DatabaseBody& a = db->bodies.front(); !modes.empty()) {
    a.modes = modes;
    a.mode_stiffness = MatrixX::NullaryExpr(n - 6, n - 6, [&] { return 10.0 * random(); });
    a.mode_stiffness.topLeftCorner<6, 6>() = a.hydrostatics->stiffness;
    for (const std::string& mode : modes)
      db->coordinates.push_back("a." + mode);
  }
  db->added_mass_inf = root * root.transpose();
  hydro::MemoryFit fit;
  fit.name = "random";
  fit.inputs = fit.outputs = db->coordinates;
  fit.poles.resize(3);
  fit.poles << -0.7, std::complex<double>(-0.3, 1.1), std::complex<double>(-0.2, 2.0);
  fit.input_matrix.resize(3, n);
  fit.output_matrix.resize(n, 3);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < n; ++c) {
      const bool pair = fit.poles[k].imag() != 0.0;
      fit.input_matrix(k, c) = {random(), pair ? random() : 0.0};
      fit.output_matrix(c, k) = {random(), pair ? random() : 0.0};
    }
  fit.added_mass_inf = db->added_mass_inf;
  fit.states = 5;
  db->fits.push_back(fit);
  hydro::RadiationKernel kernel;
  kernel.step = 0.05;
  kernel.inputs = kernel.outputs = db->coordinates;
  kernel.added_mass_inf = db->added_mass_inf;
  for (int k = 0; k < 40; ++k) {
    const double t = kernel.step * k;
    kernel.values.emplace_back(
        fit.output_matrix.real() *
        Eigen::Vector3d(std::exp(-t), std::exp(-t) * std::cos(2.0 * t), std::cos(t)).asDiagonal() *
        fit.input_matrix.real());
  }
  db->kernel = kernel;
  db->water_depth = 20.0;
  db->omega = Vector3(0.5, 1.0, 2.0);
  db->heading = Eigen::Vector2d(-0.5, 0.5);
  for (int h = 0; h < 2; ++h)
    db->excitation.emplace_back(10.0 * Eigen::MatrixXcd::Random(3, n));
  for (int w = 0; w < 3; ++w) {
    db->added_mass.push_back((1.0 + 0.1 * w) * db->added_mass_inf);
    db->damping.push_back(0.2 * (1.0 + w) * db->added_mass_inf);
  }
  return db;
}

/// The same with headings all round.
inline std::shared_ptr<const hydro::Database> all_round(const hydro::Database& given) {
  auto db = std::make_shared<hydro::Database>(given);
  db->heading = VectorX::LinSpaced(6, 0.0, 2.0 * pi);
  db->excitation.clear();
  const Index n = std::ssize(db->coordinates);
  for (int h = 0; h < 5; ++h)
    db->excitation.emplace_back(10.0 * Eigen::MatrixXcd::Random(3, n));
  db->excitation.push_back(db->excitation.front());
  return db;
}

/// Another database whose added mass, and its blends, are positive.
inline std::shared_ptr<const hydro::Database> near(const hydro::Database& first, Random& random) {
  auto db = std::make_shared<hydro::Database>(*random_database(random));
  const auto mix = [&](MatrixX& own, const MatrixX& other) { own = other + 0.05 * own; };
  mix(db->added_mass_inf, first.added_mass_inf);
  mix(db->fits[0].added_mass_inf, first.fits[0].added_mass_inf);
  for (std::size_t w = 0; w < db->added_mass.size(); ++w)
    mix(db->added_mass[w], first.added_mass[w]);
  return db;
}

} // namespace hydrodae::test
