#pragma once
/// Guards of a run, in one list: each looks at every accepted step, in the order of the list.

#include <memory>
#include <string>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/integrate/integrator.h"
#include "hydrodae/measure/measure.h"
#include "hydrodae/run/pose_watch.h"

namespace hydrodae::run {

/// The step that was accepted last, as the guards see it.
struct Step {
  double start = 0.0, end = 0.0; ///< [s]
  bool event = false;            ///< rows of the system come or go at its end
  const VectorX& y;              ///< at its end; after an event those that go on from there
  const VectorX& yp;
  integrate::Integrator& integrator; ///< gives y, y' inside the step
  const measure::Measure& measure;
  bool may_change = false; ///< another method can make the step again
};

class Guard {
public:
  virtual ~Guard() = default;

  /// Throws SolverError where the step is proved wrong.
  virtual void accept(const Step& step) = 0;

  /// Other rows hold from the last accepted instant on.
  virtual void restart() {}

  /// At the end of the run. Throws SolverError as `accept` does.
  virtual void finish(const Step&) {}

  /// Results of the steps before that the guard needs.
  virtual void remember(Archive&) {}
};

/// All guards that the options ask for. Each ends a run only on proof of failure: energy made or
/// lost, positions whose rounding hides the tolerance, velocities that jump, constraints that
/// drift, friction that leaves no accelerations, rotation vectors that lose their meaning.
class Guards {
public:
  /// @param pattern of the rows that hold; like `system` and `options`, it outlives the guards,
  ///   which follow its changes
  /// @param y pose of the start
  Guards(const system::Regime& system, const system::Pattern& pattern, const SolverOptions& options,
         const VectorX& y);

  /// Throws SolverError where a guard proves the step wrong.
  void accept(const Step& step) {
    for (const std::unique_ptr<Guard>& guard : list_)
      guard->accept(step);
  }

  /// Other rows hold from the last accepted instant on, where the unknowns are y.
  void restart(const VectorX& y);

  /// The last look, at the end of the run. Throws SolverError.
  void finish(const Step& step);

  PoseWatch& poses() { return poses_; }
  void remember(Archive& a);

private:
  PoseWatch poses_;
  std::vector<std::unique_ptr<Guard>> list_;
};

/// The arguments of the functions that make a guard.
struct GuardInputs {
  const system::Regime& system;
  const system::Pattern& pattern;
  const SolverOptions& options;
  PoseWatch& poses;
};

// Functions that make a guard. Null: it has nothing to look at in this scene.
std::unique_ptr<Guard> make_energy_guard(const GuardInputs& in);
std::unique_ptr<Guard> make_branch_guard(const GuardInputs& in);
std::unique_ptr<Guard> make_drift_guard(const GuardInputs& in);
std::unique_ptr<Guard> make_turn_guard(const GuardInputs& in);

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
