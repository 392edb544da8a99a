#pragma once
#include <string>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/definite.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::build {

/// Hermitian part of H(iw) of coupled coordinates, over their masses [1/s]. Each row belongs to a
/// frequency.
struct Damping {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Index> coordinates;
  std::vector<double> frequency; ///< [rad/s]
  Rows diagonal;                 ///< damping of each coordinate on itself
  /// Nonzero places in the lower triangle, by columns; empty if the residues alone show that no
  /// eigenvalue is too small.
  std::vector<Definite::Place> places;
  Rows real;      ///< symmetric part of Re H at the places
  Rows imaginary; ///< antisymmetric part of Im H; empty if not needed
  Index size() const { return std::ssize(coordinates); }
};

// Damping of each set of coordinates that the radiation couples, directly or through others; other
// coordinates do not affect its eigenvalues.
// @param root_mass  sqrt of mass and added mass of each coordinate (n_moving,)

/// Damping Re H of the memory fit, from far below the slowest to far above the fastest pole.
/// @param allowed  size of negative eigenvalues, as part of the largest diagonal entry
std::vector<Damping> damping_of_fit(const system::HydroData& h, const VectorX& root_mass,
                                    double allowed);

/// Damping B of constant radiation.
std::vector<Damping> damping_of_table(const system::HydroData& h, const VectorX& root_mass,
                                      double frequency);

/// Damping int_0^T K cos(w t) dt of the kernel.
std::vector<Damping> damping_of_kernel(const system::HydroData& h, const VectorX& root_mass);

} // namespace hydrodae::build
