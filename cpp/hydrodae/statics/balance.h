#pragma once
/// Forces in balance and closed rows: the equations of the static pose.

#include "hydrodae/statics/equilibrium.h"

namespace hydrodae::statics {

constexpr double balanced = 1e-10; ///< of weights and lengths: what counts as zero

/// From y to f(q) + G^T lambda = 0, g(q) = 0; y at the end, with the reactions. Newton's method,
/// with the smallest motion where nothing holds a body; where that fails, from the same start along
/// the way that the scene would creep through a viscous fluid,
///
///   D q' = f(q) + G^T lambda,   g(q) = 0     D: a weight over a length for each coordinate
///
/// in implicit Euler steps that grow from one length scale to Newton's step (pseudo-transient
/// continuation: Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998) 508). That way ends in stable
/// poses, however lines go from slack to taut on it. Throws ModelError when neither gets there.
LinearMatrices balance(const system::Regime& system, VectorX& y);

} // namespace hydrodae::statics
