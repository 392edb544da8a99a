#pragma once
/// Forces in balance and closed rows: the equations of the static pose.

#include "hydrodae/statics/equilibrium.h"

namespace hydrodae::statics {

constexpr double balanced = 1e-10; ///< error that counts as zero, in units of weights and lengths

/// Solves f(q) + G^T lambda = 0, g(q) = 0 from y; on return y has the pose and the reactions.
/// Newton's method is used, with the smallest motion where nothing holds a body. If it fails, it
/// creeps from the same start as through a viscous fluid,
///
///   D q' = f(q) + G^T lambda,   g(q) = 0     D: a weight over a length for each coordinate
///
/// in implicit Euler steps that grow from one length scale to Newton's step (pseudo-transient
/// continuation: Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998) 508). This path ends in stable
/// poses, even if lines go from slack to taut on it. Throws ModelError if both fail.
LinearMatrices balance(const system::Regime& system, VectorX& y);

} // namespace hydrodae::statics
