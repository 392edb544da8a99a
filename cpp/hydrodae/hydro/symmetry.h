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
///   B_ii = k / (8 pi rho g c_g) int |F_i|^2 d heading. It needs `damping`. The mean over the
///   frequencies, weighted by B, may be off by 5 %: so far are fine meshes with irregular
///   frequencies. A square is off by its third harmonic, and by as much its forces are at 45
///   degrees: 15 % where its tables reach the peak of B.
///
/// Equal means within 1e-3 of the largest of each coordinate, or 1e-5 of the largest of its unit; a
/// force at the lever (A_inf / rho)^(1/3) counts as a moment. Images go on beyond the table only at
/// steps no wider than its widest, and no wider than 90 degrees. A full circle is left alone.
///
/// @returns the symmetry in words; empty: nothing was added
std::string add_images(Database& database);

} // namespace hydrodae::hydro
