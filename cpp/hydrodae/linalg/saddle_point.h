#pragma once
/// Accelerations, reactions and projections from one sparse saddle-point matrix:
///
///   [ M   G^T ] [  u'     ]   [ f                ]
///   [ G   -eD ] [ -lambda ] = [ -gamma (+ drive) ]
///
/// Friction that the reactions press is found after that (pressed_friction.cpp).

#include <memory>
#include <string>
#include <string_view>

#include "hydrodae/linalg/equations.h"
#include "hydrodae/linalg/saddle_matrix.h"

namespace hydrodae::linalg {

class SaddlePoint {
public:
  // Of `project`, gaps and rates in units of their scale:
  static constexpr int projections = 8;
  static constexpr double closed = 1e-13;  ///< gaps that need no further step
  static constexpr double stalled = 1e-10; ///< below it, gaps that no longer halve are rounding
  static constexpr double open = 1e-9;     ///< gaps that mean failure
  static constexpr double moving = 1e-8;   ///< rates likewise: the loop is locked

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
  double mismatch() { return matrix_.mismatch(rhs_, x_); }

  /// A direction of u (n_u,) that has no inertia and that no row of the last matrix holds. Empty:
  /// no body has one.
  VectorX undetermined() const { return matrix_.undetermined(); }

  /// Smallest eigenvalue of G M^-1 G^T against its diagonal [-], with the matrix of the last
  /// `accelerations`: 1 for rows that do not feel each other, 0 in a singular pose. Of each part of
  /// the rows by itself: rows of different parts have no body in common.
  /// @param part of each row (n_lambda,), below `parts`
  VectorX independence(const std::vector<int>& part, int parts) {
    return matrix_.independence(part, parts);
  }

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
  struct Pressed;
  bool press(double t, const VectorX& y, VectorX& yp);
  void fill(double t, const VectorX& y);
  double gaps();

  Equations& e_;
  const system::Regime& s_;
  system::Pattern pattern_;     ///< of what accelerations need
  system::JacobianParts parts_; ///< on it
  SaddleMatrix matrix_;
  std::vector<Index> algebraic_; ///< unknowns of elements that have no rate
  VectorX residual_, rhs_, x_, yp0_;
  std::unique_ptr<Pressed> pressed_; ///< null: no friction is pressed by its joint
  std::string jam_;
};

} // namespace hydrodae::linalg
