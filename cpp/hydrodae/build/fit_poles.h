#pragma once
/// Poles of a memory fit, with the coordinates that drive or load them.

#include <complex>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/definite.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::build {

/// Part of a pole in a coordinate: its entries of B and C, over sqrt(mass).
struct Term {
  Index pole = 0;
  std::complex<double> input = 0.0, output = 0.0;
};

/// Coordinates coupled by the memory, and its poles.
struct Poles {
  std::vector<Index> coordinates;
  Eigen::VectorXcd poles;
  std::vector<std::vector<Term>> terms; ///< terms of each coordinate, by poles
};

/// Sets of coordinates joined by a block: those that it loads and those that drive it.
std::vector<Poles> coupled_poles(const water::ExponentialRadiation& rung, const VectorX& root_mass);

/// Frequencies from far below the slowest to far above the fastest pole, and near each pole.
std::vector<double> pole_frequencies(const Poles& p, std::size_t most);

/// Places in the lower triangle of coordinates with a common pole, by columns.
std::vector<Definite::Place> coupled_places(const Poles& p);

/// Lower bound of the eigenvalues of the Hermitian part at all frequencies. The first part of a
/// residue C_k B_k = g B_k^H B_k + e_k B_k with g >= 0 dissipates; its second part has a norm of
/// |e_k| |B_k| / |iw - p_k| <= |e_k| |B_k| / |Re p_k|.
double least_by_residues(const Poles& p);

} // namespace hydrodae::build
