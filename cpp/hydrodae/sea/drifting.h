#pragma once
/// Functions of time made of wave components whose phase follows a point that moves.

#include <cmath>
#include <utility>

#include "hydrodae/sea/components.h"
#include "hydrodae/sea/signals.h"

namespace hydrodae::sea {

/// f_r(t, x, y) = ramp(t) Re sum_i C_ri exp(i (w_i t - k_i (x cos b_i + y sin b_i)))
///
/// (x, y) is the horizontal displacement of the point from where C was made for. Every evaluation
/// sums all components.
class DriftingSignals {
public:
  DriftingSignals() = default;

  /// @param components w, k and b
  /// @param coefficients C (n_signals, n)
  /// @param ramp duration of the growth at the start [s]
  DriftingSignals(std::vector<Component> components, Eigen::MatrixXcd coefficients, double ramp)
      : components_(std::move(components)), coefficients_(std::move(coefficients)), ramp_(ramp) {}

  /// The same without ramp, each component i ahead by theta_i; see Signals::frozen.
  DriftingSignals frozen(const VectorX& theta, const VectorX& least) const {
    return {components_, frozen_coefficients(coefficients_, theta, least), 0.0};
  }

  Eigen::Index size() const { return coefficients_.rows(); }
  Eigen::Index components() const { return coefficients_.cols(); }
  VectorX largest() const { return coefficients_.cwiseAbs().rowwise().maxCoeff(); } ///< |C_ri|
  bool empty() const { return coefficients_.rows() == 0; }
  const std::vector<Component>& waves() const { return components_; }
  const Eigen::MatrixXcd& coefficients() const { return coefficients_; } ///< C

  /// Functions first .. first + count - 1 into `out`; their derivatives by x and y where these are
  /// not null. No allocation.
  template <class S>
  void operator()(double t, const S& x, const S& y, Eigen::Index first, Eigen::Index count, S* out,
                  S* by_x = nullptr, S* by_y = nullptr) const {
    using std::cos, std::sin;
    for (Eigen::Index r = 0; r < count; ++r) {
      out[r] = S(0);
      if (by_x)
        by_x[r] = by_y[r] = S(0);
    }
    const double growth = ramp(t, ramp_);
    if (growth == 0.0)
      return;
    Eigen::Index i = 0;
    for (const Component& w : components_) {
      const double kx = w.wavenumber * std::cos(w.heading), ky = w.wavenumber * std::sin(w.heading);
      const S angle = S(w.omega * t) - S(kx) * x - S(ky) * y;
      const S c = S(growth) * cos(angle), s = S(growth) * sin(angle);
      for (Eigen::Index r = 0; r < count; ++r) {
        const std::complex<double> C = coefficients_(first + r, i);
        out[r] += S(C.real()) * c - S(C.imag()) * s;
        if (by_x) {
          const S slope = S(C.real()) * s + S(C.imag()) * c; // minus d/d angle
          by_x[r] += S(kx) * slope;
          by_y[r] += S(ky) * slope;
        }
      }
      ++i;
    }
  }

private:
  std::vector<Component> components_;
  Eigen::MatrixXcd coefficients_;
  double ramp_ = 0.0;
};

} // namespace hydrodae::sea
