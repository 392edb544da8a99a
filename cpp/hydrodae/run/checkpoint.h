#pragma once
/// Checkpoint beside the results file, from which another process continues the run.

#include <optional>
#include <string>

#include "hydrodae/model/scene.h"
#include "hydrodae/run/state.h"

namespace hydrodae::run {

struct Checkpoint {
  State state;
  std::string output; ///< bytes: further state of the results writer
  /// State of the second run, which estimates the error, while it continues
  std::optional<State> second;
  std::string comparison; ///< bytes: comparison of the two runs so far
  long next = 0;          ///< next sample of the second run
  std::string verify;     ///< method of the second run, as requested
  std::string stopped;    ///< reason why the run stopped before its end
};

/// "X.checkpoint.h5" for "X.h5".
std::string checkpoint_name(const std::string& results);

/// Replaces the checkpoint of a results file atomically. Throws SolverError if it cannot be
/// written.
void write_checkpoint(const std::string& results, const model::Scene& scene,
                      const Checkpoint& checkpoint);

/// Throws CaseError if the file is missing, or belongs to another case, database or version.
Checkpoint read_checkpoint(const std::string& results, const model::Scene& scene);

/// Throws CaseError if a file of another kind has the name of the checkpoint.
void require_checkpoint_place(const std::string& results);

/// Removes the checkpoint if it exists.
void remove_checkpoint(const std::string& results);

} // namespace hydrodae::run
