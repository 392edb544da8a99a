#pragma once
/// Newton's iteration on the stages of one step. With increments Z_i = Y_i - y_0 and
/// Y'_i = sum_j (a^-1)_ij Z_j / h the equations are F(t_i, Y_i, Y'_i) = 0.
///
/// Simplified Newton: one Jacobian J + (lambda / h) B for each eigenvalue lambda of a^-1 (one real,
/// the others complex), with J = dF/dy and B = dF/dy' at the start of the step. Full Newton: the
/// Jacobian at every stage, all stages in one sparse matrix; it passes singular poses where the
/// simplified one fails.

#include <memory>
#include <optional>
#include <vector>

#include "hydrodae/integrate/runge_kutta.h"
#include "hydrodae/integrate/stage_memory.h"
#include "hydrodae/linalg/equations.h"
#include "hydrodae/linalg/newton_matrix.h"

namespace hydrodae::integrate {

enum class NewtonResult { converged, slow, failed };

class StageNewton {
public:
  StageNewton(linalg::Equations& equations, const RungeKutta& rk);

  const RungeKutta& rk() const { return rk_; }

  /// Factorises for the step h from the parts of `Equations::jacobian`. Returns false if singular.
  bool factorise(double h);

  /// Iterates on Z (n, s) from its present values. `w`: weights of the norm.
  NewtonResult simplified(double t, double h, const VectorX& y0, const VectorX& w, MatrixX& Z);
  NewtonResult full(double t, double h, const VectorX& y0, const VectorX& w, MatrixX& Z);

  /// Computes the rates Z' of the stages, (n, s).
  void rates(double h, const MatrixX& Z, MatrixX& out) const;

  /// Solves (J + B / (gamma0 h)) x = x, for the error estimate.
  void solve_real(VectorX& x) { real_->solve(x.data()); }

  /// Approximate number of iterations of `simplified` that cost as much as a Jacobian and its
  /// matrices.
  double renewal() const { return renewal_; }

  /// Contraction of the last iteration, and the number of iterations.
  double contraction = 0.0;
  int iterations = 0;

private:
  struct Full {
    system::Pattern pattern;     ///< pattern of one stage
    system::JacobianParts parts; ///< Jacobian of one stage
    linalg::PointElimination points;
    std::vector<Index> start, row;
    std::vector<Index>
        diagonal; ///< places of the multipliers' own diagonal entries, stage by stage
    /// Place of entry k of the reduced block (i, j) at [i * s + j][k], or -1
    std::vector<std::vector<Index>> slots;
    /// Places of the reduced entries, in the order of StageMemory's visits
    std::vector<Index> memory_slots;
    std::optional<StageMemory> memory;
    MatrixX by_y, by_yp; ///< (lifted, s) entries of the lifted rows at the stages
    MatrixX stays;       ///< (n, s) reduced right side
    std::unique_ptr<linalg::SparseLu<double>> lu;
    linalg::SparseLu<double>::Work work;
    Full(const system::Regime& s, const system::Pattern& of_stage)
        : pattern(of_stage), parts(pattern), points(s, pattern) {}
  };
  bool residuals(double t, double h, const VectorX& y0, const MatrixX& Z);
  double size(const VectorX& w, const MatrixX& dZ) const;
  void make_full();
  bool factorise_full(double t, double h);
  void add_memory(double h);
  void solve_full(double h);
  void solve_bodies(double h);
  double n_systems() const;
  double find_renewal() const;
  template <class Solve>
  NewtonResult iterate(double t, double h, const VectorX& y0, const VectorX& w, MatrixX& Z,
                       int most, double stalled, Solve&& solve);

  linalg::Equations& e_;
  RungeKutta rk_;
  std::unique_ptr<linalg::NewtonMatrix<double>> real_;
  std::vector<std::unique_ptr<linalg::NewtonMatrix<std::complex<double>>>> pairs_;
  std::unique_ptr<Full> full_;
  linalg::SparseLu<double>::Work one_; ///< work of a real system at its first factorisation
  double renewal_ = 0.0;               ///< cost of a renewal; 0: not known yet
  MatrixX stage_, rate_, residual_, work_;
  VectorX y_, yp_, r_;
  mutable VectorX sums_; ///< scratch of `size`
  std::vector<std::complex<double>> complex_;
};

} // namespace hydrodae::integrate
