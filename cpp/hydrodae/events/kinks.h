#pragma once
/// Kinks of laws: where a rope goes taut or slack, a compliant stop is touched, a limit holds.
/// Until the event a law stays what it is on its side, continued beyond the kink, so that a step
/// that tries to cross sees smooth equations; then the step is cut there. The error test of a
/// method, and its order, hold on both sides.

#include <memory>
#include <vector>

#include "hydrodae/events/law_view.h"
#include "hydrodae/events/source.h"

namespace hydrodae::events {

/// One margin for each kink: its number on the side on which it is.
class Kinks : public Source {
public:
  /// Makes the kinks of the system; null: no law has any.
  static std::unique_ptr<Kinks> make(system::Regime& regime, const VectorX& y);

  std::size_t count() const override { return state_.side.size(); }
  void margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) override;

  /// Puts each law on the side of its kink that its number has, at an event at t [s].
  void settle(double t, const VectorX& y);

  /// Takes the end of a step without event: laws that were on the kink may have left it.
  void accept(double t, const VectorX& y);

  struct State {
    std::vector<double> side; ///< 1, -1; 0: on the kink so far
  };
  const State& state() const { return state_; }
  void set(State state);

private:
  using View = LawView<element::Elements>;
  explicit Kinks(system::Regime& regime);
  void look(double t, const VectorX& y, double* out);
  void write();

  system::Regime& s_;
  View view_;
  State state_;
  std::vector<double> now_, room_;
};

} // namespace hydrodae::events
