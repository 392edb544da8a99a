#pragma once
#include <string>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/definite.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::build {

/// Hermitian part of H(iw) of coordinates that feel each other, over their masses [1/s]. Each row
/// belongs to a frequency.
struct Damping {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Index> coordinates;
  std::vector<double> frequency; ///< [rad/s]
  Rows diagonal;                 ///< of each coordinate on itself
  /// Entries of the lower triangle that may differ from zero, by columns; empty if the residues
  /// alone show that no eigenvalue is too small.
  std::vector<Definite::Place> places;
  Rows real;      ///< symmetric part of Re H at the places
  Rows imaginary; ///< antisymmetric part of Im H; empty where it is not looked at
  Index size() const { return std::ssize(coordinates); }
};

// One for each set of coordinates that the radiation couples, directly or through others: none of
// the others has a part in its eigenvalues.
// @param root_mass  sqrt of mass and added mass of each coordinate (n_moving,)

/// Re H of the memory fit, from far below the slowest to far above the fastest pole.
/// @param allowed  part of the largest entry of a diagonal, by which eigenvalues may be negative
std::vector<Damping> damping_of_fit(const system::HydroData& h, const VectorX& root_mass,
                                    double allowed);

/// B of the constant rung.
std::vector<Damping> damping_of_table(const system::HydroData& h, const VectorX& root_mass,
                                      double frequency);

/// int_0^T K cos(w t) dt.
std::vector<Damping> damping_of_kernel(const system::HydroData& h, const VectorX& root_mass);

} // namespace hydrodae::build
