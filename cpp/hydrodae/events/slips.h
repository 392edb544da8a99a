#pragma once
/// Events at which ropes with friction begin or end to slip inside a step.

#include <memory>
#include <vector>

#include "hydrodae/element/rubbing.h"
#include "hydrodae/events/law_view.h"
#include "hydrodae/events/source.h"

namespace hydrodae::events {

class Slips : public Source {
public:
  /// Makes the slips of the system; null: no such friction.
  static std::unique_ptr<Slips> make(system::Regime& regime);

  std::size_t count() const override { return n_; }
  void margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) override;

  /// Lets stick and slip what does so at t [s]. Throws SolverError where that is not found.
  /// @returns whether anything has changed
  bool settle(double t, const VectorX& y);

private:
  using View = LawView<element::Rubbing>;
  explicit Slips(system::Regime& regime) : s_(regime), view_(regime, &element::Rubbing::may_rub) {
    for (const View::List& list : view_.lists())
      n_ += s_.elements[list.index].laws->size() * static_cast<std::size_t>(list.laws->n_rubs());
  }
  template <class Visit> void visit(double t, const VectorX& y, Visit&& act);

  system::Regime& s_;
  View view_;
  std::size_t n_ = 0; ///< number of margins
  std::vector<double> held_, room_, rubs_;
};

} // namespace hydrodae::events
