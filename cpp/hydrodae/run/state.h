#pragma once
/// All that a run is at an accepted instant, as a value: copied is saved.

#include <optional>
#include <string>
#include <type_traits>

#include "hydrodae/core/archive.h"
#include "hydrodae/events/law_events.h"
#include "hydrodae/events/switching.h"
#include "hydrodae/integrate/memory.h"
#include "hydrodae/measure/measure.h"
#include "hydrodae/run/controllers.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/run/method_choice.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/motion_scale.h"

namespace hydrodae::run {

/// Where the run is between its steps.
struct Course {
  double step_start = 0.0, last_start = 0.0; ///< of the last two steps [s]
  double event_near = INFINITY;              ///< where the next steps end [s]
  bool event_here = false;                   ///< the last step has ended in an event
  int quadrature_nodes = 3;
  int highest_order = 1;      ///< of the steps so far
  double control_since = 0.0; ///< when controllers acted last [s]
};

struct State {
  double time = 0.0; ///< [s]
  VectorX y, yp;     ///< unknowns of the rows that hold, and their rates
  std::string scene; ///< of which case it is (fingerprint)
  system::Held held; ///< modes of the switches, inputs, signals, scales
  Course course;
  linalg::Statistics done; ///< what all integrators so far have done
  MethodChoice::State methods;
  integrate::Memory method; ///< of the one at work
  measure::Measure::State measure;
  system::MotionScale::State scales;
  std::optional<system::History::State> history;
  std::optional<events::Switching::State> switching;
  events::Kinks::State kinks;
  GuardStates guards;
  Controllers::State controllers;

  /// As bytes, of this kind of machine. `from_bytes` throws Error where they are no state.
  std::string bytes() const;
  static State from_bytes(const std::string& bytes);

  bool operator==(const State& other) const { return to_bytes(*this) == to_bytes(other); }
};
static_assert(std::is_aggregate_v<State> && std::is_copy_constructible_v<State>);

/// A value as bytes with a head and a digest, so that other bytes are not taken for it.
std::string sealed(const std::string& bytes);

/// The bytes that were sealed. Throws Error where they are not.
std::string unsealed(const std::string& bytes);

} // namespace hydrodae::run
