#pragma once
/// Step of a method, and the interface of objects that follow all steps.

#include <optional>

#include "hydrodae/integrate/integrator.h"
#include "hydrodae/measure/measure.h"

namespace hydrodae::run {

struct State;

/// End of the last step.
struct StepEnd {
  double start = 0.0, end = 0.0; ///< [s]
  bool event = false;            ///< true: rows of the system change at the end
  const VectorX& y;              ///< unknowns at the end; after an event those that continue
  const VectorX& yp;
  const system::Turns& turns; ///< turns of the angles at the end
};

/// Complete step.
struct Step : StepEnd {
  integrate::Integrator& integrator; ///< integrator, for y, y' inside the step
  const measure::Measure& measure;
  bool may_change = false; ///< true: another method can repeat the step
  bool own = false;        ///< true: the method chose the end
};

/// Restart from an accepted instant with other rows or loads.
struct Restart {
  double t = 0.0; ///< [s]
  const VectorX& y;
  const VectorX& yp;
  std::optional<double> work; ///< work of all rows through their impulses [J], after an impact
};

/// Follower of all steps. Followers are called in the order of their list.
class Follower {
public:
  virtual ~Follower() = default;

  /// Checks a step. Throws SolverError to reject it.
  virtual void judge(const Step&) {}

  /// Takes an accepted step.
  virtual void accept(const Step&) {}

  /// Takes other rows or loads from the last accepted instant on.
  virtual void restart(const Restart&) {}

  /// Takes the end of the run. Throws SolverError as `judge` does.
  virtual void finish(const Step&) {}

  /// Saves the state of the follower in its member of the state of the run.
  virtual void save(State&) const {}
  virtual void set(const State&) {}
};

/// Follower whose state is one member of the state of the run; optional, because not all scenes
/// have the part.
template <auto place, class Part> class FollowerOf : public Follower {
public:
  explicit FollowerOf(Part& part) : part_(part) {}
  void save(State& out) const override { out.*place = part_.state(); }
  void set(const State& from) override {
    if constexpr (requires { (from.*place).value(); })
      part_.set((from.*place).value());
    else
      part_.set(from.*place);
  }

protected:
  Part& part_;
};

} // namespace hydrodae::run
