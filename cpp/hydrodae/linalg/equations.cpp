#include "hydrodae/linalg/equations.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/algebraic.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/system/trouble.h"

namespace hydrodae::linalg {

std::string worst(const VectorX& values, const std::vector<std::string>& names) {
  std::vector<Index> order(names.size());
  std::iota(order.begin(), order.end(), Index{0});
  const std::size_t count = std::min<std::size_t>(3, order.size());
  auto size = [&](Index i) { return std::isfinite(values[i]) ? std::abs(values[i]) : HUGE_VAL; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](Index a, Index b) { return size(a) > size(b); });
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < count; ++k)
    parts.push_back(names[order[k]] + " (" + number_text(values[order[k]]) + ")");
  return joined(parts);
}

void ProgressGuard::fail(double t, double gained, const std::string& diagnosis) {
  throw SolverError(t, {Reason::progress,
                        "no progress, " + std::to_string(watch) + " steps brought only " +
                            number_text(gained) + " s (a singular pose?)",
                        "",
                        {{"steps", watch}, {"gained", gained}},
                        "",
                        diagnosis});
}

Equations::Equations(const system::Regime& s, const system::Pattern& p, double tolerance)
    : system(s), pattern(p), rtol(tolerance), parts(p), workspace_(s), jacobian_workspace_(s) {
  find_multipliers();
}

/// Finds the entries of G: velocity rows G u with the masses of u; position rows by the positions.
void Equations::find_multipliers() {
  multipliers_.resize(static_cast<std::size_t>(system.sigma0 - system.lambda0));
  std::vector<Index> mass(static_cast<std::size_t>(system.n), -1);
  auto each = [&](auto&& visit) {
    for (Index column = 0; column < system.n; ++column)
      for (Index k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
        visit(pattern.row[k], column, static_cast<std::size_t>(k));
  };
  each([&](Index row, Index column, std::size_t k) {
    if (row == column && row >= system.u0 && row < system.z0)
      mass[static_cast<std::size_t>(row)] = static_cast<Index>(k);
  });
  each([&](Index row, Index column, std::size_t k) {
    if (row < system.lambda0 || row >= system.sigma0)
      return;
    Multiplier& m = multipliers_[static_cast<std::size_t>(row - system.lambda0)];
    const bool velocity_row = row < system.mu0;
    if (velocity_row && column >= system.u0 && column < system.z0)
      m.gradient.emplace_back(k, mass[static_cast<std::size_t>(column)]);
    else if (!velocity_row && column < system.n_q)
      m.gradient.emplace_back(k, -1);
  });
}

void Equations::regularisation(double alpha, VectorX& out) const {
  constexpr double e = 1e-10;
  for (std::size_t i = 0; i < multipliers_.size(); ++i) {
    double d = 0.0;
    for (const auto& [entry, mass] : multipliers_[i].gradient) {
      const double G = parts.by_y[entry];
      if (G != 0.0)
        d += G * G / (mass < 0 ? 1.0 : parts.by_yp[static_cast<std::size_t>(mass)]);
    }
    out[static_cast<Index>(i)] = e * d / alpha;
  }
}

bool Equations::residual(double t, const VectorX& y, const VectorX& yp, VectorX& r) {
  ++statistics.residual_calls;
  system::residual<double>(system, workspace_, t, y.data(), yp.data(), r.data());
  return std::isfinite(r.sum());
}

bool Equations::free_residual(double t, const VectorX& y, const VectorX& yp, VectorX& r) {
  ++statistics.residual_calls;
  system::free_residual<double>(system, workspace_, t, y.data(), yp.data(), r.data());
  return std::isfinite(r.head(system.lambda0).sum());
}

bool Equations::constraint_residual(double t, const VectorX& y, const VectorX& yp, VectorX& r) {
  system::constraint_residual<double>(system, workspace_, t, y.data(), yp.data(), r.data());
  return std::isfinite(r.segment(system.lambda0, system.sigma0 - system.lambda0).sum());
}

bool Equations::solve_algebraic(double t, VectorX& y) {
  return system::solve_algebraic(system, jacobian_workspace_, t, y);
}

void Equations::jacobian(double t, const VectorX& y, const VectorX& yp) {
  ++statistics.jacobian_calls;
  mass_and_rows(t, y, yp, pattern, parts);
}

void Equations::mass_and_rows(double t, const VectorX& y, const VectorX& yp,
                              const system::Pattern& own, system::JacobianParts& out) {
  system::jacobian(system, own, jacobian_workspace_, t, y.data(), yp.data(), out);
}

void Equations::accept(double t, const VectorX& y, const VectorX& yp) {
  if (system.motions.empty() && system.system.rotations.empty())
    return;
  system::accept_turns(system, t, y.data(), yp.data(), workspace_);
  jacobian_workspace_.state.turns = workspace_.turns;
}

void Equations::weights(const VectorX& y, VectorX& w) const {
  w = (rtol * (system.scale.array() + system.relative.array() * y.array().abs())).inverse();
}

double largest_by_group(const system::Regime& s, const double* squares, VectorX& sums) {
  sums.setZero(s.n_error_groups());
  for (Index i = 0; i < s.lambda0; ++i)
    sums[s.error_group[static_cast<std::size_t>(i)]] += squares[i];
  return sums.allFinite() ? std::sqrt(sums.cwiseQuotient(s.group_size).maxCoeff()) : INFINITY;
}

double Equations::norm(const VectorX& w, const VectorX& e) const {
  const Index n = system.lambda0;
  if (system.n_error_groups() <= 1)
    return std::sqrt(w.head(n).cwiseProduct(e.head(n)).squaredNorm() /
                     static_cast<double>(std::max<Index>(n, 1)));
  squares_ = w.head(n).cwiseProduct(e.head(n)).cwiseAbs2();
  return largest_by_group(system, squares_.data(), sums_);
}

double first_step(const system::Regime& system, double rtol, const VectorX& y, const VectorX& yp) {
  double time = INFINITY;
  for (const system::BodyData& b : system.bodies)
    for (int k = 0; k < b.n_active; ++k) {
      const Index u = b.u0 + k;
      const double size = system.scale[u] * b.time_scale;
      time = std::min({time, b.time_scale, size / std::max(std::abs(y[u]), 1e-300),
                       std::sqrt(size / std::max(std::abs(yp[u]), 1e-300))});
    }
  return 0.3 * std::sqrt(rtol) * time;
}

double Equations::time_scale() const {
  double time = 0.0;
  for (const system::BodyData& b : system.bodies)
    time = std::max(time, b.time_scale);
  return time;
}

std::string Equations::diagnosis(double t, const VectorX& y, const VectorX& yp) {
  // trouble of the last attempt
  const std::string trouble = system::unknown_load(system, workspace_);
  VectorX values(system.n);
  system::residual<double>(system, workspace_, t, y.data(), yp.data(), values.data());
  std::string text = trouble.empty() ? "" : "\n  the last step tried meets " + trouble;
  text += "\n  worst equations, relative to their scale: " +
          worst(values.cwiseQuotient(system.row_scale), system.row_names);
  // A locked loop shows in reactions that grow without bound.
  values.setZero();
  values.segment(system.lambda0, system.n_lambda) =
      y.segment(system.lambda0, system.n_lambda)
          .cwiseQuotient(system.scale.segment(system.lambda0, system.n_lambda));
  if (system.n_lambda > 0)
    text += "\n  largest reactions at the last good step, relative to the weights: " +
            worst(values, system.names);
  return text;
}

} // namespace hydrodae::linalg
