#pragma once
/// Explicit Runge-Kutta on the accelerations, projected after every step onto both levels of the
/// constraints (Hairer and Wanner, Solving ODEs II (1996), section VII.2): the cheapest digits for
/// scenes without stiff springs, and at ease in singular poses.

#include "hydrodae/integrate/integrator.h"

namespace hydrodae::integrate {

std::unique_ptr<Integrator> make_explicit_rk(const system::Regime& system,
                                             const system::Pattern& pattern,
                                             const SolverOptions& options, double t0,
                                             const VectorX& y, const VectorX& yp);

} // namespace hydrodae::integrate
