#pragma once
/// Many runs at once: those that can share a march do (march.h).

#include <string>
#include <vector>

#include "hydrodae/ensemble/measured.h"
#include "hydrodae/io/results_file.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::ensemble {

/// The outcome of one scene.
struct Answer {
  io::Attributes attributes;      ///< those of a results file (session/output.h)
  std::string alone;              ///< why the scene has to be run by itself; empty: the others hold
  std::vector<Measured> measured; ///< of each signal
};

/// Runs the scenes in groups of at most `width` that can be marched side by side, in their order.
/// A scene that cannot start is left to a run by itself, which says why.
/// @param wanted signals that are measured in each run
std::vector<Answer> simulate_together(const std::vector<const model::Scene*>& scenes,
                                      const std::vector<Wanted>& wanted = {});

} // namespace hydrodae::ensemble
