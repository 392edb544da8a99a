#pragma once
/// Headings that a database lacks, by the symmetry of what is in the water.

#include <string>

#include "hydrodae/hydro/database.h"

namespace hydrodae::hydro {

/// Adds to the tables of the excitation the headings that follow from those there by a symmetry of
/// the bodies about planes or the axis through the origin, as far as the tables show it:
///
/// - a plane y = 0 or x = 0: A_inf is that of the mirror image, and so are the forces of all
///   headings whose images stand in the table, one at least (a heading in the plane is its own);
/// - revolution about z: the same for a quarter turn and A_inf, the forces of all headings are one
///   force turned, and this one radiates, by the relation of Haskind,
///   B_ii = k / (8 pi rho g c_g) int |F_i|^2 d heading, at all frequencies. It needs `damping`.
///
/// Equal means within 1e-3 of the largest of each coordinate (2e-2 of B), or 1e-5 of the largest of
/// its unit. Images go on beyond the table only at steps no wider than its widest, and no wider
/// than 90 degrees. A full circle is left alone.
///
/// @returns the symmetry in words; empty: nothing was added
std::string add_images(Database& database);

} // namespace hydrodae::hydro
