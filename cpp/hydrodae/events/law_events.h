#pragma once
/// Events of forces that change what they do: they part, stick and slip, or pass a kink.

#include <memory>
#include <vector>

#include "hydrodae/events/kinks.h"
#include "hydrodae/events/partings.h"
#include "hydrodae/events/slips.h"

namespace hydrodae::events {

class LawEvents {
public:
  /// Throws ModelError as Partings.
  LawEvents(system::Regime& regime, const VectorX& y);

  /// Existing event sources.
  std::vector<Source*> sources() const;

  /// Takes the end of a step without event.
  void accept(double t, const VectorX& y);

  /// Parts the laws whose event is at t [s].
  void part(double t, const VectorX& y);

  /// Lets stick and slip what does so at t [s], and takes sides at kinks.
  /// @returns whether anything sticks or slips that did not
  bool settle(double t, const VectorX& y);

  /// State without the signals of the laws, which the regime holds.
  Kinks::State state() const { return kinks_ ? kinks_->state() : Kinks::State{}; }
  void set(Kinks::State state);

private:
  // Null if absent.
  std::unique_ptr<Partings> partings_;
  std::unique_ptr<Slips> slips_;
  std::unique_ptr<Kinks> kinks_;
};

} // namespace hydrodae::events
