#include "hydrodae/sea/drifting.h"

#include <cmath>
#include <utility>

namespace hydrodae::sea {
namespace {

/// Memory for (n, 2) numbers; allocates nothing after a first call.
MatrixX& phasor_memory(Eigen::Index n) {
  thread_local MatrixX memory;
  if (memory.rows() != n)
    memory.resize(n, 2);
  return memory;
}

} // namespace

DriftingSignals::DriftingSignals(std::vector<Component> components, Eigen::MatrixXcd coefficients,
                                 double ramp)
    : components_(std::move(components)), coefficients_(std::move(coefficients)), ramp_(ramp) {
  const Eigen::Index n = std::ssize(components_);
  omega_.resize(n);
  kx_.resize(n);
  ky_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Component& w = components_[static_cast<std::size_t>(i)];
    omega_[i] = w.omega;
    kx_[i] = w.wavenumber * std::cos(w.heading);
    ky_[i] = w.wavenumber * std::sin(w.heading);
  }
  parts_.resize(coefficients_.rows(), 2 * n);
  parts_ << coefficients_.real(), -coefficients_.imag();
}

/// Writes the phasors for `parts_`: column [cos; sin] of the angles, for slopes the columns k [sin;
/// -cos], times the ramp.
Eigen::Ref<MatrixX> DriftingSignals::phasors(double t, double x, double y, bool slopes) const {
  const Eigen::Index n = omega_.size();
  MatrixX& out = phasor_memory(2 * n);
  const double growth = ramp(t, ramp_);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = omega_[i] * t - kx_[i] * x - ky_[i] * y;
    const double c = growth * std::cos(angle), s = growth * std::sin(angle);
    out(i, 0) = slopes ? kx_[i] * s : c;
    out(n + i, 0) = slopes ? -kx_[i] * c : s;
    if (slopes) {
      out(i, 1) = ky_[i] * s;
      out(n + i, 1) = -ky_[i] * c;
    }
  }
  return out;
}

void DriftingSignals::operator()(double t, double x, double y, Eigen::Index first,
                                 Eigen::Index count, double* out) const {
  Eigen::Map<VectorX>(out, count).noalias() =
      parts_.middleRows(first, count) * phasors(t, x, y, false).col(0);
}

void DriftingSignals::slopes(double t, double x, double y, Eigen::Index first, Eigen::Index count,
                             double* by_x, double* by_y) const {
  const Eigen::Ref<MatrixX> waves = phasors(t, x, y, true);
  Eigen::Map<VectorX>(by_x, count).noalias() = parts_.middleRows(first, count) * waves.col(0);
  Eigen::Map<VectorX>(by_y, count).noalias() = parts_.middleRows(first, count) * waves.col(1);
}

void DriftingSignals::operator()(double t, const Dual& x, const Dual& y, Eigen::Index first,
                                 Eigen::Index count, Dual* out) const {
  const Dual growth = ramp(t, ramp_);
  for (Eigen::Index r = 0; r < count; ++r)
    out[r] = 0.0;
  for (Eigen::Index i = 0; i < omega_.size(); ++i) {
    const Dual angle = omega_[i] * t - kx_[i] * x - ky_[i] * y;
    const Dual c = growth * cos(angle), s = growth * sin(angle);
    for (Eigen::Index r = 0; r < count; ++r) {
      const std::complex<double> C = coefficients_(first + r, i);
      out[r] += C.real() * c - C.imag() * s;
    }
  }
}

} // namespace hydrodae::sea
