#pragma once
/// Added mass and radiation of all bodies in the water, on all rungs.

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
/// pair of coordinates that feel each other.
struct Convolution {
  struct Pair {
    int row = 0;    ///< of U; from n_moving on, of `locked`
    int column = 0; ///< of U
  };
  double step = 0.0, length = 0.0; ///< of the grid, and T, beyond which K = 0 [s]
  double frequency = 0.0;          ///< root mean square of the kernels' spectra [rad/s]
  std::vector<Pair> pairs;         ///< those whose row moves come first
  int n_moving_pairs = 0;
  std::vector<int> locked; ///< rows of the full loads (6 n_bodies) that do not move
  MatrixX splines;         ///< coefficients (n_grid + 2, n_pairs)
  bool empty() const { return pairs.empty(); }
};

/// Added mass at infinite frequency and radiation memory of all bodies.
///   loads along the coordinates of U: -(A_inf U)' - C z - B U,   z' = A_r z + B_r U
/// B is the damping of the constant rung; then A(w) stands in place of A_inf. The convolution
/// stands in place of C z.
struct HydroData {
  HydroAxes axes = HydroAxes::mean;
  std::vector<HydroBody> bodies;
  struct Coordinate { ///< which entry of which hydrodynamic body an entry of U is
    int hydro_body = 0, component = 0;
  };
  std::vector<Coordinate> coordinates; ///< (n_moving,)
  int n_moving = 0;                    ///< length of U
  MatrixX added_mass;                  ///< (n_moving, n_moving)
  MatrixX
      added_mass_all;  ///< (6 n_bodies, n_moving), also the loads on coordinates that do not move
  MatrixX output;      ///< C (n_moving, n_states)
  MatrixX output_all;  ///< (6 n_bodies, n_states)
  bool damped = false; ///< constant damping; else the next two are empty
  MatrixX damping, damping_all;       ///< B (n_moving, n_moving), (6 n_bodies, n_moving)
  Convolution convolution;            ///< empty on the other rungs
  std::vector<std::string> uncovered; ///< labels whose load the fit does not give
  Index z0 = 0;
  int n_states = 0;
  struct Block { ///< z' = a z + ..., or the pair (x + i y)' = (a + i b)(x + i y) + ...
    int state = 0;
    double a = 0.0, b = 0.0;
    bool pair = false;
  };
  std::vector<Block> blocks;
  struct Input { ///< one nonzero of B_r
    int state = 0, coordinate = 0;
    double value = 0.0;
  };
  std::vector<Input> inputs;
  /// What a body shares with others, from the tables: all else is zero.
  struct Links {
    std::vector<int> partners; ///< bodies whose motion loads it by A, B or a convolution; itself
    std::vector<int> states;   ///< of the memory, that load it
    std::vector<int> inputs;   ///< in `inputs`, that it drives
  };
  std::vector<Links> links; ///< of each of `bodies`

  /// The matrices as products take them.
  struct Products {
    BlockMatrix added_mass, added_mass_all, output, output_all, damping, damping_all;
    BlockMatrix input; ///< B_r (n_states, n_moving)
  } products;

  // Of bodies whose added mass and radiation follow their pose; all else of theirs is zero above.
  std::vector<water::PoseTable> tables;
  int n_weights = 0;                ///< of all tables
  std::vector<int> weight_of_state; ///< (n_states,) what its load is multiplied by; -1: 1

  /// Finds `links` and `products`, once all the rest is there.
  void link();

  /// Added mass of coordinate u on itself; of a body with a table the largest [kg, kg m2].
  double own_added_mass(int u) const;

  bool radiates() const {
    const auto damps = [](const water::PoseTable& table) { return !table.damping.empty(); };
    return n_states > 0 || damped || !convolution.empty() ||
           std::any_of(tables.begin(), tables.end(), damps);
  }
};

} // namespace hydrodae::system
