#pragma once
/// How fast the equations are against the motion: this decides whether steps of an explicit method
/// would follow the accuracy asked for, or the stability of what hardly moves.

#include "hydrodae/system/jacobian.h"

namespace hydrodae::integrate {

/// Fastest rate of the equations of motion at (t, y): the spectral radius of
/// d(q', u', z') / d(q, u, z), reactions eliminated [1/s], within some ten per cent; INFINITY where
/// there are no accelerations. By a power iteration on differences, a dozen evaluations.
double fastest_rate(const system::Regime& system, const system::Pattern& pattern, double t,
                    const VectorX& y, const VectorX& yp);

/// Rate at which the bodies move: by how much of its lever, or how many radians, the fastest of
/// them goes in a second, and no less than by its time scale [1/s].
double motion_rate(const system::Regime& system, const VectorX& y);

} // namespace hydrodae::integrate
