#pragma once
/// Why a run goes on with another method, as a value.

#include <string>

#include "hydrodae/core/archive.h"

namespace hydrodae::run {

/// The decision to leave a method for the next one of the order.
struct MethodChange {
  enum class Cause {
    cost,  ///< the next method has less work
    stop,  ///< the method can make no step
    guard, ///< a guard has refused a step of the method
  };
  Cause cause = Cause::cost;
  std::string method; ///< the one that is left
  double time = 0.0;  ///< [s]
  std::string reason; ///< what happened

  void remember(Archive& a);
};

/// "radau gave up: the step has become too short"; a decision on costs by its reason alone.
std::string in_words(const MethodChange& change);

/// "radau at t = 1.5 s: the step has become too short"
std::string with_time(const MethodChange& change);

} // namespace hydrodae::run
