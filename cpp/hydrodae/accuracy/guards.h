#pragma once
/// Witnesses of a run that went wrong without the integrator's noticing; judged after each accepted
/// step. (run/guards.h puts them in a row.)

#include <deque>

#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::accuracy {

/// Do the joints close a loop through moving bodies and the ground?
bool has_loop(const system::Regime& system);

/// Both levels of the constraints: in formulations that do not keep them they drift apart.
class DriftGuard {
public:
  explicit DriftGuard(const system::Regime& system);

  /// Throws SolverError when a gap is above a hundredth of its scale.
  void check(double t, const VectorX& y, const VectorX& yp);

  /// Are the positions checked last further apart than 1e-5 of their scale? Loops that do not close
  /// pass a singular pose at a distance of sqrt(gap), which turns the motion into another branch.
  bool misses_singular_poses() const;

  /// Throws SolverError for such a gap.
  [[noreturn]] void fail_at_singular_pose(double t) const;

private:
  [[noreturn]] void fail(double t, Index row, const std::string& where) const;

  system::Regime stabilised_; ///< the same equations with both levels as rows
  system::Workspace<double> workspace_;
  VectorX residual_;
  Index worst_ = 0; ///< row of the widest gap of the positions
};

/// Distinguishes singular poses of closed loops from rows that always follow from others.
class PoseGuard {
public:
  /// Takes the pose of y for a regular one; the constraints of `system` in any formulation.
  PoseGuard(const system::Regime& system, const VectorX& y);

  /// Are the rows of the constraints of any mechanism a hundred times nearer to dependence on each
  /// other than in its best pose seen?
  bool near_singular(double t, const VectorX& y, const VectorX& yp);

  void remember(Archive& a) { a(best_); }

private:
  VectorX independence(double t, const VectorX& y, const VectorX& yp);

  system::Regime stabilised_; ///< the same equations with both levels as rows
  system::Pattern pattern_;
  linalg::Equations equations_;
  linalg::SaddlePoint saddle_;
  std::vector<int> mechanism_; ///< of each row (n_lambda,)
  VectorX best_;               ///< by mechanism
};

/// In a singular pose of a closed loop the motion may jump to another branch: the velocities change
/// at once, though nothing strikes. Measured: 0.6 to 3 of the largest kinetic energy of a mechanism
/// within 0.003 time scales on a wrong branch, below 0.01 otherwise.
class BranchGuard {
public:
  explicit BranchGuard(const system::Regime& system);

  /// Throws SolverError when the velocities jumped within the last window.
  void check(double t, const VectorX& y);

  /// The velocities jumped for a reason: something struck.
  void restart() { past_.clear(); }

  /// Only scenes with loops have singular poses to fear.
  bool active() const { return active_; }

  void remember(Archive& a) { a(largest_, past_); }

private:
  VectorX energies(const VectorX& u) const;

  const system::Regime& s_;
  VectorX mass_;               ///< (n_u,) of each velocity
  std::vector<int> mechanism_; ///< likewise
  bool active_ = false;
  double window_ = 0.0;
  VectorX largest_; ///< kinetic energy by mechanism
  std::deque<std::pair<double, VectorX>> past_;
};

} // namespace hydrodae::accuracy
