#pragma once
/// The equations as the integrators see them: residual, Jacobian, weights, and words for what goes
/// wrong. One scratch memory for all; counts the calls.

#include <string>

#include "hydrodae/linalg/statistics.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::linalg {

class Equations {
public:
  Equations(const system::Regime& system, const system::Pattern& pattern, double rtol);

  const system::Regime& system;
  const system::Pattern& pattern;
  const double rtol;
  system::JacobianParts parts; ///< of the last `jacobian`
  Statistics statistics;

  /// F(t, y, y'); false when a value is not finite.
  bool residual(double t, const VectorX& y, const VectorX& yp, VectorX& r);

  /// The rows of q, u and z alone, where lambda, mu and sigma are zero.
  bool free_residual(double t, const VectorX& y, const VectorX& yp, VectorX& r);

  /// The rows of the constraints alone, those of lambda and mu.
  bool constraint_residual(double t, const VectorX& y, const VectorX& yp, VectorX& r);

  /// Solves for the algebraic unknowns of elements by the rest of y; false where there is no
  /// solution.
  bool solve_algebraic(double t, VectorX& y);

  /// dF/dy and dF/dy' into `parts`.
  void jacobian(double t, const VectorX& y, const VectorX& yp);

  /// The same into `out`, where the pattern `own` holds the mass matrix and the constraint rows
  /// alone: it counts as no Jacobian.
  void mass_and_rows(double t, const VectorX& y, const VectorX& yp, const system::Pattern& own,
                     system::JacobianParts& out);

  /// e D / |alpha| for each multiplier, to be added to the diagonal of a Newton matrix
  /// dF/dy + alpha dF/dy' made of the last `jacobian`: D = diag(G M^-1 G^T) roughly, e tiny. In a
  /// singular pose, where the multipliers are not unique, it keeps the matrix regular; the solution
  /// that the iteration tends to is that of the equations unchanged (the proximal iteration of Bayo
  /// and Ledesma, Nonlinear Dynamics 9 (1996) 113).
  void regularisation(double alpha, VectorX& out) const;

  /// What belongs to accepted steps moves on (angles over turns).
  void accept(double t, const VectorX& y, const VectorX& yp);

  /// Weights 1 / (rtol (scale + |y|)); |y| only where the origin means something.
  void weights(const VectorX& y, VectorX& w) const;

  /// Root mean square of w e over the positions, velocities and memory states of a group of
  /// bodies, of the group where it is largest: none hides behind the number of the others.
  double norm(const VectorX& w, const VectorX& e) const;

  /// Longest time scale of the bodies [s].
  double time_scale() const;

  /// "worst equations ...; largest reactions ..." at y, y', for messages.
  std::string diagnosis(double t, const VectorX& y, const VectorX& yp);

private:
  struct Multiplier {
    std::vector<std::pair<std::size_t, Index>> gradient; ///< entry of G, of the mass (-1: one)
  };
  void find_multipliers();

  std::vector<Multiplier> multipliers_;
  mutable VectorX squares_, sums_; ///< scratch of `norm`
  system::Workspace<double> workspace_;
  system::JacobianWorkspace jacobian_workspace_;
};

/// First step [s]: short enough for order 1 to meet the tolerance, sqrt(tolerance) of the
/// shortest time in which a body moves, or speeds up by, its own scale.
double first_step(const system::Regime& system, double rtol, const VectorX& y, const VectorX& yp);

/// Square root of the mean of `squares` (lambda0,) over the group where it is largest; `sums` is
/// scratch.
double largest_by_group(const system::Regime& system, const double* squares, VectorX& sums);

/// "a (2.1), b (0.4)": the three largest entries of `values` by name.
std::string worst(const VectorX& values, const std::vector<std::string>& names);

/// Near a singular pose the steps can shrink without ever failing: throws SolverError when the last
/// 5000 steps brought next to nothing.
class ProgressGuard {
public:
  ProgressGuard(double start, double end, double time_scale)
      : state_{0, start}, end_(end), time_scale_(time_scale) {}
  template <class Diagnosis> void after_step(double t, Diagnosis&& diagnosis) {
    if (++state_.steps < watch)
      return;
    const double gained = t - state_.checked;
    if (gained < least * end_ && gained < watch * least * time_scale_ && t < end_)
      fail(t, gained, diagnosis());
    state_.steps = 0;
    state_.checked = t;
  }
  struct State {
    long steps = 0;       ///< since the last look
    double checked = 0.0; ///< time of it [s]
  };
  const State& state() const { return state_; }
  void set(const State& state) { state_ = state; }

private:
  static constexpr long watch = 5000;
  static constexpr double least =
      1e-6; // of the whole run in so many steps, of a body's time in one
  [[noreturn]] static void fail(double t, double gained, const std::string& diagnosis);
  State state_;
  double end_, time_scale_;
};

} // namespace hydrodae::linalg
