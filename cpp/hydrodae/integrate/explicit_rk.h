#pragma once
/// Explicit Runge-Kutta method on the accelerations, projected after every step onto both levels of
/// the constraints (Hairer and Wanner, Solving ODEs II (1996), section VII.2). It is the cheapest
/// method for scenes without stiff springs, and robust in singular poses.

#include "hydrodae/integrate/integrator.h"

namespace hydrodae::integrate {

std::unique_ptr<Integrator> make_explicit_rk(const system::Regime& system,
                                             const system::Pattern& pattern,
                                             const SolverOptions& options, double t0,
                                             const VectorX& y, const VectorX& yp);

} // namespace hydrodae::integrate
