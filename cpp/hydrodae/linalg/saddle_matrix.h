#pragma once
/// Saddle-point matrix of accelerations and reactions, its factors and solutions:
///
///   K = [ M   G^T ]
///       [ G   -eD ]
///
/// D is diag(G M^-1 G^T) with the masses of the heaviest body of each mechanism, e tiny. It keeps
/// the matrix regular if rows depend on each other (singular poses). Refinement against e = 0
/// (proximal iteration: Bayo and Ledesma, Nonlinear Dynamics 9 (1996) 113) removes its effect and
/// tends to the minimum-norm reactions.

#include <memory>

#include "hydrodae/linalg/block_factor.h"
#include "hydrodae/linalg/klu.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::linalg {

class SaddleMatrix {
public:
  /// Residual of a solution, relative to the right-hand side
  static constexpr double converged = 1e-13;

  /// @param system, pattern  must outlive this object
  /// @param pattern  pattern of Part::accelerations
  SaddleMatrix(const system::Regime& system, const system::Pattern& pattern);

  /// Fills K with e = 0.
  void fill(const system::JacobianParts& parts);

  /// Factorises, unless the factors belong to these values already; returns false if the matrix is
  /// singular.
  bool factorise();

  /// Solves x = K^-1 b, with refinement against e = 0 until the residual is below `accuracy`. A
  /// large residual triggers a check of the pivots. NaN: the matrix is singular.
  void solve(const VectorX& b, VectorX& x, double accuracy = converged);

  /// Residual of b at a solution x, relative to the loads [-].
  double mismatch(const VectorX& b, const VectorX& x);

  /// Direction of u (n_u,) without inertia that no row holds; empty: none.
  VectorX undetermined() const;

  /// Smallest eigenvalue of G M^-1 G^T relative to its diagonal [-], for each part of the rows: see
  /// SaddlePoint.
  VectorX independence(const std::vector<int>& part, int parts);

private:
  struct Heaviest { ///< largest inertia of one mechanism
    double mass = 0.0, inertia = 0.0;
  };
  struct RowSums { ///< sums of G_ik^2 over translations and over rotations, and of G_ik^2 / M_kk
    double shift = 0.0, turn = 0.0, yields = 0.0;
    std::size_t mechanism = 0;
  };
  struct Run {       ///< entries of one column, in consecutive rows
    Index from = 0;  ///< index of the first in the Jacobian
    Index slot = 0;  ///< index of the first in the matrix
    Index count = 0; ///< number of entries
  };
  struct Strip { ///< entries of one column of the matrix, in consecutive rows
    Index column = 0, row = 0, slot = 0, count = 0;
  };
  void find_slots(const system::Pattern& pattern);
  void find_mechanisms();
  void find_blocks();
  void find_heaviest();
  RowSums sums_of(Index i) const;
  std::vector<VectorX> massless_directions() const;
  bool factorise_anew();
  bool factorise_sparse();
  void solve_factored(double* v) { in_blocks_ ? blocks_->solve(v) : lu_->solve(v); }
  void subtract_product(const VectorX& x, VectorX& out) const;
  double inertia(const VectorX& x) const;

  const system::Regime& s_;
  Index n_ = 0; ///< n_u + n_lambda
  std::vector<Index> start_, row_;
  std::vector<Strip> strips_;            ///< all entries
  std::vector<Run> of_mass_;             ///< entries of M, from dF/dy'
  std::vector<Run> of_rows_;             ///< entries of G, from dF/dy
  std::vector<Run> of_loads_;            ///< entries of G^T, with the opposite sign in dF/dy
  std::vector<Index> diagonal_;          ///< slots of eD
  std::vector<Index> mass_;              ///< slots of the diagonal of M
  std::vector<double> plain_;            ///< values with e = 0
  VectorX metric_, damping_;             ///< (n_lambda,) D, eD
  std::vector<std::size_t> mechanism_;   ///< (n_u,) mechanism of each velocity
  std::vector<bool> turns_;              ///< (n_u,) true for angular velocities
  std::vector<Heaviest> heaviest_;       ///< largest inertia by mechanism
  std::vector<RowSums> sums_;            ///< (n_lambda,) sums of each row
  std::unique_ptr<SparseLu<double>> lu_; ///< made when first needed
  std::unique_ptr<BlockFactor> blocks_;  ///< null: `lu_` is cheaper
  bool in_blocks_ = false;               ///< true: the last factors are those of `blocks_`
  bool chosen_ = false;                  ///< true: the choice between the two is made
  bool factored_ = false;                ///< true: the factors belong to `plain_`
  /// True: the pivots are those of an earlier matrix, unchecked
  bool old_pivots_ = false;
  VectorX r_; ///< (n,) scratch
};

} // namespace hydrodae::linalg
