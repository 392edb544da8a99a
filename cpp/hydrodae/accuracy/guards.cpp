#include "hydrodae/accuracy/guards.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::accuracy {

namespace {

constexpr double allowed_gap = 1e-2; ///< of the scale of the row
constexpr double allowed_gap_at_singular_pose = 1e-5;
constexpr double allowed_jump = 0.3; ///< of the largest kinetic energy so far
constexpr double singular = 1e-2;    ///< of the best independence of the rows seen
constexpr double window = 3e-3;      ///< of the shortest time scale of a body

/// The mechanism of each row of the constraints.
std::vector<int> row_mechanisms(const system::Regime& s) {
  std::vector<int> out(static_cast<std::size_t>(s.n_lambda));
  const auto take = [&](const system::JointData& j, Index lambda) {
    if (const system::BodyData* body = system::moving_body(s, j))
      out[static_cast<std::size_t>(lambda - s.lambda0)] = body->mechanism;
  };
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      if (s.holds(row))
        take(j, s.lambda(row));
  for (const system::CouplerData& c : s.couplers)
    if (s.holds(c))
      take(system::joint_of(s, c), s.lambda(c));
  return out;
}

system::Regime stabilised(system::Regime s) {
  s.formulation = system::Formulation::stabilised;
  return s;
}

} // namespace

bool has_loop(const system::Regime& s) {
  const int ground = static_cast<int>(s.bodies.size());
  std::vector<int> root(s.bodies.size() + 1);
  std::iota(root.begin(), root.end(), 0);
  auto find = [&](int i) {
    while (root[static_cast<std::size_t>(i)] != i)
      i = root[static_cast<std::size_t>(i)];
    return i;
  };
  auto place = [&](int body) {
    return body < 0 || s.bodies[static_cast<std::size_t>(body)].n_active == 0 ? ground : body;
  };
  // A body that keeps two coordinates at most is guided by the ground.
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (s.bodies[i].n_active <= 2)
      root[i] = ground;
  for (const system::JointData& j : s.joints) {
    if (j.rows.empty())
      continue;
    const int a = find(place(j.A.body)), b = find(place(j.B.body));
    if (a == b && place(j.A.body) != place(j.B.body))
      return true;
    root[static_cast<std::size_t>(a)] = b;
  }
  return false;
}

DriftGuard::DriftGuard(const system::Regime& system)
    : stabilised_(stabilised(system)), workspace_(stabilised_), residual_(system.n) {}

void DriftGuard::check(double t, const VectorX& y, const VectorX& yp) {
  system::residual<double>(stabilised_, workspace_, t, y.data(), yp.data(), residual_.data());
  residual_ = residual_.cwiseQuotient(stabilised_.row_scale);
  worst_ = stabilised_.mu0;
  for (Index i = stabilised_.lambda0; i < stabilised_.sigma0; ++i) {
    const bool rate = i < stabilised_.mu0;
    const double gap = std::abs(residual_[i]);
    if (!rate && gap > std::abs(residual_[worst_]))
      worst_ = i;
    // Rates count from a tenth of the scale: index 3 leaves some noise in them.
    if (!(gap <= allowed_gap * (rate ? 10.0 : 1.0)))
      fail(t, i, "");
  }
}

bool DriftGuard::misses_singular_poses() const {
  return worst_ < stabilised_.sigma0 && std::abs(residual_[worst_]) > allowed_gap_at_singular_pose;
}

void DriftGuard::fail_at_singular_pose(double t) const {
  fail(t, worst_, ", at a singular pose, where the motion may go on in another branch");
}

void DriftGuard::fail(double t, Index row, const std::string& where) const {
  throw SolverError(
      t, {Reason::drift,
          "the constraints have drifted: " + stabilised_.row_names[row] + " is " +
              number_text(residual_[row]) + " of its scale" + where,
          stabilised_.row_names[row],
          {{"gap", residual_[row]}},
          "the stabilised formulation, a Baumgarte time or a smaller tolerance keeps them",
          ""});
}

PoseGuard::PoseGuard(const system::Regime& system, const VectorX& y)
    : stabilised_(stabilised(system)), pattern_(system::find_pattern(stabilised_)),
      equations_(stabilised_, pattern_, 1.0), saddle_(equations_),
      mechanism_(row_mechanisms(stabilised_)),
      best_(independence(0.0, y, VectorX::Zero(y.size()))) {}

VectorX PoseGuard::independence(double t, const VectorX& y, const VectorX& yp) {
  VectorX at = y, rate = yp;
  const int parts = std::max(stabilised_.n_mechanisms, 1);
  if (!saddle_.accelerations(t, at, rate))
    return VectorX::Zero(parts);
  return saddle_.independence(mechanism_, parts);
}

bool PoseGuard::near_singular(double t, const VectorX& y, const VectorX& yp) {
  const VectorX now = independence(t, y, yp);
  best_ = best_.cwiseMax(now);
  return (now.array() <= singular * best_.array()).any();
}

BranchGuard::BranchGuard(const system::Regime& system)
    : s_(system), mass_(system.n_u), mechanism_(static_cast<std::size_t>(system.n_u)),
      active_(has_loop(system)) {
  window_ = HUGE_VAL;
  for (const system::BodyData& b : s_.bodies) {
    if (b.n_active > 0)
      window_ = std::min(window_, window * b.time_scale);
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[k];
      mass_[b.u0 - s_.u0 + k] = c < 3 ? b.mass : b.inertia(c - 3, c - 3);
      mechanism_[static_cast<std::size_t>(b.u0 - s_.u0 + k)] = std::max(b.mechanism, 0);
    }
  }
  largest_ = energies(s_.scale.segment(s_.u0, s_.n_u)); // a start from rest is no jump
}

VectorX BranchGuard::energies(const VectorX& u) const {
  VectorX out = VectorX::Zero(std::max(s_.n_mechanisms, 1));
  for (Index k = 0; k < u.size(); ++k)
    out[mechanism_[static_cast<std::size_t>(k)]] += 0.5 * mass_[k] * u[k] * u[k];
  return out;
}

void BranchGuard::check(double t, const VectorX& y) {
  if (!active_)
    return;
  const VectorX u = y.segment(s_.u0, s_.n_u);
  while (past_.size() > 1 && past_[1].first <= t - window_)
    past_.pop_front();
  largest_ = largest_.cwiseMax(energies(u));
  // A longer step says nothing about a jump.
  if (!past_.empty() && t - past_.front().first <= 2.0 * window_) {
    const double jump =
        energies(u - past_.front().second).cwiseQuotient(largest_.cwiseMax(1e-300)).maxCoeff();
    if (jump > allowed_jump) {
      VectorX reactions = VectorX::Zero(s_.n);
      reactions.segment(s_.lambda0, s_.n_lambda) =
          y.segment(s_.lambda0, s_.n_lambda)
              .cwiseQuotient(s_.scale.segment(s_.lambda0, s_.n_lambda));
      throw SolverError(
          t, {Reason::branch,
              "the velocities jumped within " + number_text(t - past_.front().first) + " s (" +
                  rounded_text(jump) +
                  " of the largest kinetic energy), though nothing struck: at a singular pose the "
                  "motion left its branch",
              "",
              {{"jump", jump}},
              "a smaller tolerance, or radau or explicit_rk, may pass (solver.branch_guard = false "
              "lets it go on)",
              "\n  largest reactions, relative to the weights: " +
                  linalg::worst(reactions, s_.names)});
    }
  }
  past_.emplace_back(t, u);
}

} // namespace hydrodae::accuracy
