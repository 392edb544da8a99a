#pragma once
/// A step that a method has made, and what all have in common who look at it.

#include <optional>

#include "hydrodae/integrate/integrator.h"
#include "hydrodae/measure/measure.h"

namespace hydrodae::run {

struct State;

/// The end of the step that was made last.
struct StepEnd {
  double start = 0.0, end = 0.0; ///< [s]
  bool event = false;            ///< rows of the system come or go at the end
  const VectorX& y;              ///< at the end; after an event those that go on from there
  const VectorX& yp;
  const system::Turns& turns; ///< of the angles at the end
};

/// The whole step.
struct Step : StepEnd {
  integrate::Integrator& integrator; ///< gives y, y' inside the step
  const measure::Measure& measure;
  bool may_change = false; ///< another method can make the step again
  bool own = false;        ///< the method chose its end
};

/// What holds from an accepted instant on, where other rows or loads do.
struct Restart {
  double t = 0.0; ///< [s]
  const VectorX& y;
  const VectorX& yp;
  std::optional<double> work; ///< of all rows through their impulses [J], where something struck
};

/// One of the list of those who look at every step. They are called in the order of the list, by
/// the same names.
class Follower {
public:
  virtual ~Follower() = default;

  /// Throws SolverError where the step is proved wrong: it does not count.
  virtual void judge(const Step&) {}

  /// The step counts.
  virtual void accept(const Step&) {}

  /// Other rows or loads hold from the last accepted instant on.
  virtual void restart(const Restart&) {}

  /// At the end of the run. Throws SolverError as `judge` does.
  virtual void finish(const Step&) {}

  /// What the steps before have left, in its place of the state of the run.
  virtual void save(State&) const {}
  virtual void set(const State&) {}
};

/// A follower whose state stands in one member of the state of the run, optional where not all
/// scenes have such a part.
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
