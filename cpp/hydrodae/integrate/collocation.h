#pragma once
/// Implicit Runge-Kutta methods (Radau IIA, Gauss, Lobatto IIIC) on F(t, y, y') = 0 after Hairer
/// and Wanner, Solving ODEs II (1996), sections IV.8 and VII, and J. Comput. Appl. Math. 111
/// (1999) 93.

#include "hydrodae/integrate/integrator.h"

namespace hydrodae::integrate {

std::unique_ptr<Integrator> make_radau(const system::Regime& system, const system::Pattern& pattern,
                                       const SolverOptions& options, double t0, const VectorX& y,
                                       const VectorX& yp);
std::unique_ptr<Integrator> make_gauss(const system::Regime& system, const system::Pattern& pattern,
                                       const SolverOptions& options, double t0, const VectorX& y,
                                       const VectorX& yp);
std::unique_ptr<Integrator> make_lobatto_iiic(const system::Regime& system,
                                              const system::Pattern& pattern,
                                              const SolverOptions& options, double t0,
                                              const VectorX& y, const VectorX& yp);

} // namespace hydrodae::integrate
