#pragma once
/// A scene as equations with a consistent start.

#include <memory>
#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::run {

/// An instant of a run.
struct Instant {
  double t = 0.0; ///< [s]
  VectorX y, yp;  ///< unknowns of the rows that hold, and their rates
};

/// The system never changes; what holds of it, and where its entries are, changes at events.
struct Problem {
  /// Throws ModelError or SolverError when the scene cannot start.
  explicit Problem(model::Scene given);
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  /// The start is found on the stabilised equations; then the formulation may change, and the past
  /// begins where the scene depends on it, which limits the steps.
  void begin(const Instant& start);

  /// Which scene this is: digest of text, overrides and version, then `model::text_of_files`.
  const std::string& fingerprint();

  /// Throws CaseError that names what differs from the scene of this fingerprint.
  void require_same(const std::string& other);

  model::Scene scene;
  SolverOptions options; ///< of the method at work; steps as a history carries them
  Instant start;
  system::Pattern pattern; ///< of the rows that hold
  const system::System system;
  system::Regime regime{system};            ///< what holds now
  std::unique_ptr<system::History> history; ///< where loads depend on the past
  std::vector<std::string> notes{system.notes};

private:
  struct Found;
  static Found find(const model::Scene& scene);
  Problem(Found found, model::Scene&& given);

  std::string fingerprint_; ///< empty: not asked for yet
};

} // namespace hydrodae::run
