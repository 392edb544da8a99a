#pragma once
/// A few waves that stand for many: interpolation over the wavenumber.
///
/// Waves of one direction b add a_j e^{k_j c}, c = s - i (x cos b + y sin b), complex a_j. At any
/// point, e^{kc} is a smooth function of k, so that with Chebyshev's nodes k_m on [k_j] and
/// Lagrange's polynomials L_m
///
///   sum_j a_j e^{k_j c} = sum_m b_m e^{k_m c},   b_m = sum_j L_m(k_j) a_j
///
/// up to 2 (h |c| / 2)^M / M! e^{2 h |c|} of |a_j e^{k_j c}| for M nodes and half the range h of k.
/// About 20 nodes stand for hundreds of waves to 1e-13; derivatives of the right side by the place
/// are those of what is evaluated.

#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::hull {

/// eta = amplitude cos(omega t - wavenumber (x cos heading + y sin heading) + phase)
struct Wave {
  double omega = 0.0;      ///< [rad/s], > 0
  double wavenumber = 0.0; ///< [rad/m], > 0
  double heading = 0.0;    ///< direction of travel [rad]
  double amplitude = 0.0;  ///< [m]
  double phase = 0.0;      ///< [rad]
};

struct Node {
  double k, kx, ky; ///< wavenumber and its parts along x and y [rad/m]
};

/// Band of waves: waves first_wave .. + waves of a list, and the nodes first_node .. + nodes that
/// represent them.
struct Band {
  int first_wave, waves, first_node, nodes;
  MatrixX weights; ///< (waves, nodes): L_m(k_j); empty: the waves are the nodes
};

struct WaveNodes {
  std::vector<Wave> waves; ///< in the order of the bands
  std::vector<Band> bands;
  std::vector<Node> nodes;
};

/// @param reach largest |c| at which the sums are taken [m]
WaveNodes make_nodes(const std::vector<Wave>& waves, double reach);

} // namespace hydrodae::hull
