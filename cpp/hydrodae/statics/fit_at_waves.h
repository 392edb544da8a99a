#pragma once
/// The memory fit of a run against the tables of its database, at the frequencies of the waves.

#include <vector>

#include "hydrodae/sanity/sanity.h"

namespace hydrodae::statics {

/// Findings on waves in which the fit changes the motion: outside its band, or badly fitted.
///
/// A fit is made for a band of frequencies, the tables hold more. The equations are linearised
/// about the start, once with H = B + iw (A - A_inf) of the tables and once with that of the fit.
/// Both are solved for the forces of each wave system, at the frequencies of the tables nearest to
/// its components. The finding is the rms difference of the coordinate that differs most, over its
/// rms. More than 1 % is reported, more than 10 % serious. Nothing is judged without an exponential
/// fit, with tables over poses, and beyond 300 coordinates.
std::vector<sanity::Finding> look_at_fit(const model::Scene& scene, const system::System& system);

} // namespace hydrodae::statics
