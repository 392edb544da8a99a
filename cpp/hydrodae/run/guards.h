#pragma once
/// Guards of a run in one list: each checks every accepted step, in the order of the list.

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hydrodae/run/pose_watch.h"
#include "hydrodae/run/step.h"

namespace hydrodae::run {

/// Velocities in the time window of the branch guard.
struct BranchState {
  VectorX largest;                             ///< largest kinetic energy by mechanism [J]
  std::deque<std::pair<double, VectorX>> past; ///< times in the window, with the velocities
};

struct GuardStates {
  PoseWatch::State poses;
  BranchState branch;
  /// Axis of each rotation when it was last within half a turn; zero: none
  std::vector<double> axes;
};

/// Guard that needs only the ends of the steps; usable in a march of several runs.
class EndGuard : public Follower {
public:
  void judge(const Step& step) final { look(step); }

  /// Checks a step. Throws SolverError if it is wrong.
  virtual void look(const StepEnd& end) = 0;
};

/// End guards that the options select. All arguments must outlive the guards.
std::vector<std::unique_ptr<EndGuard>> make_end_guards(const system::Regime& system,
                                                       const SolverOptions& options);

/// Allowed part of the energy exchanged that may be missing; 0: no energy guard.
double allowed_energy(const SolverOptions& options);

/// Guards that the options select. Each ends a run only on proof of failure: energy produced or
/// lost, rounding above the tolerance, jumping velocities, drifting constraints, friction without
/// accelerations, rotation vectors without an axis.
class Guards : public Follower {
public:
  /// @param pattern  pattern of the rows that hold; like `system` and `options` it must outlive the
  /// guards, which follow its changes
  /// @param y  pose at the start
  Guards(const system::Regime& system, const system::Pattern& pattern, const SolverOptions& options,
         const VectorX& y);

  void judge(const Step& step) override;
  void restart(const Restart& from) override;
  void finish(const Step& step) override;
  void save(State& out) const override;
  void set(const State& from) override;

  PoseWatch& poses() { return poses_; }

private:
  PoseWatch poses_;
  std::vector<std::unique_ptr<Follower>> list_;
};

/// Arguments of the functions that make a guard.
struct GuardInputs {
  const system::Regime& system;
  const system::Pattern& pattern;
  const SolverOptions& options;
  const VectorX& y; ///< pose at the start
  PoseWatch& poses;
};

// Functions that make a guard; null: the scene needs no such guard.
std::unique_ptr<Follower> make_energy_guard(const GuardInputs& in);
std::unique_ptr<Follower> make_drift_guard(const GuardInputs& in);
std::unique_ptr<EndGuard> make_branch_guard(const system::Regime& system,
                                            const SolverOptions& options);
std::unique_ptr<EndGuard> make_turn_guard(const system::Regime& system,
                                          const SolverOptions& options);

/// Returns whether the energy guard allows less at singular poses of closed loops than elsewhere.
bool energy_minds_singular_poses(const SolverOptions& options);

/// Returns whether constraints may drift in this formulation and the drift is not wanted
/// (`--force`).
bool minds_drift(const system::Regime& system, const SolverOptions& options);

/// Energy of errors within the tolerance [J]; a smaller exchange is not judged.
/// @param mechanism  mechanism whose bodies count; -1: all bodies
double energy_of_errors(const system::Regime& system, double rtol, int mechanism = -1);

/// Message line "largest reactions ..." at y; empty without constraints.
std::string largest_reactions(const system::Regime& system, const VectorX& y);

} // namespace hydrodae::run
