#pragma once
#include <cmath>

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

struct DeclutchingState {
  bool began = false;
  double heard = -INFINITY, until = -INFINITY; ///< last standstill, end of the free time [s]
  double next = INFINITY;
};

/// Declutching (Babarit, Guglielmi, Clement, Ocean Engineering 36 (2009) 1015-1024): after each
/// standstill of a joint the machine is free for some time, then it works until the next one.
///
///   u = free        for `time` after a standstill
///       engaged     otherwise
///
/// The standstill, a change of sign of s', is an event that the kernel locates. A standstill within
/// `rest` of the last one is ignored.
class DeclutchingLaw final : public StatefulLaw<DeclutchingState> {
public:
  /// @param time  duration of the free phase [s]
  /// @param rest  time after a standstill during which others are ignored [s]
  DeclutchingLaw(double engaged, double free, double time, double rest)
      : engaged_(engaged), free_(free), time_(time), rest_(rest) {}

  void crossed(double t) override {
    if (t < state_.heard + rest_)
      return;
    state_.heard = t;
    state_.until = t + time_;
  }

  /// @param in  s'
  void sample(double t, std::span<const double> in, std::span<double> out) override {
    if (!state_.began && in[0] == 0.0)
      crossed(t);
    state_.began = true;
    out[0] = t < state_.until ? free_ : engaged_;
    state_.next = t < state_.until ? state_.until : INFINITY;
  }

  bool hears_events() const override { return true; }
  bool hears_crossings() const override { return true; }
  double next_time(double) const override { return state_.next; }

private:
  double engaged_, free_, time_, rest_;
};

struct Declutching : Sampled {
  static constexpr std::string_view type = "declutching";
  static constexpr std::string_view doc =
      "Frees a machine from each standstill of a joint on, for some time; else it works.";
  static constexpr Arity arity = {1, 1, 1, "the rate of a joint"};
  double engaged = 0.0, free = 0.0, free_time = 0.0;

  std::unique_ptr<Law> law(const Place&) const {
    return std::make_unique<DeclutchingLaw>(engaged, free, free_time, period);
  }

  template <class C = Declutching> static Fields<C> fields() {
    return sampled_fields<C>() + lag_field<C>() +
           Fields<C>{
               {"engaged", &C::engaged, "unit of the output", "Output while the machine works.",
                true},
               {"free", &C::free, "unit of the output", "Output while the machine is free."},
               {"free_time", &C::free_time, "s", "How long it is free from a standstill on.", true,
                more_than(0)},
           };
  }
};

} // namespace hydrodae::control
