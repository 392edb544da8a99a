#pragma once
#include <string>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::build {

/// Hermitian part of H(iw) of coordinates that feel each other, over their masses [1/s]. A row for
/// each frequency has the lower triangle row by row.
struct Damping {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Index> coordinates;
  std::vector<double> frequency; ///< [rad/s]
  Rows real;                     ///< symmetric part of Re H
  Rows imaginary;                ///< antisymmetric part of Im H; empty where it is not looked at
  Index size() const { return std::ssize(coordinates); }

  /// Of the entry (u, v) in a lower triangle.
  static Index place(Index u, Index v) { return u < v ? place(v, u) : u * (u + 1) / 2 + v; }
};

// One for each set of coordinates that the radiation couples, directly or through others: none of
// the others has a part in its eigenvalues.
// @param root_mass  sqrt of mass and added mass of each coordinate (n_moving,)

/// Re H of the memory fit, from far below the slowest to far above the fastest pole.
std::vector<Damping> damping_of_fit(const system::HydroData& h, const VectorX& root_mass);

/// B of the constant rung.
std::vector<Damping> damping_of_table(const system::HydroData& h, const VectorX& root_mass,
                                      double frequency);

/// int_0^T K cos(w t) dt.
std::vector<Damping> damping_of_kernel(const system::HydroData& h, const VectorX& root_mass);

} // namespace hydrodae::build
