#pragma once
/// Where ropes with friction begin or end to slip inside a step: the event, and what holds from
/// then on.

#include <memory>
#include <optional>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/element/rubbing.h"
#include "hydrodae/run/law_view.h"
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
  using View = LawView<element::Rubbing>;
  explicit RubbingWatch(system::Regime& regime)
      : s_(regime), view_(regime, &element::Rubbing::may_rub) {}
  template <class Visit> void visit(double t, const VectorX& y, Visit&& act);

  system::Regime& s_;
  View view_;
  VectorX y_, yp_;
  std::vector<double> held_, room_;
};

} // namespace hydrodae::run
