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

/// Damping of a rung, as it is checked.
struct Judged {
  std::string what = {}; ///< name of the damping in messages
  /// Largest negative damping, as part of the largest damping
  double allowed = 0.0;
  /// Damping of each set of coordinates that the radiation couples, directly or through others;
  /// other coordinates do not affect its eigenvalues.
  std::vector<Damping> sets = {};
  /// (n_moving,) damping of each coordinate on itself, largest over the table; empty: that of
  /// `sets`
  VectorX largest = {};
};

// @param root_mass  sqrt of mass and added mass of each coordinate (n_moving,)

/// Nothing to check.
inline Judged damping_of(const water::RadiationLaw&, const VectorX&) { return {}; }

/// Damping Re H of the memory fit, from far below the slowest to far above the fastest pole. Throws
/// ModelError for a pole that does not decay.
Judged damping_of(const water::ExponentialRadiation& rung, const VectorX& root_mass);

/// Damping B of constant radiation.
Judged damping_of(const water::ConstantRadiation& rung, const VectorX& root_mass);

/// Damping int_0^T K cos(w t) dt of the kernel.
Judged damping_of(const water::Convolution& rung, const VectorX& root_mass);

} // namespace hydrodae::build
