#pragma once
/// Scene as equations with a consistent start.

#include <memory>
#include <string>
#include <vector>

#include "hydrodae/model/scene.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::run {

/// Instant of a run.
struct Instant {
  double t = 0.0; ///< [s]
  VectorX y, yp;  ///< unknowns of the rows that hold, and their rates
};

/// Equations of a scene. The system never changes; the regime, and the layout of its entries,
/// change at events.
struct Problem {
  /// Throws ModelError or SolverError if the scene cannot start.
  explicit Problem(model::Scene given);
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  /// Sets the formulation and begins the past, which limits the steps, from a start that was found
  /// on the stabilised equations.
  void begin(const Instant& start);

  /// Fingerprint of the scene: digest of text, overrides and version, then `model::text_of_files`.
  const std::string& fingerprint();

  /// Throws CaseError with the differences from the scene of this fingerprint.
  void require_same(const std::string& other);

  model::Scene scene;
  SolverOptions options; ///< options of the present method, with steps that the history allows
  Instant start;
  system::Pattern pattern; ///< pattern of the rows that hold
  const system::System system;
  system::Regime regime{system};            ///< rows and values that hold now
  std::unique_ptr<system::History> history; ///< past; null if no load depends on it
  std::vector<std::string> notes{system.notes};

private:
  struct Found;
  static Found find(const model::Scene& scene);
  Problem(Found found, model::Scene&& given);

  std::string fingerprint_; ///< fingerprint; empty: not computed yet
};

} // namespace hydrodae::run
