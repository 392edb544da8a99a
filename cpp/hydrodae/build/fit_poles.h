#pragma once
/// The poles of a memory fit, by the coordinates that drive or feel them.

#include <complex>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/definite.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::build {

/// A pole as a coordinate sees it: its entries of B and C, over sqrt(mass).
struct Term {
  Index pole = 0;
  std::complex<double> input = 0.0, output = 0.0;
};

/// Coordinates that feel each other through the memory, and its poles.
struct Poles {
  std::vector<Index> coordinates;
  Eigen::VectorXcd poles;
  std::vector<std::vector<Term>> terms; ///< of each coordinate, by poles
};

/// The sets of coordinates that a block joins: all that it loads and that drive it.
std::vector<Poles> coupled_poles(const system::HydroData& h, const VectorX& root_mass);

/// From far below the slowest to far above the fastest pole, and near each of them.
std::vector<double> pole_frequencies(const Poles& p, std::size_t most);

/// Places of the lower triangle whose coordinates have a pole in common, by columns.
std::vector<Definite::Place> coupled_places(const Poles& p);

/// A number that no eigenvalue of the Hermitian part is below, at any frequency. A residue C_k B_k
/// = g B_k^H B_k + e_k B_k with g >= 0 damps by its first part, and its second part has a norm of
/// |e_k| |B_k| / |iw - p_k| <= |e_k| |B_k| / |Re p_k|.
double least_by_residues(const Poles& p);

} // namespace hydrodae::build
