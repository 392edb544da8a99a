#pragma once
/// Comparison of the memory fit of a run with the tables of its database, at the wave frequencies.

#include <vector>

#include "hydrodae/sanity/sanity.h"

namespace hydrodae::statics {

/// Findings on waves in which the fit changes the motion: outside its band, or badly fitted.
///
/// A fit is made for a band of frequencies, the tables hold more. The equations are linearised
/// about the start, once with H = B + iw (A - A_inf) of the tables and once with that of the fit.
/// Both are solved for the forces of each wave system, at the table frequencies nearest to its
/// components. The finding is the rms difference of the coordinate that differs most, relative to
/// its rms. More than 1 % is reported, more than 10 % serious. Scenes without an exponential fit,
/// with pose tables, or with more than 300 coordinates are not judged.
std::vector<sanity::Finding> look_at_fit(const model::Scene& scene, const system::System& system);

} // namespace hydrodae::statics
