#pragma once
/// What a run leaves beside its results file, so that another process can go on from there.

#include <optional>
#include <string>

#include "hydrodae/model/scene.h"
#include "hydrodae/run/state.h"

namespace hydrodae::run {

struct Checkpoint {
  State state;
  std::string output;          ///< bytes: what the writer of the results needs besides
  std::optional<State> second; ///< of the run that the error is estimated by, while it goes on
  std::string comparison;      ///< bytes: what the two runs have been compared by so far
  long next = 0;               ///< sample of the second run
  std::string verify;          ///< its method, as it was asked for
  std::string stopped;         ///< why it did not reach its end
};

/// "X.checkpoint.h5" for "X.h5".
std::string checkpoint_name(const std::string& results);

/// Replaces the checkpoint of a results file in one step. Throws SolverError when it cannot be
/// written.
void write_checkpoint(const std::string& results, const model::Scene& scene,
                      const Checkpoint& checkpoint);

/// Throws CaseError where it is missing, or it is of another case, database or version.
Checkpoint read_checkpoint(const std::string& results, const model::Scene& scene);

/// Throws CaseError when another kind of file has the name of the checkpoint.
void require_checkpoint_place(const std::string& results);

/// Does nothing where it is missing.
void remove_checkpoint(const std::string& results);

} // namespace hydrodae::run
