#pragma once
/// Where ropes and lines part inside a step: the event, and what holds from then on.

#include <memory>
#include <optional>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/element/parting.h"
#include "hydrodae/run/law_view.h"
#include "hydrodae/system/recorder.h"

namespace hydrodae::run {

class PartingWatch {
public:
  /// Null: nothing in the system parts. Throws ModelError where a rope or line is loaded beyond
  /// what it bears at the start, y.
  static std::unique_ptr<PartingWatch> make(system::Regime& regime, const VectorX& y);

  /// The first parting in (t0, t1] of an accepted step, if any; of what parts as its load begins,
  /// a damper's, just before, so that nothing of that load is in the step.
  /// @param nodes  parts of the step at whose ends it is looked for
  std::optional<double> locate(double t0, double t1, int nodes,
                               const system::Recorder::Interpolant& at);

  /// At an event: lets part what has reached its breaking load at t [s].
  void part(double t, const VectorX& y);

  void remember(Archive& a);

private:
  using View = LawView<element::Parting>;
  explicit PartingWatch(system::Regime& regime)
      : s_(regime), view_(regime, &element::Parting::may_part) {}
  template <class Visit> void visit(double t, const VectorX& y, Visit&& act);
  double largest_ratio(double t, const VectorX& y);
  void find_sudden(double t, const VectorX& y);

  system::Regime& s_;
  View view_;
  VectorX y_, yp_;
  struct Sudden {
    std::size_t list, law;
    int place;
  };
  std::vector<Sudden> sudden_; ///< what parts as its load begins, at the event found last
};

} // namespace hydrodae::run
