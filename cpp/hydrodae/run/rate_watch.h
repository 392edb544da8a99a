#pragma once
/// Where rates of joints change their sign inside a step: events for controllers that hear them.

#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/archive.h"
#include "hydrodae/system/recorder.h"

namespace hydrodae::run {

/// A rate has crossed zero when it is beyond by a tiny part of the largest one so far, so that the
/// step that goes on from there does not find the same standstill again.
class RateWatch {
public:
  /// @param channel  of the rate: "joints/slide/displacement_rate"
  /// Throws CaseError where that is no rate of a joint.
  RateWatch(const system::Regime& regime, const std::string& channel);

  /// The first crossing in (t0, t1] of an accepted step, if any.
  /// @param nodes  parts of the step that may hold one crossing each
  std::optional<double> locate(double t0, double t1, int nodes,
                               const system::Recorder::Interpolant& at);

  /// At the end of an accepted step. @returns whether it ends in a crossing
  bool accept(double t, const VectorX& y, const VectorX& yp);

  void remember(Archive& a) { a(side_, fastest_); }

private:
  double rate(double t, const VectorX& y, const VectorX& yp);
  double beyond(double rate) const;

  const system::Regime& s_;
  int motion_;
  system::Workspace<double> ws_;
  VectorX y_, yp_;
  double side_ = 0.0;    ///< sign of the rate since the last crossing; 0: at rest so far
  double fastest_ = 0.0; ///< [m/s or rad/s]
};

} // namespace hydrodae::run
