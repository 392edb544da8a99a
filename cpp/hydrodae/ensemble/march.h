#pragma once
/// Runs of one scene in several seas, marched side by side with common steps.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/ensemble/measured.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/simulation.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::ensemble {

/// A scene at its start: system, regime and consistent rates.
struct Start {
  /// Throws ModelError or SolverError when the scene cannot start.
  /// @param like  start whose pattern serves if the equations are alike; null: none
  explicit Start(const model::Scene& scene, const Start* like = nullptr);
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;

  const model::Scene& scene;
  system::System system;
  system::Regime regime;
  std::shared_ptr<const system::Pattern> pattern;
  VectorX y, yp;
};

/// Reason why a run must be made alone; empty: it can join a march.
std::string alone_because(const Start& start);

/// Difference that prevents a common march of two scenes; empty: none.
std::string apart_because(const Start& one, const Start& other);

/// The outcome of one lane.
struct Outcome {
  std::optional<RunStatistics> statistics; ///< absent: the run has left the march
  std::string left;                        ///< why, with the time
  std::vector<Measured> measured;          ///< of each signal; none of a run that has left
};

/// Marches at most `width` runs from 0 to their common end by the Runge-Kutta method of order 8
/// (Dormand and Prince), whose local error is tested in each lane. Powers are summed by the stages
/// of the method, no samples are kept.
/// @param wanted signals that the lanes know (`unknown_because`, probes.h)
std::vector<Outcome> march(const std::vector<std::unique_ptr<Start>>& starts,
                           const std::vector<Wanted>& wanted);

} // namespace hydrodae::ensemble
