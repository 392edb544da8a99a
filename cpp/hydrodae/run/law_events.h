#pragma once
/// Events of forces that change what they do: they part, or stick and slip.

#include <memory>
#include <optional>

#include "hydrodae/run/parting_watch.h"
#include "hydrodae/run/rubbing_watch.h"

namespace hydrodae::run {

class LawEvents {
public:
  /// Null: nothing in the system does so. Throws ModelError as PartingWatch.
  static std::unique_ptr<LawEvents> make(system::Regime& regime, const VectorX& y);

  /// The first one in (t0, t1] of an accepted step, if any.
  std::optional<double> locate(double t0, double t1, int nodes,
                               const system::Recorder::Interpolant& at);

  /// At an event at t [s]: lets part what does so.
  void part(double t, const VectorX& y);

  /// Lets stick and slip what does so at t [s].
  /// @returns whether anything has changed
  bool settle(double t, const VectorX& y);

  void remember(Archive& a);

private:
  std::unique_ptr<PartingWatch> partings_; ///< null: nothing may part
  std::unique_ptr<RubbingWatch> rubs_;     ///< null: nothing sticks and slips
};

} // namespace hydrodae::run
