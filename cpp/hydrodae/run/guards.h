#pragma once
/// What watches a run, as one list: each guard looks at every accepted step, in this order.

#include <memory>
#include <string>
#include <vector>

#include "hydrodae/accuracy/guards.h"
#include "hydrodae/core/archive.h"
#include "hydrodae/integrate/integrator.h"
#include "hydrodae/measure/measure.h"

namespace hydrodae::run {

/// The step that was accepted last, as the guards see it.
struct Step {
  double start = 0.0, end = 0.0; ///< [s]
  bool event = false;            ///< rows of the system come or go at its end
  const VectorX& y;              ///< at its end; after an event those that go on from there
  const VectorX& yp;
  integrate::Integrator& integrator; ///< gives y, y' inside the step
  const measure::Measure& measure;
};

class Guard {
public:
  virtual ~Guard() = default;

  /// Throws SolverError where the step is proved wrong.
  virtual void check(const Step& step) = 0;

  /// Other rows hold from the end of the step on.
  virtual void restart(const Step&) {}

  /// At the end of the run. Throws SolverError as `check` does.
  virtual void finish(const Step&) {}

  /// What it has to know of the steps before.
  virtual void remember(Archive&) {}
};

/// Decides whether a step was at or next to a singular pose of a closed loop, for the guards that
/// allow less there. It watches nothing in scenes without loops.
class PoseWatch {
public:
  /// @param y pose of the start, taken for a regular one
  /// @param wanted some guard will ask
  PoseWatch(const system::Regime& system, const SolverOptions& options, const VectorX& y,
            bool wanted);

  /// Of short steps one in four is looked at, since the way through such a pose takes more; long
  /// ones are looked at inside, too.
  bool near_singular(const Step& step);

  /// What to do about a step that cannot be made next to a singular pose, behind the first line of
  /// `text`.
  Halt with_remedy(Halt halt, double t, const VectorX& y, const VectorX& yp);

  /// The steps are those of this method from now on.
  void use(const std::string& method) { method_ = method; }

  void restart(const VectorX& y);
  void remember(Archive& a);

private:
  const system::Regime& s_;
  std::string method_;
  std::unique_ptr<accuracy::PoseGuard> guard_; ///< null: nothing to watch
  long asked_ = 0;                             ///< times that a singular pose would have mattered
  VectorX y_, yp_;
};

/// All guards that the options ask for. Each ends a run only on proof of failure: energy made or
/// lost, positions whose rounding hides the tolerance, velocities that jump, constraints that
/// drift, friction that leaves no accelerations.
/// @param pattern of the rows that hold
/// @param watch takes the watch over singular poses, which outlives the guards
/// @param y pose of the start
std::vector<std::unique_ptr<Guard>> make_guards(const system::Regime& system,
                                                const system::Pattern& pattern,
                                                const SolverOptions& options,
                                                const VectorX& y,
                                                std::unique_ptr<PoseWatch>& watch);

} // namespace hydrodae::run
