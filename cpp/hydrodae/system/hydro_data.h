#pragma once
/// Added mass and radiation of all bodies in the water, for all radiation models.

#include <algorithm>
#include <string>
#include <vector>

#include "hydrodae/math/block_matrix.h"
#include "hydrodae/water/hydro_axes.h"
#include "hydrodae/water/pose_table.h"

namespace hydrodae::system {

using water::HydroAxes;
using water::HydroBody;

/// Radiation kernels as cubic B-splines on a uniform grid (math/bspline.h), one column for each
/// pair of coordinates that act on each other.
struct Convolution {
  struct Pair {
    int row = 0;    ///< row: entry of U; from n_moving on, entry of `locked`
    int column = 0; ///< column: entry of U
  };
  double step = 0.0, length = 0.0; ///< step of the grid, and length T, beyond which K = 0 [s]
  double frequency = 0.0;          ///< root mean square frequency of the kernels' spectra [rad/s]
  std::vector<Pair> pairs;         ///< pairs with a moving row first
  int n_moving_pairs = 0;
  std::vector<int> locked; ///< locked rows of the full loads (6 n_bodies)
  MatrixX splines;         ///< coefficients (n_grid + 2, n_pairs)
  bool empty() const { return pairs.empty(); }
};

/// Added mass at infinite frequency and radiation memory of all bodies.
///   loads along the coordinates of U: -(A_inf U)' - C z - B U,   z' = A_r z + B_r U
/// B is constant damping; A(w) of its frequency then replaces A_inf. The convolution replaces C z.
struct HydroData {
  HydroAxes axes = HydroAxes::mean;
  std::vector<HydroBody> bodies;
  struct Coordinate { ///< hydrodynamic body and component of an entry of U
    int hydro_body = 0, component = 0;
  };
  std::vector<Coordinate> coordinates; ///< (n_moving,)
  int n_moving = 0;                    ///< length of U
  MatrixX added_mass;                  ///< (n_moving, n_moving)
  MatrixX
      added_mass_all;  ///< (6 n_bodies, n_moving), also the loads on coordinates that do not move
  MatrixX output;      ///< C (n_moving, n_states)
  MatrixX output_all;  ///< (6 n_bodies, n_states)
  bool damped = false; ///< constant damping; otherwise the next two are empty
  MatrixX damping, damping_all;       ///< B (n_moving, n_moving), (6 n_bodies, n_moving)
  Convolution convolution;            ///< empty for the other radiation models
  std::vector<std::string> uncovered; ///< labels of rows whose load the fit omits
  Index z0 = 0;
  int n_states = 0;
  struct Block { ///< z' = a z + ..., or the pair (x + i y)' = (a + i b)(x + i y) + ...
    int state = 0;
    double a = 0.0, b = 0.0;
    bool pair = false;
  };
  std::vector<Block> blocks;
  struct Input { ///< nonzero entry of B_r
    int state = 0, coordinate = 0;
    double value = 0.0;
  };
  std::vector<Input> inputs;
  /// Couplings of a body with others, from the nonzeros of the tables.
  struct Links {
    /// Bodies whose motion loads this body by A, B or a convolution; includes itself
    std::vector<int> partners;
    std::vector<int> states; ///< memory states that load this body
    std::vector<int> inputs; ///< entries of `inputs` that this body drives
  };
  std::vector<Links> links; ///< couplings of each of `bodies`

  /// Matrices in the form that products need.
  struct Products {
    BlockMatrix added_mass, added_mass_all, output, output_all, damping, damping_all;
    BlockMatrix input; ///< B_r (n_states, n_moving)
  } products;

  // Tables of bodies whose added mass and radiation follow their pose; their entries above are
  // zero.
  std::vector<water::PoseTable> tables;
  int n_weights = 0; ///< number of weights of all tables
  /// (n_states,) weight that multiplies the load of the state; -1: none
  std::vector<int> weight_of_state;

  /// Finds `links` and `products`; call it last.
  void link();

  /// Added mass of coordinate u on itself [kg, kg m2]; the largest of the table for a body with
  /// one.
  double own_added_mass(int u) const;

  bool radiates() const {
    const auto damps = [](const water::PoseTable& table) { return !table.damping.empty(); };
    return n_states > 0 || damped || !convolution.empty() ||
           std::any_of(tables.begin(), tables.end(), damps);
  }
};

} // namespace hydrodae::system
