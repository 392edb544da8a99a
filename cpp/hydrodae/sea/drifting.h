#pragma once
/// Functions of time made of wave components whose phase follows a point that moves.

#include "hydrodae/math/dual.h"
#include "hydrodae/sea/component.h"
#include "hydrodae/sea/signals.h"

namespace hydrodae::sea {

/// f_r(t, x, y) = ramp(t) Re sum_i C_ri exp(i (w_i t - k_i (x cos b_i + y sin b_i)))
///
/// (x, y) is the horizontal displacement of the point from the place that C refers to. Every
/// evaluation sums all components.
class DriftingSignals {
public:
  DriftingSignals() = default;

  /// @param components w, k and b
  /// @param coefficients C (n_signals, n)
  /// @param ramp duration of the growth at the start [s]
  DriftingSignals(std::vector<Component> components, Eigen::MatrixXcd coefficients, double ramp);

  /// Functions without ramp, each component i ahead by theta_i; see Signals::frozen.
  DriftingSignals frozen(const VectorX& theta, const VectorX& least) const {
    return {components_, frozen_coefficients(coefficients_, theta, least), 0.0};
  }

  Eigen::Index size() const { return coefficients_.rows(); }
  Eigen::Index components() const { return coefficients_.cols(); }
  /// Largest |C_ri| of each function
  VectorX largest() const { return coefficients_.cwiseAbs().rowwise().maxCoeff(); }
  bool empty() const { return coefficients_.rows() == 0; }
  const std::vector<Component>& waves() const { return components_; }
  const Eigen::MatrixXcd& coefficients() const { return coefficients_; } ///< coefficients C

  /// Computes the functions first .. first + count - 1. Allocates on the first call only.
  void operator()(double t, double x, double y, Eigen::Index first, Eigen::Index count,
                  double* out) const;

  /// Computes the derivatives of the functions by x and y.
  void slopes(double t, double x, double y, Eigen::Index first, Eigen::Index count, double* by_x,
              double* by_y) const;

  /// Computes the functions of dual numbers, term by term.
  void operator()(double t, const Dual& x, const Dual& y, Eigen::Index first, Eigen::Index count,
                  Dual* out) const;

private:
  Eigen::Ref<MatrixX> phasors(double t, double x, double y, bool slopes) const;

  std::vector<Component> components_;
  Eigen::MatrixXcd coefficients_;
  VectorX omega_, kx_, ky_;
  MatrixX parts_; ///< [Re C, -Im C]
  double ramp_ = 0.0;
};

} // namespace hydrodae::sea
