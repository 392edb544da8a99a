#pragma once
#include <cmath>
#include <functional>
#include <utility>

#include "hydrodae/control/law.h"

namespace hydrodae::control {

/// Latching (Budal, Falnes 1980): holds a joint from a standstill on for some time, then lets it
/// go. What it writes is the largest load that the dry friction of the joint holds: the kernel
/// locates the standstill, and the joint sticks there exactly.
///
///   ready:    friction holds up to `load`; where the joint sticks: held
///   held:     for `time`, then the friction holds nothing
///   released: for `rest`, then ready
///
/// Whether it sticks is asked of the kernel, not judged by the rate: a joint that creeps may be
/// caught by the very act of getting ready, without an event of its own.
class Latching final : public Law {
public:
  /// @param time    for which it holds [s]
  /// @param rest    from the release until it may hold again [s]
  /// @param sticks  does the joint stick now?
  Latching(double load, double time, double rest, std::function<bool()> sticks)
      : load_(load), time_(time), rest_(rest), sticks_(std::move(sticks)) {}

  void sample(double t, std::span<const double>, std::span<double> out) override {
    if (is_due())
      go(Phase::held, t + time_);
    else if (phase_ == Phase::held && t >= until_)
      go(Phase::released, t + rest_);
    else if (phase_ == Phase::released && t >= until_)
      go(Phase::ready, INFINITY);
    out[0] = phase_ == Phase::released ? 0.0 : load_;
  }

  bool is_due() const override { return phase_ == Phase::ready && sticks_(); }
  double next_time(double) const override { return until_; }
  void remember(Archive& a) override { a(phase_, until_); }

private:
  enum class Phase { ready, held, released };

  void go(Phase phase, double until) {
    phase_ = phase;
    until_ = until;
  }

  double load_, time_, rest_;
  std::function<bool()> sticks_;
  Phase phase_ = Phase::ready;
  double until_ = INFINITY; ///< of this phase [s]
};

} // namespace hydrodae::control
