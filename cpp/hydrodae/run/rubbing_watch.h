#pragma once
/// Where ropes with friction begin or end to slip inside a step: the event, and what holds from
/// then on.

#include <memory>
#include <optional>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/element/rubbing.h"
#include "hydrodae/system/recorder.h"

namespace hydrodae::run {

class RubbingWatch {
public:
  /// Null: nothing in the system rubs so.
  static std::unique_ptr<RubbingWatch> make(system::Regime& regime);

  /// The first change in (t0, t1] of an accepted step, if any.
  /// @param nodes  parts of the step at whose ends it is looked for
  std::optional<double> locate(double t0, double t1, int nodes,
                               const system::Recorder::Interpolant& at);

  /// Lets stick and slip what does so at t [s]. Throws SolverError where that is not found.
  /// @returns whether anything has changed
  bool settle(double t, const VectorX& y);

  void remember(Archive& a);

private:
  struct List {
    std::size_t index;
    const element::Rubbing* laws;
  };
  explicit RubbingWatch(system::Regime& regime) : s_(regime), ws_(regime) {}
  template <class Visit> void visit(double t, const VectorX& y, Visit&& act);

  system::Regime& s_;
  system::Workspace<double> ws_;
  std::vector<List> lists_;
  VectorX y_, yp_;
  std::vector<double> held_, room_;
};

} // namespace hydrodae::run
