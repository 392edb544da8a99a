#pragma once
/// The equations linearised about the motion from one look at it to the next, F_y d + F_y' d' = 0:
/// how they carry a small change d of q, u, z along.

#include <memory>
#include <vector>

#include "hydrodae/solve/equations.h"
#include "hydrodae/solve/newton_matrix.h"

namespace hydrodae::solve {

class LinearFlow {
public:
  /// @param y, yp state at t, the first look
  LinearFlow(const system::Regime& system, const system::Pattern& pattern, double t,
             const VectorX& y, const VectorX& yp);

  /// The next look, at t: `step` goes from the last one to it in equal substeps. False at a
  /// singular pose.
  bool look(double t, const VectorX& y, const VectorX& yp, int substeps);

  /// Carries `change` (lambda0,) along by one substep. False where it is lost, since the
  /// constraints are about to become dependent; then it stays what it was.
  bool step(VectorX& change);

  /// What the change of the equations between the looks does to `change` in a substep (lambda0,).
  VectorX effect(const VectorX& change);

  /// By how much the equations have changed, by group (n_error_groups,): stiffness and damping
  /// since the look before; stiffness and gyroscopic moments since the first, which is what
  /// frequencies come of. In the units of the unknowns, relative to the largest of each row and to
  /// its inertia (the directions of reactions turn in linear motions, too).
  /// @param rate of the motion of each group [1/s] (n_error_groups,)
  void compare(const VectorX& rate, VectorX& since_last, VectorX& since_first);

  double time() const { return time_; } ///< of the last look [s]

  /// What it knows of the last look, to look again from there.
  struct Look {
    std::vector<double> by_y, by_rate, before;
    VectorX u;
    double time = 0.0;
  };
  void keep(Look& out) const;
  void go_back(const Look& to);

  void remember(Archive& a) { a(by_y_, by_rate_, before_, first_by_y_, first_u_, u_, time_); }

private:
  const system::Regime& s_;
  const system::Pattern pattern_; ///< without the radiation memory
  Equations e_;
  system::JacobianParts mean_; ///< of both looks, rows of motions twice; see `look`
  std::unique_ptr<NewtonMatrix<double>> matrix_;
  std::vector<double> by_y_, by_rate_; ///< derivatives at the last look
  std::vector<double> before_;         ///< by y, at the look before
  std::vector<double> first_by_y_;
  std::vector<double> from_; ///< of the change at the start of a substep
  VectorX first_u_, u_;      ///< velocities at the first and the last look (n_u,)
  VectorX rhs_, row_size_;
  double time_, h_ = 0.0; ///< of the last look, length of its substeps [s]
};

} // namespace hydrodae::solve
