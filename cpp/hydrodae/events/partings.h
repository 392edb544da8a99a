#pragma once
/// Events at which ropes and lines part inside a step, and the laws afterwards.

#include <memory>
#include <vector>

#include "hydrodae/element/parting.h"
#include "hydrodae/events/law_view.h"
#include "hydrodae/events/source.h"

namespace hydrodae::events {

/// One margin for each law: the part of its breaking load that is left.
class Partings : public Source {
public:
  /// Makes the partings of the system; null: nothing parts. Throws ModelError if a rope or line is
  /// overloaded at the start, y.
  static std::unique_ptr<Partings> make(system::Regime& regime, const VectorX& y);

  std::size_t count() const override { return n_; }
  void margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) override;

  /// What parts as its load begins, a damper's, does so just before, so that nothing of that load
  /// is in the step.
  double found(const Root& root, const Interpolant& at) override;

  /// Parts the laws that have reached their breaking load at an event at t [s].
  void part(double t, const VectorX& y);

private:
  using View = LawView<element::Parting>;
  explicit Partings(system::Regime& regime)
      : s_(regime), view_(regime, &element::Parting::may_part), n_(view_.size()) {}
  template <class Visit> void visit(double t, const VectorX& y, Visit&& act);

  system::Regime& s_;
  View view_;
  std::size_t n_; ///< number of laws
  struct Sudden {
    std::size_t law;
    int place;
  };
  std::vector<Sudden> sudden_; ///< laws that part when their load begins, at the event found last
};

} // namespace hydrodae::events
