#pragma once
/// Accelerations, reactions and projections from one sparse saddle-point matrix:
///
///   [ M   G^T ] [  u'     ]   [ f                ]
///   [ G   -eD ] [ -lambda ] = [ -gamma (+ drive) ]
///
/// Friction with a bearing is solved afterwards (pressed_friction.cpp).

#include <memory>
#include <string>
#include <string_view>

#include "hydrodae/linalg/equations.h"
#include "hydrodae/linalg/saddle_matrix.h"

namespace hydrodae::linalg {

class SaddlePoint {
public:
  // Limits of `project`, for gaps and rates in units of their scale:
  static constexpr int projections = 8;
  static constexpr double closed = 1e-13;  ///< largest gap that needs no further step
  static constexpr double stalled = 1e-10; ///< gap below which slow convergence is rounding
  static constexpr double open = 1e-9;     ///< gap above which the projection has failed
  /// Rate above which the projection has failed: the loop is locked
  static constexpr double moving = 1e-8;

  explicit SaddlePoint(Equations& equations);
  ~SaddlePoint();

  /// Computes y' of q, u, z and the reactions lambda in y (mu = sigma = 0) from q, u, z. Returns
  /// false if no finite accelerations exist.
  bool accelerations(double t, VectorX& y, VectorX& yp);

  /// Computes only the matrix, for `project`, from q and u in y; sets its multipliers to 0. Returns
  /// false if it is singular.
  bool linearise(double t, VectorX& y);

  /// Message on friction with a bearing that gave no accelerations, or more than one solution, in
  /// the last `accelerations` (Painleve's paradox); empty: none.
  const std::string& jam() const { return jam_; }

  /// Residual of the last `accelerations`, relative to the loads [-].
  double mismatch() { return matrix_.mismatch(rhs_, x_); }

  /// Direction of u (n_u,) without inertia that no row of the last matrix holds; empty: none.
  VectorX undetermined() const { return matrix_.undetermined(); }

  /// Smallest eigenvalue of G M^-1 G^T relative to its diagonal [-], with the matrix of the last
  /// `accelerations`: 1 for independent rows, 0 in a singular pose. Each part of the rows has its
  /// own; rows of different parts have no common body.
  /// @param part  part of each row (n_lambda,), below `parts`
  VectorX independence(const std::vector<int>& part, int parts) {
    return matrix_.independence(part, parts);
  }

  /// Result of an impact, with the impulses of friction with bearings.
  struct Strike {
    VectorX impulses;     ///< Lambda (n_lambda,) [N s or N m s]
    VectorX before;       ///< (n_lambda,) rates of the rows before, relative to their drives
    double rubbed = 0.0;  ///< work of friction [J], with the mean of the rates before and after
    bool balanced = true; ///< false: no friction fits its bearing impulses
  };

  static constexpr std::string_view no_friction_fits =
      "no friction fits the impulses of an impact that press its joint";

  /// Changes u by the impulses G^T Lambda that give the velocity rows the rates `rates` (n_lambda,)
  /// [m/s or rad/s], with the matrix of the last `accelerations`.
  Strike strike(double t, VectorX& y, const VectorX& rates);

  /// Moves q, then u, onto the constraints by the smallest amount in the metric of M, with the
  /// matrix of the last `accelerations` or `linearise`. Returns false without convergence.
  /// @param accuracy  largest remaining gap, in units of its scale
  bool project(double t, VectorX& y, double accuracy = closed);

  /// Moves q of the last `accelerations` onto the constraints, to first order in the metric of M; u
  /// and reactions stay. In a singular pose, where a small gap needs a large displacement, q stays,
  /// too.
  void close(double t, VectorX& y);

private:
  struct Pressed;
  bool press(double t, const VectorX& y, VectorX& yp);
  void fill(double t, const VectorX& y);
  double gaps();

  Equations& e_;
  const system::Regime& s_;
  system::Pattern pattern_;     ///< pattern for accelerations
  system::JacobianParts parts_; ///< Jacobian in that pattern
  SaddleMatrix matrix_;
  std::vector<Index> algebraic_; ///< unknowns of elements without a rate
  VectorX residual_, rhs_, x_, yp0_;
  std::unique_ptr<Pressed> pressed_; ///< null: no friction with a bearing
  std::string jam_;
};

} // namespace hydrodae::linalg
