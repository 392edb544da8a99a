#pragma once
/// Fastest rate of the equations relative to the motion: it decides whether accuracy or stability
/// would limit the steps of an explicit method.

#include "hydrodae/system/jacobian.h"

namespace hydrodae::integrate {

/// Fastest rate of the equations of motion at (t, y) [1/s]: spectral radius of d(q', u', z') / d(q,
/// u, z) with the reactions eliminated, within about ten per cent; INFINITY if there are no
/// accelerations. A power iteration on differences takes a dozen evaluations.
double fastest_rate(const system::Regime& system, const system::Pattern& pattern, double t,
                    const VectorX& y, const VectorX& yp);

/// Rate at which the bodies move [1/s]: levers or radians per second of the fastest body, at least
/// one over its time scale.
double motion_rate(const system::Regime& system, const VectorX& y);

} // namespace hydrodae::integrate
