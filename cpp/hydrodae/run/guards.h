#pragma once
/// Guards of a run, in one list: each looks at every accepted step, in the order of the list.

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hydrodae/run/pose_watch.h"
#include "hydrodae/run/step.h"

namespace hydrodae::run {

/// Velocities in the window in which a jump is one.
struct BranchState {
  VectorX largest;                             ///< kinetic energy by mechanism [J]
  std::deque<std::pair<double, VectorX>> past; ///< times in the window and the velocities there
};

struct GuardStates {
  PoseWatch::State poses;
  BranchState branch;
  std::vector<double> axes; ///< of each rotation where it was last within half a turn; zero: none
};

/// A guard that needs the ends of the steps alone: of a run in a march of several, too.
class EndGuard : public Follower {
public:
  void judge(const Step& step) final { look(step); }

  /// Throws SolverError where the step is proved wrong.
  virtual void look(const StepEnd& end) = 0;
};

/// The guards of this kind that the options ask for. All arguments outlive the guards.
std::vector<std::unique_ptr<EndGuard>> make_end_guards(const system::Regime& system,
                                                       const SolverOptions& options);

/// Part of the energy exchanged that may be missing; 0: the energy is not judged.
double allowed_energy(const SolverOptions& options);

/// All guards that the options ask for. Each ends a run only on proof of failure: energy made or
/// lost, positions whose rounding hides the tolerance, velocities that jump, constraints that
/// drift, friction that leaves no accelerations, rotation vectors that lose their meaning.
class Guards : public Follower {
public:
  /// @param pattern of the rows that hold; like `system` and `options`, it outlives the guards,
  ///   which follow its changes
  /// @param y pose of the start
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

/// The arguments of the functions that make a guard.
struct GuardInputs {
  const system::Regime& system;
  const system::Pattern& pattern;
  const SolverOptions& options;
  PoseWatch& poses;
};

// Functions that make a guard. Null: it has nothing to look at in this scene.
std::unique_ptr<Follower> make_energy_guard(const GuardInputs& in);
std::unique_ptr<Follower> make_drift_guard(const GuardInputs& in);
std::unique_ptr<EndGuard> make_branch_guard(const system::Regime& system,
                                            const SolverOptions& options);
std::unique_ptr<EndGuard> make_turn_guard(const system::Regime& system,
                                          const SolverOptions& options);

/// Does the energy guard allow less at singular poses of closed loops than elsewhere?
bool energy_minds_singular_poses(const SolverOptions& options);

/// May the formulation let the constraints drift, unless the drift is wanted (`--force`)?
bool minds_drift(const system::Regime& system, const SolverOptions& options);

/// Energy of errors within the tolerance [J]: an exchange of less is not judged.
/// @param mechanism whose bodies count; -1: all bodies
double energy_of_errors(const system::Regime& system, double rtol, int mechanism = -1);

/// "largest reactions ..." at y, as a further line of a message; empty without constraints.
std::string largest_reactions(const system::Regime& system, const VectorX& y);

} // namespace hydrodae::run
