#pragma once
/// Equations in the form that integrators use: residual, Jacobian, weights and messages. They share
/// one scratch memory and count the calls.

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
  system::JacobianParts parts; ///< result of the last `jacobian`
  Statistics statistics;

  /// Computes F(t, y, y'); returns false if a value is not finite.
  bool residual(double t, const VectorX& y, const VectorX& yp, VectorX& r);

  /// Computes only the rows of q, u and z, for zero lambda, mu and sigma.
  bool free_residual(double t, const VectorX& y, const VectorX& yp, VectorX& r);

  /// Computes only the rows of the constraints, those of lambda and mu.
  bool constraint_residual(double t, const VectorX& y, const VectorX& yp, VectorX& r);

  /// Solves for the algebraic unknowns of elements at the rest of y; returns false without a
  /// solution.
  bool solve_algebraic(double t, VectorX& y);

  /// Computes dF/dy and dF/dy' into `parts`.
  void jacobian(double t, const VectorX& y, const VectorX& yp);

  /// Computes the mass matrix and constraint rows of the pattern `own` into `out`; not counted as a
  /// Jacobian.
  void mass_and_rows(double t, const VectorX& y, const VectorX& yp, const system::Pattern& own,
                     system::JacobianParts& out);

  /// Regularisation e D / |alpha| of each multiplier, for the diagonal of a Newton matrix dF/dy +
  /// alpha dF/dy' of the last `jacobian`: D is about diag(G M^-1 G^T), e tiny. It keeps the matrix
  /// regular in singular poses, where multipliers are not unique. The iteration still converges to
  /// the solution of the unchanged equations (proximal iteration: Bayo and Ledesma, Nonlinear
  /// Dynamics 9 (1996) 113).
  void regularisation(double alpha, VectorX& out) const;

  /// Takes an accepted step, which sets the turns of angles.
  void accept(double t, const VectorX& y, const VectorX& yp);

  /// Weights 1 / (rtol (scale + |y|)); |y| only if its origin is meaningful.
  void weights(const VectorX& y, VectorX& w) const;

  /// Largest root mean square of w e over the positions, velocities and memory states of one group
  /// of bodies, so that large groups do not hide small ones.
  double norm(const VectorX& w, const VectorX& e) const;

  /// Longest time scale of the bodies [s].
  double time_scale() const;

  /// Message "worst equations ...; largest reactions ..." at y, y'.
  std::string diagnosis(double t, const VectorX& y, const VectorX& yp);

private:
  struct Multiplier {
    std::vector<std::pair<std::size_t, Index>> gradient; ///< entry of G, and of the mass (-1: one)
  };
  void find_multipliers();

  std::vector<Multiplier> multipliers_;
  mutable VectorX squares_, sums_; ///< scratch of `norm`
  system::Workspace<double> workspace_;
  system::JacobianWorkspace jacobian_workspace_;
};

/// First step [s]: order 1 meets the tolerance with sqrt(tolerance) times the shortest time in
/// which a body moves, or accelerates, by its own scale.
double first_step(const system::Regime& system, double rtol, const VectorX& y, const VectorX& yp);

/// Largest root mean of `squares` (lambda0,) over one group; `sums` is scratch.
double largest_by_group(const system::Regime& system, const double* squares, VectorX& sums);

/// Text "a (2.1), b (0.4)": the three largest entries of `values` by name.
std::string worst(const VectorX& values, const std::vector<std::string>& names);

/// Guard against steps that shrink without failing near a singular pose: throws SolverError if the
/// last 5000 steps made almost no progress.
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
    long steps = 0;       ///< number of steps since the last check
    double checked = 0.0; ///< time of the last check [s]
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
