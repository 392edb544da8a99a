#pragma once
/// Many runs at once: those that can share a march do (march.h).

#include <string>
#include <vector>

#include "hydrodae/io/results_file.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::ensemble {

/// The outcome of one scene.
struct Answer {
  io::Attributes attributes; ///< attributes as in a results file (session/output.h)
  /// Reason why the scene must be run alone; empty: `attributes` are valid
  std::string alone;
};

/// Runs the scenes in groups of at most `width` that can be marched side by side, in their order.
/// A scene that cannot start is left to a run by itself, which says why.
std::vector<Answer> simulate_together(const std::vector<const model::Scene*>& scenes);

} // namespace hydrodae::ensemble
