#pragma once
/// Accelerations, reactions and projections in joint coordinates (system/joint_tree.h):
///
///   [ M_r   G_r^T ] [  u'     ]   [ S^T (f - M (dS/dt) u)           ]     M_r = S^T M S
///   [ G_r   -eD   ] [ -lambda ] = [ -gamma - G (dS/dt) u (+ drive)  ]     G_r = G S
///
/// with M, f and G of the bodies as the equations have them, G only of rows that the tree does not
/// meet by itself. e and D as in saddle_point.h. The matrix is dense: M_r is full along each path
/// from the root, and everywhere where the water joins the bodies.

#include <Eigen/LU>
#include <memory>
#include <string>

#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/tree/joint_tree.h"

namespace hydrodae::tree {

class JointSpace {
public:
  /// Throws ModelError for scenes that cannot be had in joint coordinates.
  explicit JointSpace(linalg::Equations& equations);

  static constexpr bool is_of_bodies = false;
  Index size() const { return tree_.n_q + tree_.n_u + s_.n_z; } ///< of x = [q | u | z]

  /// x, x' from consistent y, y', whose layout is that of the regime, as after an accepted step; of
  /// x' only the size. Throws SolverError where a joint stands in a pose that its coordinates do
  /// not reach.
  void enter(double t, const VectorX& y, const VectorX& yp, VectorX& x, VectorX& xp);

  /// Takes over what programs have set in the regime since the last call.
  void follow();

  /// Rates x' = [q' | u' | z']; algebraic states of x are brought up to date. False when no finite
  /// accelerations exist.
  bool rates(double t, VectorX& x, VectorX& xp);

  /// Moves x by the smallest amount in the metric of M_r onto the rows left, with the matrix of
  /// the last `rates`; unit quaternions. False when it does not converge.
  bool project(double t, VectorX& x);

  /// The same for x of the last `rates`, which misses these rows by a little, and its rates again.
  bool close(double t, VectorX& x, VectorX& xp);

  /// What belongs to accepted steps moves on.
  void accept(double t, const VectorX& x, const VectorX& xp);

  /// y and y' of the bodies with all multipliers, of the last `rates`. False: no finite reactions.
  bool leave(double t, const VectorX&, const VectorX&, VectorX& y, VectorX& yp);

  /// Change of q, u, z of the bodies (lambda0,) by a small change of x, to first order.
  const VectorX& of_bodies(const VectorX& x, const VectorX& change);

  const std::string& jam() const { return jam_; }
  const linalg::Statistics& statistics() const { return own_->statistics; }

private:
  struct MassEntry { ///< in the 6 x 6 block of a body that has a mass matrix of its own
    Index from = 0;
    std::size_t body = 0;
    int i = 0, j = 0;
  };
  struct Entry {
    Index from = 0, row = 0, column = 0;
  };
  /// What of a closing row loads one body.
  struct Part {
    Index row = 0;
    std::size_t body = 0;
    std::vector<std::pair<Index, int>> entries; ///< (in the Jacobian, component)
  };

  void prepare();
  void read(double t, const VectorX& y, VectorX& x);
  void find_components();
  void find_masses();
  void find_gradient();
  void drop_dependent_rows(Index needed);

  void fill_gradient();
  void fill_masses();
  void add_own_masses();
  void add_coupled_masses();
  void fill_loads(double t);
  void move_to(const VectorX& x);
  void write_accelerations(VectorX& out) const;
  bool factorise();
  void solve();
  bool are_rows_at_rest(const VectorX& u);
  void share_reactions(VectorX& y);
  Vector6 to_world(std::size_t body, const Vector6& tangent) const;

  linalg::Equations& e_;
  const system::Regime& s_;
  const tree::JointTree tree_;
  std::vector<bool> guided_; ///< (n_rows,) met by the tree, or following from the others
  system::Regime cut_;       ///< the regime without them
  system::Pattern pattern_;
  std::unique_ptr<linalg::Equations> own_; ///< of `cut_`
  std::unique_ptr<system::JacobianParts> parts_;
  tree::TreeMotion motion_, moved_;
  Index n_ = 0, m_ = 0; ///< velocities, rows left

  std::vector<std::size_t> body_of_; ///< (n_u of the bodies,)
  std::vector<int> component_of_;
  std::vector<Entry> masses_; ///< by velocities of the bodies
  std::vector<MassEntry> own_masses_;
  std::vector<Entry> coupled_masses_; ///< in `coupled_`
  std::vector<std::size_t> coupled_bodies_;
  std::vector<Part> gradient_;

  std::vector<Matrix6> composite_; ///< (n_bodies,)
  std::vector<Vector6> wrench_;    ///< (n_bodies,) world axes
  MatrixX coupled_, coupled_S_, coupled_MS_;
  MatrixX plain_, matrix_; ///< e = 0, e > 0
  Eigen::PartialPivLU<MatrixX> lu_;
  VectorX y_, yp_, yp0_, residual_; ///< of `cut_`
  VectorX rhs_, solution_, r_, metric_, bias_, net_, moved_x_, change_, before_;
  std::unique_ptr<linalg::SaddlePoint> of_redundant_; ///< shares reactions among redundant rows
  std::string jam_;
};

} // namespace hydrodae::tree
