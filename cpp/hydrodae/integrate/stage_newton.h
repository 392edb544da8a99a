#pragma once
/// Newton's iteration on the stages of one step. With increments Z_i = Y_i - y_0 and
/// Y'_i = sum_j (a^-1)_ij Z_j / h the equations are F(t_i, Y_i, Y'_i) = 0.
///
/// Simplified: one Jacobian J + (lambda / h) B for each eigenvalue lambda of a^-1 (one real, the
/// others complex), J = dF/dy and B = dF/dy' at the start of the step. Full: the Jacobian at every
/// stage, all stages in one sparse matrix; it passes singular poses where the simplified one fails.

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

  /// Factorises for the step h with the parts that `Equations::jacobian` left. False: singular.
  bool factorise(double h);

  /// Iterates on Z (n, s) from what it holds. `w`: weights of the norm.
  NewtonResult simplified(double t, double h, const VectorX& y0, const VectorX& w, MatrixX& Z);
  NewtonResult full(double t, double h, const VectorX& y0, const VectorX& w, MatrixX& Z);

  /// Z' of the stages, (n, s).
  void rates(double h, const MatrixX& Z, MatrixX& out) const;

  /// Solves (J + B / (gamma0 h)) x = x, for the error estimate.
  void solve_real(VectorX& x) { real_->solve(x.data()); }

  /// How many iterations of `simplified` cost as much as a Jacobian and its matrices, roughly.
  double renewal() const { return renewal_; }

  /// Contraction of the last iteration, and how many it took.
  double contraction = 0.0;
  int iterations = 0;

private:
  struct Full {
    system::Pattern pattern;     ///< of one stage
    system::JacobianParts parts; ///< of one stage
    linalg::PointElimination points;
    std::vector<Index> start, row;
    std::vector<Index>
        diagonal; ///< places of the multipliers' own diagonal entries, stage by stage
    /// [i * s + j][k]: place of entry k of what stays of block (i, j), -1
    std::vector<std::vector<Index>> slots;
    std::vector<Index> memory_slots; ///< of what stays, in the order of StageMemory's visits
    std::optional<StageMemory> memory;
    MatrixX by_y, by_yp; ///< (lifted, s) their entries at the stages
    MatrixX stays;       ///< (n, s) of what stays
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
  linalg::SparseLu<double>::Work one_; ///< of a real system, as it first was
  double renewal_ = 0.0;               ///< 0: not known yet
  MatrixX stage_, rate_, residual_, work_;
  VectorX y_, yp_, r_;
  mutable VectorX sums_; ///< scratch of `size`
  std::vector<std::complex<double>> complex_;
};

} // namespace hydrodae::integrate
