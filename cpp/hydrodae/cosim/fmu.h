#pragma once
/// Controllers of a case that are FMUs for co-simulation.

#include "hydrodae/control/law.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::cosim {

/// Gives each controller of type "fmu" its law, which unpacks and loads the FMU as soon as a run is
/// made. There ModelError is thrown for an FMU that cannot be used; whatever goes wrong from the
/// first sampling instant on ends the run with one SolverError.
void join_fmus(model::Scene& scene);

/// Checks an FMU as `join_fmus` does, without loading any library. Throws ModelError.
/// @param terminals  what its inputs and outputs are joined to
/// @returns which of its variables are in other units than these, in words
std::vector<std::string> check_fmu(const control::Fmu& controller,
                                   const control::Terminals& terminals);

/// Throws CaseError where an FMU cannot save its state, so that a run has no checkpoints.
void require_fmu_states(const model::Scene& scene);

} // namespace hydrodae::cosim
