#pragma once
#include <algorithm>
#include <cmath>

#include "hydrodae/control/law.h"

namespace hydrodae::control {

/// Latching (Budal, Falnes 1980): holds a joint from a standstill on for some time, then lets it
/// go. What it writes is the largest load that the dry friction of the joint holds: the kernel
/// locates the standstill, and the joint sticks there exactly.
///
///   ready:    friction holds up to `load`; at a standstill (an event, or the start at rest): held
///   held:     for `time`, then the friction holds nothing
///   released: for `rest`, then ready
class Latching final : public Law {
public:
  /// @param time  for which it holds [s]
  /// @param rest  from the release until it may hold again [s]
  Latching(double load, double time, double rest) : load_(load), time_(time), rest_(rest) {}

  /// @param in  s'
  void sample(double t, std::span<const double> in, std::span<double> out) override {
    fastest_ = std::max(fastest_, std::abs(in[0]));
    if (phase_ == Phase::ready && std::abs(in[0]) <= standstill * fastest_)
      go(Phase::held, t + time_);
    else if (phase_ == Phase::held && t >= until_)
      go(Phase::released, t + rest_);
    else if (phase_ == Phase::released && t >= until_)
      go(Phase::ready, INFINITY);
    out[0] = phase_ == Phase::released ? 0.0 : load_;
  }

  bool hears_events() const override { return true; }
  double next_time(double) const override { return until_; }
  void remember(Archive& a) override { a(phase_, until_, fastest_); }

private:
  enum class Phase { ready, held, released };
  static constexpr double standstill = 1e-6; ///< of the largest rate so far

  void go(Phase phase, double until) {
    phase_ = phase;
    until_ = until;
  }

  double load_, time_, rest_;
  Phase phase_ = Phase::ready;
  double until_ = INFINITY; ///< of this phase [s]
  double fastest_ = 0.0;
};

} // namespace hydrodae::control
