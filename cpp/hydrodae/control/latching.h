#pragma once
#include <cmath>
#include <functional>
#include <utility>

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

struct LatchingState {
  enum class Phase { ready, held, released };
  Phase phase = Phase::ready;
  double until = INFINITY; ///< end of this phase [s]
};

/// Latching (Budal, Falnes 1980): holds a joint from a standstill for some time, then releases it.
/// The output is the largest load of the joint's dry friction: the kernel locates the standstill,
/// and the joint sticks exactly there.
///
///   ready:    friction holds up to `load`; once the joint sticks: held
///   held:     for `time`, then the friction load is zero
///   released: for `rest`, then ready
///
/// The kernel reports whether the joint sticks; the rate cannot, because a creeping joint may stick
/// when the friction becomes ready, without an event.
class LatchingLaw final : public StatefulLaw<LatchingState> {
public:
  /// @param time    duration of the hold [s]
  /// @param rest    time from the release until the next hold may begin [s]
  /// @param sticks  returns whether the joint sticks now
  LatchingLaw(double load, double time, double rest, std::function<bool()> sticks)
      : load_(load), time_(time), rest_(rest), sticks_(std::move(sticks)) {}

  void sample(double t, std::span<const double>, std::span<double> out) override {
    if (is_due())
      go(Phase::held, t + time_);
    else if (state_.phase == Phase::held && t >= state_.until)
      go(Phase::released, t + rest_);
    else if (state_.phase == Phase::released && t >= state_.until)
      go(Phase::ready, INFINITY);
    out[0] = state_.phase == Phase::released ? 0.0 : load_;
  }

  bool is_due() const override { return state_.phase == Phase::ready && sticks_(); }
  double next_time(double) const override { return state_.until; }

private:
  using Phase = LatchingState::Phase;

  void go(Phase phase, double until) {
    state_.phase = phase;
    state_.until = until;
  }

  double load_, time_, rest_;
  std::function<bool()> sticks_;
};

struct Latching : Sampled {
  static constexpr std::string_view type = "latching";
  static constexpr std::string_view doc =
      "Holds a joint by its dry friction from a standstill on, for some time.";
  static constexpr Arity arity = {1, 1, 1, "the rate of a joint"};
  double hold_time = 0.0, hold_load = 0.0;

  /// The friction whose largest load it writes must be on the joint whose rate it reads.
  std::unique_ptr<Law> law(const Place& place) const {
    if (!place.friction)
      refuse("outputs", outputs.front(),
             "the 'static' of a dry_friction, by which a latch holds: \"forces/NAME/static\"");
    if (signal_of(inputs.front()).name != place.friction->rate)
      refuse("inputs", inputs.front(),
             "the rate of the joint that it holds, " + in_quotes(place.friction->rate));
    return std::make_unique<LatchingLaw>(hold_load, hold_time, period, place.friction->sticks);
  }
  static std::optional<Fault> fault(const Terminals& t) { return si_fault(t, std::string(type)); }

  template <class C = Latching> static Fields<C> fields() {
    return sampled_fields<C>() +
           Fields<C>{
               {"hold_time", &C::hold_time, "s", "How long it holds from the standstill on.", true,
                more_than(0)},
               {"hold_load", &C::hold_load, "N or N m", "Largest load that it holds.", true,
                more_than(0)},
           };
  }

private:
  [[noreturn]] void refuse(const char* key, const std::string& wrong,
                           const std::string& expected) const {
    throw ModelError("controller." + name + "." + key, "controller " + in_quotes(name) + ": " +
                                                           in_quotes(wrong) + " is not " +
                                                           expected);
  }
};

} // namespace hydrodae::control
