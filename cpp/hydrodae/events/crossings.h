#pragma once
/// Zero crossings of joint rates inside a step: events for controllers.

#include <string>
#include <vector>

#include "hydrodae/events/source.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::events {

/// A rate has crossed zero when it is beyond by a tiny part of the largest one so far, so that the
/// step that goes on from there does not find the same standstill again.
class Crossing : public Source {
public:
  /// @param channel  channel of the rate: "joints/slide/displacement_rate"
  /// Throws CaseError if that is no rate of a joint.
  Crossing(const system::Regime& regime, const std::string& channel);

  std::size_t count() const override { return 1; }
  void margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) override {
    out[0] = left(rate(t, y, yp));
  }

  /// Takes the end of an accepted step. @returns whether it ends in a crossing
  bool accept(double t, const VectorX& y, const VectorX& yp);

  struct State {
    double side = 0.0;    ///< sign of the rate since the last crossing; 0: at rest so far
    double fastest = 0.0; ///< largest rate so far [m/s or rad/s]
  };
  const State& state() const { return state_; }
  void set(const State& state) { state_ = state; }

private:
  double rate(double t, const VectorX& y, const VectorX& yp);
  double left(double rate) const;

  const system::Regime& s_;
  int motion_;
  system::Workspace<double> ws_;
  State state_;
};

} // namespace hydrodae::events
