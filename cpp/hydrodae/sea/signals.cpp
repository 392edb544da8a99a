#include "hydrodae/sea/signals.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/math/dense_cholesky.h"
#include "hydrodae/sea/component.h"

namespace hydrodae::sea {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Largest step that keeps the error of the quintic Hermite polynomial within the tolerance.
double table_step(const VectorX& omega, const Eigen::MatrixXcd& coefficients,
                  const VectorX& whole) {
  double step = INFINITY;
  for (Eigen::Index r = 0; r < coefficients.rows(); ++r) {
    const VectorX power = coefficients.row(r).cwiseAbs2().transpose();
    const double own = std::sqrt(power.sum());
    const double sigma = whole.size() > 0 ? std::max(own, whole[r]) : own;
    const double sigma_6 = std::sqrt(power.cwiseProduct(omega.array().pow(12.0).matrix()).sum());
    if (sigma_6 > 0.0)
      step = std::min(
          step, std::pow(46080.0 * Signals::tolerance * 2.0 * sigma / (4.0 * sigma_6), 1.0 / 6.0));
  }
  return step;
}

} // namespace

Signals::Signals(VectorX omega, Eigen::MatrixXcd coefficients, double end, double ramp,
                 const VectorX& whole)
    : omega_(std::move(omega)), coefficients_(std::move(coefficients)), ramp_(ramp) {
  const Eigen::Index n = omega_.size(), rows = coefficients_.rows();
  const double longest = table_step(omega_, coefficients_, whole);
  if (n <= few || !std::isfinite(longest))
    return;
  const auto cells = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(end / longest)));
  step_ = end / static_cast<double>(cells);
  // Re(C e) = [Re C, -Im C] [cos; sin], and the same for its derivatives, C i w and -C w^2.
  constexpr Eigen::Index chunk = 32 * dense::lanes;
  RowMajor parts = RowMajor::Zero(2 * n, dense::padded(3 * rows)), phasors(2 * n, chunk);
  Eigen::MatrixXcd scaled = coefficients_;
  for (int d = 0; d < 3; ++d) {
    parts.block(0, d * rows, n, rows) = scaled.real().transpose();
    parts.block(n, d * rows, n, rows) = -scaled.imag().transpose();
    scaled = scaled * (std::complex<double>(0.0, step_) * omega_).asDiagonal();
  }
  table_.resize(3 * rows, cells + 1);
  RowMajor values(chunk, parts.cols());
  for (Eigen::Index first = 0; first <= cells; first += chunk) {
    for (Eigen::Index i = 0; i < n; ++i) { // turned on from the first: few enough for rounding
      const double step = step_ * omega_[i], start = static_cast<double>(first) * step;
      const double a = std::cos(step), b = std::sin(step);
      double x = std::cos(start), y = std::sin(start);
      for (Eigen::Index k = 0; k < chunk; ++k) {
        phasors(i, k) = x;
        phasors(n + i, k) = y;
        const double next = a * x - b * y;
        y = a * y + b * x;
        x = next;
      }
    }
    values.setZero();
    dense::kernels().add_product(2 * n, chunk, phasors.data(), parts.cols(), parts.data(),
                                 values.data());
    const Eigen::Index count = std::min(chunk, cells + 1 - first);
    table_.middleCols(first, count) = values.topLeftCorner(count, 3 * rows).transpose();
  }
}

void Signals::operator()(double t, Eigen::Ref<VectorX> out) const {
  const double growth = ramp(t, ramp_);
  if (growth == 0.0) {
    out.setZero();
    return;
  }
  const double place = step_ > 0.0 ? t / step_ : -1.0;
  if (place < 0.0 || place > static_cast<double>(table_.cols() - 1)) {
    sum(t, out);
  } else {
    const auto k = std::min(static_cast<Eigen::Index>(place), table_.cols() - 2);
    const double x = place - static_cast<double>(k), y = 1.0 - x;
    const double x3 = x * x * x, y3 = y * y * y;
    // Basis of the right end in x; that of the left end is its mirror image.
    const double right0 = x3 * (10.0 - 15.0 * x + 6.0 * x * x), left0 = 1.0 - right0;
    const double right1 = x3 * (-4.0 + 7.0 * x - 3.0 * x * x);
    const double left1 = -y3 * (-4.0 + 7.0 * y - 3.0 * y * y);
    const double right2 = 0.5 * x3 * y * y, left2 = 0.5 * y3 * x * x;
    const Eigen::Index n = out.size(), rows = size();
    const auto a = table_.col(k), b = table_.col(k + 1);
    out.noalias() = left0 * a.segment(0, n) + right0 * b.segment(0, n) +
                    left1 * a.segment(rows, n) + right1 * b.segment(rows, n) +
                    left2 * a.segment(2 * rows, n) + right2 * b.segment(2 * rows, n);
  }
  if (growth != 1.0)
    out *= growth;
}

Eigen::MatrixXcd frozen_coefficients(const Eigen::MatrixXcd& coefficients, const VectorX& theta,
                                     const VectorX& least) {
  Eigen::MatrixXcd out(coefficients.rows(), coefficients.cols());
  for (Eigen::Index i = 0; i < coefficients.cols(); ++i)
    for (Eigen::Index r = 0; r < coefficients.rows(); ++r)
      out(r, i) = std::abs(coefficients(r, i)) < least[r]
                      ? std::complex<double>(0.0)
                      : coefficients(r, i) * std::polar(1.0, theta[i]);
  return out;
}

Signals Signals::frozen(const VectorX& theta, const VectorX& least) const {
  const VectorX sum = frozen_coefficients(coefficients_, theta, least).real().rowwise().sum();
  return {VectorX::Zero(1), sum.cast<std::complex<double>>(), 1.0, 0.0};
}

void Signals::sum(double t, Eigen::Ref<VectorX> out) const {
  out.setZero();
  for (Eigen::Index i = 0; i < omega_.size(); ++i) {
    const double c = std::cos(omega_[i] * t), s = std::sin(omega_[i] * t);
    for (Eigen::Index r = 0; r < out.size(); ++r)
      out[r] += coefficients_(r, i).real() * c - coefficients_(r, i).imag() * s;
  }
}

} // namespace hydrodae::sea
