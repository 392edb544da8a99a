#pragma once
/// Functions of time made of common wave components, at a cost almost independent of their number.

#include <array>
#include <complex>

#include "hydrodae/core/types.h"

namespace hydrodae::sea {

/// Coefficients C_ri exp(i theta_i); zero if |C_ri| is below least_r.
Eigen::MatrixXcd frozen_coefficients(const Eigen::MatrixXcd& coefficients, const VectorX& theta,
                                     const VectorX& least);

/// f_r(t) = ramp(t) Re sum_i C_ri exp(i w_i t)
///
/// Few components are summed directly. For many, a table on equal time steps with f, f' and f'' is
/// interpolated by quintic Hermite polynomials (two continuous derivatives). The error is h^6 w^6 /
/// 46080 of each component; the step keeps four standard deviations of it below 1e-8 of the
/// significant value (two standard deviations) of each f_r, or of its whole. Outside [0, end] the
/// sum is used.
///
/// Pages of the table are made on demand, and the last few are kept: memory does not grow with the
/// length of a run, and a value depends on its time alone. Not thread-safe.
class Signals {
public:
  static constexpr double tolerance = 1e-8;
  static constexpr Index few = 4; ///< largest number of components that are summed directly

  Signals() = default;

  /// @param omega (n,) [rad/s]
  /// @param coefficients C (n_signals, n)
  /// @param end the table covers 0 <= t <= end [s]
  /// @param ramp duration of the growth at the start [s]
  /// @param whole  (n_signals,) root of sum |C|^2 of the whole that each is a part of; empty: each
  /// is whole
  Signals(VectorX omega, Eigen::MatrixXcd coefficients, double end, double ramp,
          const VectorX& whole = {});

  /// Computes the first `out.size()` functions at time t [s]. Allocates nothing.
  void operator()(double t, Eigen::Ref<VectorX> out) const;

  /// Constant functions Re sum_i C_ri exp(i theta_i), without ramp: the waves at some later time.
  /// Entries of C below `least` (n_signals,) count as zero.
  Signals frozen(const VectorX& theta, const VectorX& least) const;

  /// The first `count` functions and the last one, on the same table steps.
  Signals first_and_last(Index count) const;

  Index size() const { return coefficients_.rows(); }
  Index components() const { return coefficients_.cols(); }
  bool empty() const { return coefficients_.rows() == 0; }
  double step() const { return step_; }           ///< step of the table [s]; 0 without table
  const VectorX& omega() const { return omega_; } ///< [rad/s]
  /// Coefficients C
  const Eigen::MatrixXcd& coefficients() const { return coefficients_; }
  /// Largest |C_ri| of each function
  VectorX largest() const { return coefficients_.cwiseAbs().rowwise().maxCoeff(); }

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  static constexpr Index points = 256; ///< number of points of a page
  struct Page {
    Index number = -1; ///< number of the page; -1: not made yet
    RowMajor values;   ///< (points, 3 n_signals, padded): f, h f', h^2 f''
  };
  void sum(double t, Eigen::Ref<VectorX> out) const;
  void make_table();
  void fill(Index number, Page& page) const;
  const double* at_point(Index k) const; ///< f, h f', h^2 f'' at t = k h; valid for one more call

  VectorX omega_;
  Eigen::MatrixXcd coefficients_;
  double ramp_ = 0.0, step_ = 0.0;
  Index cells_ = 0; ///< number of cells of the table
  RowMajor parts_;  ///< (2 n, 3 n_signals, padded) factors of cos w t and sin w t
  mutable std::array<Page, 4> pages_;
  mutable Eigen::Matrix<double, Eigen::Dynamic, 4> turned_; ///< cos and sin of h w, then of w t
  mutable RowMajor phasors_;                                ///< (2 n, slice) scratch
};

} // namespace hydrodae::sea
