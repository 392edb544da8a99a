#pragma once
/// Controllers of a case that are other programs, over TCP/IP.

#include "hydrodae/model/scene.h"

namespace hydrodae::cosim {

/// Gives each controller of type "tcp" its law. A server listens as soon as a run is made, which
/// throws ModelError where it cannot; the other program is waited for at the first sampling
/// instant. Whatever goes wrong from there on ends the run with one SolverError.
void join_tcp(model::Scene& scene);

} // namespace hydrodae::cosim
