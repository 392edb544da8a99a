/// Guards of closed loops and their constraints: jumps of velocities, open gaps.

#include <algorithm>
#include <cmath>
#include <deque>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/run/state.h"
#include "hydrodae/system/mass.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::run {

namespace {

constexpr double allowed_gap = 1e-2; ///< allowed gap, as part of the scale of the row
constexpr double allowed_gap_at_singular_pose = 1e-5;
constexpr double allowed_jump = 0.3; ///< allowed jump, as part of the largest kinetic energy so far
constexpr double window = 3e-3;      ///< time window, as part of the shortest time scale of a body

/// Guard of the constraints at both levels, which drift apart in formulations that do not keep
/// them.
class DriftGuard final : public Follower {
public:
  DriftGuard(const system::Regime& s, PoseWatch& poses) : s_(s), poses_(poses) { make(); }

  /// A gap above a hundredth of its scale ends the run; at a singular pose a position gap above
  /// 1e-5. Loops with a gap pass a singular pose at a distance of sqrt(gap), which can turn the
  /// motion into another branch.
  void judge(const Step& step) override {
    const Index worst = widest(step);
    if (worst < rows_->system.sigma0 &&
        std::abs(rows_->residual[worst]) > allowed_gap_at_singular_pose &&
        poses_.near_singular(step))
      fail(step.end, worst, ", at a singular pose, where the motion may go on in another branch");
  }
  void restart(const Restart&) override { make(); }

private:
  void make() { rows_ = std::make_unique<Rows>(s_); }

  /// Rows that hold now.
  struct Rows {
    explicit Rows(const system::Regime& s)
        : system(stabilised(s)), workspace(system), residual(s.n) {}
    system::Regime system;
    system::Workspace<double> workspace;
    VectorX residual; ///< residual relative to the scales
  };

  /// Index of the row with the widest position gap. Throws SolverError if a gap is too wide.
  Index widest(const Step& step) {
    const system::Regime& s = rows_->system;
    VectorX& gaps = rows_->residual;
    system::residual<double>(s, rows_->workspace, step.end, step.y.data(), step.yp.data(),
                             gaps.data());
    gaps = gaps.cwiseQuotient(s.row_scale);
    Index worst = s.mu0;
    for (Index i = s.lambda0; i < s.sigma0; ++i) {
      const bool rate = i < s.mu0;
      const double gap = std::abs(gaps[i]);
      if (!rate && gap > std::abs(gaps[worst]))
        worst = i;
      // Rates count from a tenth of the scale: index 3 leaves noise in them.
      if (!(gap <= allowed_gap * (rate ? 10.0 : 1.0)))
        fail(step.end, i, "");
    }
    return worst;
  }

  [[noreturn]] void fail(double t, Index row, const std::string& where) const {
    const std::string& name = rows_->system.row_names[row];
    const double gap = rows_->residual[row];
    throw SolverError(
        t, {Reason::drift,
            "the constraints have drifted: " + name + " is " + number_text(gap) + " of its scale" +
                where,
            name,
            {{"gap", gap}},
            "the stabilised formulation, a Baumgarte time or a smaller tolerance keeps them",
            ""});
  }

  const system::Regime& s_;
  std::unique_ptr<Rows> rows_;
  PoseWatch& poses_;
};

/// Guard against jumps to another branch in a singular pose of a closed loop, where velocities
/// change at once without an impact. Within 0.003 time scales the kinetic energy of the jump was
/// 0.6 to 3 of the largest kinetic energy of the mechanism on a wrong branch, and below 0.01
/// otherwise.
class BranchGuard final : public EndGuard {
public:
  explicit BranchGuard(const system::Regime& s)
      : s_(s), mass_(s.n_u), mechanism_(static_cast<std::size_t>(s.n_u)) {
    for (const system::BodyData& b : s_.bodies) {
      if (b.n_active > 0)
        window_ = std::min(window_, window * b.time_scale);
      for (int k = 0; k < b.n_active; ++k) {
        const int c = b.active[k];
        mass_[b.u0 - s_.u0 + k] =
            std::max(system::rigid_mass(b)(c, c),
                     system::wet_mass(s_, static_cast<int>(&b - s_.bodies.data()), c));
        mechanism_[static_cast<std::size_t>(b.u0 - s_.u0 + k)] = std::max(b.mechanism, 0);
      }
    }
    state_.largest = energies(s_.scale.segment(s_.u0, s_.n_u)); // a start from rest is no jump
  }

  void look(const StepEnd& step) override {
    const double t = step.end;
    const VectorX u = step.y.segment(s_.u0, s_.n_u);
    while (state_.past.size() > 1 && state_.past[1].first <= t - window_)
      state_.past.pop_front();
    state_.largest = state_.largest.cwiseMax(energies(u));
    // A longer step says nothing about a jump.
    if (!state_.past.empty() && t - state_.past.front().first <= 2.0 * window_) {
      const double jump = energies(u - state_.past.front().second)
                              .cwiseQuotient(state_.largest.cwiseMax(1e-300))
                              .maxCoeff();
      if (jump > allowed_jump)
        fail(step, jump);
    }
    state_.past.emplace_back(t, u);
  }

  /// Restarts the window: an impact has changed the velocities.
  void restart(const Restart&) override { state_.past.clear(); }

  void save(State& out) const override { out.guards.branch = state_; }
  void set(const State& from) override { state_ = from.guards.branch; }

private:
  /// Kinetic energy of each mechanism at the velocities u (n_mechanisms,) [J].
  VectorX energies(const VectorX& u) const {
    VectorX out = VectorX::Zero(std::max(s_.n_mechanisms, 1));
    for (Index k = 0; k < u.size(); ++k)
      out[mechanism_[static_cast<std::size_t>(k)]] += 0.5 * mass_[k] * u[k] * u[k];
    return out;
  }

  [[noreturn]] void fail(const StepEnd& step, double jump) const {
    throw SolverError(
        step.end,
        {Reason::branch,
         "the velocities jumped within " + number_text(step.end - state_.past.front().first) +
             " s (" + rounded_text(jump) +
             " of the largest kinetic energy), though nothing struck: at a singular pose the "
             "motion left its branch",
         "",
         {{"jump", jump}},
         "a smaller tolerance, or radau or explicit_rk, may pass (solver.branch_guard = false "
         "lets it go on)",
         largest_reactions(s_, step.y)});
  }

  const system::Regime& s_;
  VectorX mass_;               ///< (n_u,) mass of each velocity
  std::vector<int> mechanism_; ///< (n_u,) mechanism of each velocity
  double window_ = HUGE_VAL;   ///< time window [s]
  BranchState state_;
};

} // namespace

bool minds_drift(const system::Regime& s, const SolverOptions& options) {
  return s.formulation != system::Formulation::stabilised && !options.force;
}

std::unique_ptr<Follower> make_drift_guard(const GuardInputs& in) {
  if (!minds_drift(in.system, in.options))
    return nullptr;
  return std::make_unique<DriftGuard>(in.system, in.poses);
}

/// Branch guard; null for scenes without loops, which have no singular poses.
std::unique_ptr<EndGuard> make_branch_guard(const system::Regime& system,
                                            const SolverOptions& options) {
  if (!options.branch_guard || !has_loop(system))
    return nullptr;
  return std::make_unique<BranchGuard>(system);
}

} // namespace hydrodae::run
