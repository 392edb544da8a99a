#pragma once
/// State of a run at an accepted instant, as a value: a copy saves it.

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

/// Progress of the run between its steps.
struct Course {
  double step_start = 0.0, last_start = 0.0; ///< starts of the last two steps [s]
  double event_near = INFINITY;              ///< event at which the next steps end [s]
  bool event_here = false;                   ///< true: the last step ended in an event
  int quadrature_nodes = 3;
  int highest_order = 1;      ///< highest order of the steps so far
  double control_since = 0.0; ///< time of the last action of controllers [s]
};

struct State {
  double time = 0.0; ///< [s]
  VectorX y, yp;     ///< unknowns of the rows that hold, and their rates
  std::string scene; ///< fingerprint of the case
  system::Held held; ///< modes of the switches, inputs, signals, scales
  Course course;
  linalg::Statistics done; ///< statistics of all integrators so far
  MethodChoice::State methods;
  integrate::Memory method; ///< memory of the present method
  measure::Measure::State measure;
  system::MotionScale::State scales;
  std::optional<system::History::State> history;
  std::optional<events::Switching::State> switching;
  events::Kinks::State kinks;
  GuardStates guards;
  Controllers::State controllers;

  /// State as bytes, for this kind of machine. `from_bytes` throws Error for other bytes.
  std::string bytes() const;
  static State from_bytes(const std::string& bytes);

  bool operator==(const State& other) const { return to_bytes(*this) == to_bytes(other); }
};
static_assert(std::is_aggregate_v<State> && std::is_copy_constructible_v<State>);

/// Bytes with a head and a digest, which identify them.
std::string sealed(const std::string& bytes);

/// Bytes without head and digest. Throws Error if these do not match.
std::string unsealed(const std::string& bytes);

} // namespace hydrodae::run
