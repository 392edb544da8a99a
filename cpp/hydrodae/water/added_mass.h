#pragma once
/// Bodies in the water, and their added mass at infinite frequency: the momentum P = A U along the
/// hydrodynamic coordinates, and the force A U' that it takes (hydro_axes.h).

#include <vector>

#include "hydrodae/math/block_matrix.h"
#include "hydrodae/water/hydro_axes.h"
#include "hydrodae/water/pose_table.h"

namespace hydrodae::water {

/// Bodies in the water, and the coordinates of U: their velocities that move.
struct WetBodies {
  HydroAxes axes = HydroAxes::mean;
  std::vector<HydroBody> bodies;
  struct Coordinate { ///< hydrodynamic body and component of an entry of U
    int hydro_body = 0, component = 0;
    Index row() const { return 6 * hydro_body + component; } ///< row among all coordinates
  };
  std::vector<Coordinate> coordinates; ///< (n_moving,)
  int n_moving = 0;                    ///< length of U

  const HydroBody& of(const PoseTable& table) const {
    return bodies[static_cast<std::size_t>(table.hydro_body)];
  }
  /// Rows of `all` (6 n_bodies, n) that belong to U.
  MatrixX moving_rows(const MatrixX& all) const {
    MatrixX out(n_moving, all.cols());
    for (int u = 0; u < n_moving; ++u)
      out.row(u) = all.row(coordinates[static_cast<std::size_t>(u)].row());
    return out;
  }
};

/// Block of a matrix (n_moving, n_moving) between two hydrodynamic bodies. Entries of coordinates
/// that do not move are zero.
inline Matrix6 hydro_block(const MatrixX& matrix, const HydroBody& i, const HydroBody& j) {
  Matrix6 block = Matrix6::Zero();
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n)
      if (i.moving[m] >= 0 && j.moving[n] >= 0)
        block(m, n) = matrix(i.moving[m], j.moving[n]);
  return block;
}

/// Matrix with zeros in the rows of coordinates that do not move.
inline Matrix6 moving_rows(const HydroBody& hb, Matrix6 matrix) {
  for (int c = 0; c < 6; ++c)
    if (hb.moving[c] < 0)
      matrix.row(c).setZero();
  return matrix;
}

/// Block of one body in a matrix (6 n_bodies, n_moving): six rows, and the moving columns.
inline Matrix6 own_block(const HydroBody& hb, int number, const MatrixX& all) {
  Matrix6 out = Matrix6::Zero();
  for (int c = 0; c < 6; ++c)
    if (hb.moving[c] >= 0)
      out.col(c) = all.block<6, 1>(6 * number, hb.moving[c]);
  return out;
}

/// Adds the moving components of a body to those of all bodies.
template <class S> void scatter(const HydroBody& hb, const Vec6<S>& of_body, S* moving_of_all) {
  for (int c = 0; c < 6; ++c)
    if (hb.moving[c] >= 0)
      moving_of_all[hb.moving[c]] += of_body[c];
}

struct AddedMass {
  MatrixX moving; ///< (n_moving, n_moving)
  MatrixX all;    ///< (6 n_bodies, n_moving), also the loads on coordinates that do not move
  BlockMatrix product, product_all;
  /// Tables of bodies whose added mass follows their pose; their entries above are zero.
  std::vector<PoseTable> tables;
  int n_weights = 0; ///< number of weights of all tables

  void link() {
    product = BlockMatrix(moving);
    product_all = BlockMatrix(all);
  }

  /// Added mass of coordinate u on itself [kg, kg m2]; the largest of the table for a body with
  /// one.
  double own(const WetBodies& wet, int u) const {
    double out = moving(u, u);
    const WetBodies::Coordinate& k = wet.coordinates[static_cast<std::size_t>(u)];
    if (const int t = wet.bodies[static_cast<std::size_t>(k.hydro_body)].table; t >= 0)
      for (const Matrix6& table : tables[static_cast<std::size_t>(t)].added_mass)
        out = std::max(out, table(k.component, k.component));
    return out;
  }
};

} // namespace hydrodae::water
