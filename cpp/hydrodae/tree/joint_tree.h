#pragma once
/// Joint coordinates: each body hangs on another, or on the ground, through one joint, and moves
/// against it by the coordinates that this joint leaves free. What is not in this tree (joints that
/// close loops, drives, couplers) stays a constraint row.
///
/// x = [q | u | z]: coordinates of the links, their rates, and the states of elements as they are.
/// A link holds slides along axes of marker A and one of
///   about_axis  theta, R_AB = exp(theta n)           u = theta'
///   crossed     alpha, beta, R_AB = Rx(alpha) Ry(beta)
///   ball        a unit quaternion of R_AB            u: of B against A, axes of marker B
/// A body that no joint of the tree holds has its own coordinates of system.h there.
///
/// All bodies beyond velocity coordinate k move by u_k (d_k + a_k x (r - o_k)) and turn by u_k a_k
/// (world axes): the columns of S in v = S(q) u.

#include <string>
#include <vector>

#include "hydrodae/system/kinematics.h"

namespace hydrodae::tree {

/// How a body moves against the one before it in the tree.
struct TreeLink {
  enum class Turn { none, about_axis, crossed, ball };
  int body = 0;
  int parent = -1;     ///< body, -1: the ground
  int before = -1;     ///< link of the parent; -1: the parent does not move
  int joint = -1;      ///< in System::joints, -1: coordinates of its own
  bool turned = false; ///< the body is A of the joint, the parent B
  Turn turn = Turn::none;
  Vector3 axis = Vector3::UnitZ(); ///< n, axes of marker A (own coordinates: of the world)
  double advance = 0.0;            ///< of a screw along n [m/rad]
  std::vector<int> slides;         ///< axes of marker A (own coordinates: of the world)
  Index q0 = 0, u0 = 0;            ///< first coordinate, in q and in u
  int n_q = 0, n_u = 0;
  int plane_axis = -1;       ///< the only one, 0 to 2, that the body may turn about; -1: any
  double angle_factor = 0.0; ///< angle of such a body by theta, 1 or -1
  Matrix3 parent_axes = Matrix3::Identity(), child_axes = Matrix3::Identity(); ///< of the markers
  Vector4 parent_turn{1, 0, 0, 0}, child_turn{1, 0, 0, 0};                     ///< quaternions
  Vector3 parent_point = Vector3::Zero(), child_point = Vector3::Zero();
};

/// The tree of a scene: constant for the whole run. Links of parents come first.
struct JointTree {
  /// Of a system that is assembled. Joints become links in the order of their distance from the
  /// ground, or from the body of what floats that has the most joints, the heaviest of those.
  explicit JointTree(const system::System& system);

  std::vector<TreeLink> links;
  std::vector<int> link_of; ///< (n_bodies,) -1: the body does not move
  Index n_q = 0, n_u = 0;
  std::vector<bool> guided; ///< (n_rows,) those of the joints that are links

  /// Independent rows that it leaves: they have multipliers.
  Index rows_left(const system::Regime& regime) const {
    return n_u - (regime.n_u - regime.n_lambda);
  }

  /// "reduced coordinates: 24 velocities in place of 42, 3 of 18 constraint rows left, ..."
  std::string in_words(const system::Regime& regime) const;
};

/// Column of S: v = slide + axis x (r - pivot), omega = axis.
struct TreeColumn {
  Vector3 slide = Vector3::Zero(), axis = Vector3::Zero(), pivot = Vector3::Zero();
  /// [v; omega] that it gives a body at r.
  Vector6 at(const Vector3& r) const {
    Vector6 out;
    out << slide + cross<double>(axis, r - pivot), axis;
    return out;
  }
};

/// Poses and motions of the bodies that follow from x; scratch, but for what keeps angles and
/// quaternions continuous.
struct TreeMotion {
  struct Body {
    Vector3 r, v = Vector3::Zero(), omega = Vector3::Zero(); ///< world axes
    Vector3 a = Vector3::Zero(), alpha = Vector3::Zero();    ///< accelerations, world axes
    Vector4 p;
    Matrix3 R;
    double angle = 0.0; ///< of a body that turns about one axis only
  };
  std::vector<Body> bodies;
  std::vector<TreeColumn> columns;        ///< (n_u,)
  std::vector<double> sign, angle_offset; ///< (n_bodies,) of quaternions and angles in y

  explicit TreeMotion(const system::System& system, std::size_t n_columns = 0);

  /// Poses, velocities and columns by q and u.
  void move(const JointTree& tree, const double* x);

  /// a = S u' + (dS/dt) u of all bodies after `move`; `rates` (n_u,): u', null: zero.
  void accelerate(const JointTree& tree, const double* x, const double* rates);

  /// q' by q and u.
  void position_rates(const JointTree& tree, const double* x, double* rates) const;

  /// q and u of y.
  void write(const system::System& system, VectorX& y) const;

  /// q and u of x (sized) from y, and what continuity needs; then moves there. Returns the largest
  /// misfit of the poses [m or rad] with the body that it is of.
  std::pair<double, int> read(const system::System& system, const JointTree& tree, const VectorX& y,
                              VectorX& x);
};

/// Unit quaternions in x.
void normalise(const JointTree& tree, VectorX& x);

/// q of x moved along `step` (n_u,).
void retract(const JointTree& tree, const VectorX& step, VectorX& x);

} // namespace hydrodae::tree
