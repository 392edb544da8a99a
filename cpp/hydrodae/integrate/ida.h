#pragma once
/// SUNDIALS IDA (variable-order BDF, Hindmarsh et al., ACM TOMS 31 (2005) 363) with KLU on
/// any formulation of the constraints.

#include "hydrodae/integrate/integrator.h"

namespace hydrodae::integrate {

/// Throws SolverError if SUNDIALS refuses.
std::unique_ptr<Integrator> make_ida(const system::Regime& system, const system::Pattern& pattern,
                                     const SolverOptions& options, double t0, const VectorX& y,
                                     const VectorX& yp);

} // namespace hydrodae::integrate
