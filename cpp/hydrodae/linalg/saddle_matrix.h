#pragma once
/// The saddle-point matrix of accelerations and reactions, its factors and what follows from them:
///
///   K = [ M   G^T ]
///       [ G   -eD ]
///
/// D is diag(G M^-1 G^T) with the masses of the heaviest body of each mechanism, e tiny. It only
/// keeps the matrix regular where rows depend on each other (singular poses); refinement against e
/// = 0 (the proximal iteration of Bayo and Ledesma, Nonlinear Dynamics 9 (1996) 113) takes its
/// effect out again and tends to the minimum-norm reactions.

#include <memory>

#include "hydrodae/linalg/block_factor.h"
#include "hydrodae/linalg/klu.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::linalg {

class SaddleMatrix {
public:
  static constexpr double converged = 1e-13; ///< residual, relative to the right-hand side

  /// Both must outlive it.
  /// @param pattern of Part::accelerations
  SaddleMatrix(const system::Regime& system, const system::Pattern& pattern);

  /// K with e = 0.
  void fill(const system::JacobianParts& parts);

  /// False when it is singular.
  bool factorise();

  /// x = K^-1 b, the residual taken with e = 0, until what is left of it is below `accuracy`. Where
  /// much of it is left the pivots may have gone bad, and are looked at. NaN: it is singular.
  void solve(const VectorX& b, VectorX& x, double accuracy = converged);

  /// What a solution x leaves of b, relative to the loads [-].
  double mismatch(const VectorX& b, const VectorX& x);

  /// A direction of u (n_u,) that has no inertia and that no row holds. Empty: no body has one.
  VectorX undetermined() const;

  /// Smallest eigenvalue of G M^-1 G^T against its diagonal [-], of each part of the rows by
  /// itself: see SaddlePoint.
  VectorX independence(const std::vector<int>& part, int parts);

private:
  struct Heaviest { ///< of one mechanism
    double mass = 0.0, inertia = 0.0;
  };
  struct RowSums { ///< sums of G_ik^2 over translations and over rotations, and of G_ik^2 / M_kk
    double shift = 0.0, turn = 0.0, yields = 0.0;
    std::size_t mechanism = 0;
  };
  struct Entry {
    Index from = 0; ///< in the Jacobian
    Index slot = 0; ///< in the matrix
  };
  void find_slots(const system::Pattern& pattern);
  void find_mechanisms();
  void find_blocks();
  void find_heaviest();
  RowSums sums_of(Index i) const;
  std::vector<VectorX> massless_directions() const;
  bool factorise_sparse();
  void solve_factored(double* v) { in_blocks_ ? blocks_->solve(v) : lu_->solve(v); }
  void subtract_product(const VectorX& x, VectorX& out) const;
  double inertia(const VectorX& x) const;

  const system::Regime& s_;
  Index n_ = 0; ///< n_u + n_lambda
  std::vector<Index> start_, row_;
  std::vector<Entry> of_mass_;           ///< from dF/dy'
  std::vector<Entry> of_rows_;           ///< G, from dF/dy
  std::vector<Entry> of_loads_;          ///< G^T, which dF/dy has with the other sign
  std::vector<Index> diagonal_;          ///< slots of eD
  std::vector<Index> mass_;              ///< slots of the diagonal of M
  std::vector<double> plain_;            ///< values with e = 0
  VectorX metric_, damping_;             ///< (n_lambda,) D, eD
  std::vector<std::size_t> mechanism_;   ///< (n_u,)
  std::vector<bool> turns_;              ///< (n_u,) angular velocities
  std::vector<Heaviest> heaviest_;       ///< by mechanism
  std::vector<RowSums> sums_;            ///< (n_lambda,)
  std::unique_ptr<SparseLu<double>> lu_; ///< made when first needed
  std::unique_ptr<BlockFactor> blocks_;  ///< null: `lu_` is cheaper
  bool in_blocks_ = false;               ///< the last factors
  bool chosen_ = false;                  ///< between the two
  bool old_pivots_ = false;              ///< those of a matrix before, which nobody has looked at
  VectorX r_;                            ///< (n,) scratch
};

} // namespace hydrodae::linalg
