#pragma once
/// Generalised alpha on the Lie group of the poses, stabilised index 2, fixed step (Bruels, Cardona
/// and Arnold, Mech. Mach. Theory 48 (2012) 121; Arnold, Bruels and Cardona, Numer. Math. 129
/// (2015) 149): a known cost per step, for real time and co-simulation.

#include "hydrodae/integrate/integrator.h"

namespace hydrodae::integrate {

std::unique_ptr<Integrator> make_generalized_alpha(const system::Regime& system,
                                                   const system::Pattern& pattern,
                                                   const SolverOptions& options, double t0,
                                                   const VectorX& y, const VectorX& yp);

} // namespace hydrodae::integrate
