#pragma once
/// Accelerations, reactions and projections from one sparse saddle-point matrix:
///
///   [ M   G^T ] [  u'     ]   [ f                ]
///   [ G   -eD ] [ -lambda ] = [ -gamma (+ drive) ]
///
/// D is diag(G M^-1 G^T) with the masses of the heaviest body of each mechanism, e tiny. It only
/// keeps the matrix regular where rows depend on each other (singular poses); refinement against e
/// = 0 (the proximal iteration of Bayo and Ledesma, Nonlinear Dynamics 9 (1996) 113) takes its
/// effect out again and tends to the minimum-norm reactions.
///
/// Friction that the reactions press is found after that (pressed_friction.cpp).

#include <memory>
#include <string>
#include <string_view>

#include "hydrodae/linalg/block_factor.h"
#include "hydrodae/linalg/equations.h"
#include "hydrodae/linalg/klu.h"

namespace hydrodae::linalg {

class SaddlePoint {
public:
  static constexpr double closed = 1e-13; ///< gaps, in units of their scale

  explicit SaddlePoint(Equations& equations);
  ~SaddlePoint();

  /// Of y only q, u, z are read. Fills y' of them and the reactions lambda of y (mu = sigma = 0).
  /// False when no finite accelerations exist.
  bool accelerations(double t, VectorX& y, VectorX& yp);

  /// The matrix alone, for `project`. Of y only q and u are read; its multipliers are set to 0.
  /// False when it is singular.
  bool linearise(double t, VectorX& y);

  /// Friction pressed by its joint that leaves no accelerations or more than one at the last call
  /// of `accelerations` (Painleve's paradox), in words; empty if absent.
  const std::string& jam() const { return jam_; }

  /// What the last `accelerations` left of the equations, relative to the loads [-].
  double mismatch();

  /// A direction of u (n_u,) that has no inertia and that no row of the last matrix holds. Empty:
  /// no body has one.
  VectorX undetermined() const;

  /// Smallest eigenvalue of G M^-1 G^T against its diagonal [-], with the matrix of the last
  /// `accelerations`: 1 for rows that do not feel each other, 0 in a singular pose. Of each part of
  /// the rows by itself: rows of different parts have no body in common.
  /// @param part of each row (n_lambda,), below `parts`
  VectorX independence(const std::vector<int>& part, int parts);

  /// What impulses do, those of friction that its joint presses among them.
  struct Strike {
    VectorX impulses;     ///< Lambda (n_lambda,) [N s or N m s]
    VectorX before;       ///< rates that the rows had, over those of their drives (n_lambda,)
    double rubbed = 0.0;  ///< work of friction [J], over the means of rates before and after
    bool balanced = true; ///< false: no friction fits the impulses that press it
  };

  static constexpr std::string_view no_friction_fits =
      "no friction fits the impulses of an impact that press its joint";

  /// Changes u by the impulses G^T Lambda that give the velocity rows the rates `rates` (n_lambda,)
  /// [m/s or rad/s], with the matrix of the last `accelerations`.
  Strike strike(double t, VectorX& y, const VectorX& rates);

  /// Moves q, then u, by the smallest amount in the metric of M onto the constraints, with the
  /// matrix of the last `accelerations` or `linearise`. False when it does not converge.
  /// @param accuracy of the gaps, in units of their scale
  bool project(double t, VectorX& y, double accuracy = closed);

  /// Moves q of the last `accelerations`, which misses the constraints by a little, onto them to
  /// first order and in the same metric; u and reactions stay. In a singular pose, where a small
  /// gap would take a long way, q stays too.
  void close(double t, VectorX& y);

private:
  static constexpr double converged = 1e-13; ///< residual, relative to the right-hand side

  struct Pressed;
  struct Heaviest { ///< of one mechanism
    double mass = 0.0, inertia = 0.0;
  };
  struct RowSums { ///< sums of G_ik^2 over translations and over rotations, and of G_ik^2 / M_kk
    double shift = 0.0, turn = 0.0, yields = 0.0;
    std::size_t mechanism = 0;
  };
  std::vector<VectorX> massless_directions() const;
  void find_heaviest();
  RowSums sums_of(Index i) const;
  bool press(double t, const VectorX& y, VectorX& yp);
  void fill(double t, const VectorX& y);
  bool factorise();
  bool factorise_sparse();
  void find_blocks();
  void solve_factored(double* v) { in_blocks_ ? blocks_->solve(v) : lu_->solve(v); }
  double gaps();
  void solve(VectorX& x, double accuracy = converged);
  void multiply(const VectorX& x, VectorX& out) const;

  struct Entry {
    Index from = 0; ///< in the Jacobian
    Index slot = 0; ///< in the matrix
  };

  Equations& e_;
  const system::Regime& s_;
  system::Pattern pattern_;     ///< of what accelerations need
  system::JacobianParts parts_; ///< on it
  Index n_ = 0;                 ///< n_u + n_lambda
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
  std::vector<Index> algebraic_;         ///< unknowns of elements that have no rate
  std::unique_ptr<SparseLu<double>> lu_; ///< made when first needed
  std::unique_ptr<BlockFactor> blocks_;  ///< null: `lu_` is cheaper
  bool in_blocks_ = false;               ///< the last factors
  bool chosen_ = false;                  ///< between the two
  bool old_pivots_ = false;              ///< those of a matrix before, which nobody has looked at
  VectorX residual_, rhs_, x_, r_, yp0_;
  std::unique_ptr<Pressed> pressed_; ///< null: no friction is pressed by its joint
  std::string jam_;
};

} // namespace hydrodae::linalg
