#pragma once
/// Functions of time that are quadratic in the wave components.
///
///   slow  F(t) = ramp(t)^2 (offset + sum_r s_r |u_r(t)|^2)
///   sum   F(t) = ramp(t)^2 Re sum_r s_r u_r(t)^2
///
/// with linear signals u_r(t) = sum_i v_ri exp(i w_i t) (Kac and Siegert, J. Appl. Phys. 18 (1947)
/// 383). They stand for all pairs of components.

#include <array>

#include "hydrodae/core/types.h"
#include "hydrodae/math/dual.h"
#include "hydrodae/sea/drifting.h"

namespace hydrodae::sea {

/// One function.
struct QuadraticForm {
  bool sum = false;    ///< at sums of frequencies, else at differences
  double offset = 0.0; ///< mean that the products lack
  VectorX s;           ///< (r,) load of each product
  Eigen::MatrixXcd v;  ///< (r, n) amplitudes of the linear signals
};

/// The functions by a table on equal time steps with F, F' and F'' joined by quintic Hermite
/// polynomials, as `Signals` does for linear ones. Differences of frequencies are slow; functions
/// at sums are tabulated as complex amplitudes of exp(2 i w_c t), which are as slow. Hence the step
/// is a multiple of that of the waves.
class QuadraticSignals {
public:
  static constexpr Index few = 4; ///< so many components are summed directly

  QuadraticSignals() = default;

  /// @param omega (n,) [rad/s]
  /// @param end the table covers 0 <= t <= end [s]
  /// @param ramp duration of the growth at the start [s]
  /// @param tolerance four standard deviations of the error of the table over the significant
  /// value (two standard deviations) of each function
  QuadraticSignals(VectorX omega, std::vector<QuadraticForm> forms, double end, double ramp,
                   double tolerance);

  /// All functions at time t [s]. No allocation.
  void operator()(double t, double* out) const;

  Index size() const { return std::ssize(forms_); }
  bool empty() const { return forms_.empty(); }
  double step() const { return step_; } ///< of the table [s]; 0 without table

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  static constexpr Index points = 256; ///< of a page
  struct Page {
    Index number = -1; ///< -1: not made yet
    RowMajor values;   ///< (points, 3 numbers): f, h f', h^2 f''
  };
  double longest_step(double tolerance) const;
  void make_table();
  void fill(Index number, Page& page) const;
  void combine(const double* signals, double* values) const;
  const double* at_point(Index k) const; ///< f, h f', h^2 f'' at t = k h; valid for one more call
  void sum(double t, double* out) const;

  VectorX omega_; ///< less the carrier [rad/s]
  double carrier_ = 0.0, ramp_ = 0.0, step_ = 0.0;
  std::vector<QuadraticForm> forms_;
  Index cells_ = 0, products_ = 0; ///< of the table; of all forms
  Index numbers_ = 0;              ///< tabulated: one of a slow function, two of one at sums
  RowMajor parts_; ///< (2 n, 6 products, padded) factors of cos w t and sin w t in u, h u', h^2 u''
  mutable std::array<Page, 4> pages_;
  mutable Eigen::Matrix<double, Eigen::Dynamic, 4> turned_; ///< cos and sin of h w, then of w t
  mutable RowMajor phasors_, signals_;                      ///< (2 n, slice), (slice, ...) scratch
};

/// The same of components whose phase follows a point that moves: (x, y) is its horizontal
/// displacement. Every evaluation sums all components.
class DriftingQuadratic {
public:
  DriftingQuadratic() = default;
  DriftingQuadratic(std::vector<Component> components, std::vector<QuadraticForm> forms,
                    double ramp);

  Index size() const { return std::ssize(forms_); }
  bool empty() const { return forms_.empty(); }

  /// Functions first .. first + count - 1.
  template <class S>
  void operator()(double t, const S& x, const S& y, Index first, Index count, S* out) const;

  /// Their derivatives by x and y.
  void slopes(double t, double x, double y, Index first, Index count, double* by_x,
              double* by_y) const;

private:
  Index rows(Index first, Index count) const {
    return 2 * (first_[at(first + count)] - first_[at(first)]);
  }
  static std::size_t at(Index k) { return static_cast<std::size_t>(k); }

  std::vector<QuadraticForm> forms_;
  std::vector<Index> first_; ///< (forms + 1,) product with which each begins
  DriftingSignals signals_;  ///< Re u, Im u of all products
  double ramp_ = 0.0;
};

} // namespace hydrodae::sea
