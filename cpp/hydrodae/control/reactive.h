#pragma once
#include <algorithm>
#include <cmath>

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

/// Reactive control u = -K (s - s0) - C s' within +-limit.
class ReactiveLaw final : public Law {
public:
  ReactiveLaw(double stiffness, double damping, double neutral, double limit)
      : k_(stiffness), c_(damping), s0_(neutral), limit_(limit) {}

  /// @param in  s and s'
  void sample(double, std::span<const double> in, std::span<double> out) override {
    out[0] = std::clamp(-k_ * (in[0] - s0_) - c_ * in[1], -limit_, limit_);
  }

private:
  double k_, c_, s0_, limit_;
};

/// Resistive control u = -C s' within +-limit.
class ResistiveLaw final : public Law {
public:
  ResistiveLaw(double damping, double limit) : c_(damping), limit_(limit) {}

  /// @param in  s'
  void sample(double, std::span<const double> in, std::span<double> out) override {
    out[0] = std::clamp(-c_ * in[0], -limit_, limit_);
  }

private:
  double c_, limit_;
};

struct Reactive : Sampled {
  static constexpr std::string_view type = "reactive";
  static constexpr std::string_view doc = "u = -K (s - s0) - C s' of a coordinate and its rate.";
  static constexpr Arity arity = {2, 2, 1, "a coordinate and its rate"};
  double stiffness = 0.0, damping = 0.0, neutral = 0.0;
  std::optional<double> limit;

  std::unique_ptr<Law> law(const Place&) const {
    return std::make_unique<ReactiveLaw>(stiffness, damping, neutral, limit.value_or(INFINITY));
  }
  static std::optional<Fault> fault(const Terminals& t) {
    if (const std::optional<Fault> fault = rate_fault(t, std::string(type)))
      return fault;
    const std::string& rate = t.inputs[1].own_unit;
    if (t.inputs[0].own_unit + "/s" != rate)
      return Fault{"inputs", with_unit(t.inputs[0]) +
                                 "; a reactive controller takes the coordinate of the rate " +
                                 in_quotes(t.inputs[1].name) + " there, in " +
                                 in_quotes(rate.substr(0, rate.size() - 2))};
    return {};
  }

  template <class C = Reactive> static Fields<C> fields() {
    return usual_fields<C>() +
           Fields<C>{
               {"stiffness", &C::stiffness, "N/m or N m/rad",
                "Stiffness K; negative: it pushes away."},
               {"damping", &C::damping, "N s/m or N m s/rad", "Damping C."},
               {"neutral", &C::neutral, "m or rad", "Coordinate s0 at which the spring is slack."},
               {"limit", &C::limit, "N or N m", "Largest load, either way.", false, more_than(0)},
           };
  }
};

struct Resistive : Sampled {
  static constexpr std::string_view type = "resistive";
  static constexpr std::string_view doc = "u = -C s' of a rate.";
  static constexpr Arity arity = {1, 1, 1, "a rate"};
  double damping = 0.0;
  std::optional<double> limit;

  std::unique_ptr<Law> law(const Place&) const {
    return std::make_unique<ResistiveLaw>(damping, limit.value_or(INFINITY));
  }
  static std::optional<Fault> fault(const Terminals& t) { return rate_fault(t, std::string(type)); }

  template <class C = Resistive> static Fields<C> fields() {
    return usual_fields<C>() +
           Fields<C>{
               {"damping", &C::damping, "N s/m or N m s/rad", "Damping C."},
               {"limit", &C::limit, "N or N m", "Largest load, either way.", false, more_than(0)},
           };
  }
};

} // namespace hydrodae::control
