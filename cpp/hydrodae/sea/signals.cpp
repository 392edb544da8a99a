#include "hydrodae/sea/signals.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/math/dense_cholesky.h"
#include "hydrodae/sea/component.h"

namespace hydrodae::sea {
namespace {

constexpr Index slice = 32; ///< number of points of a page whose phasors are made at once

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
  const double longest = table_step(omega_, coefficients_, whole);
  if (omega_.size() <= few || !std::isfinite(longest))
    return;
  cells_ = std::max<Index>(1, static_cast<Index>(std::ceil(end / longest)));
  step_ = end / static_cast<double>(cells_);
  make_table();
}

Signals Signals::first_and_last(Index count) const {
  Signals out = *this;
  out.coefficients_.resize(count + 1, components());
  out.coefficients_ << coefficients_.topRows(count), coefficients_.bottomRows(1);
  if (step_ > 0.0)
    out.make_table();
  return out;
}

void Signals::make_table() {
  const Index n = omega_.size(), rows = coefficients_.rows();
  // Re(C e) = [Re C, -Im C] [cos; sin], and the same for its derivatives, C i w and -C w^2.
  parts_ = RowMajor::Zero(2 * n, dense::padded(3 * rows));
  Eigen::MatrixXcd scaled = coefficients_;
  for (int d = 0; d < 3; ++d) {
    parts_.block(0, d * rows, n, rows) = scaled.real().transpose();
    parts_.block(n, d * rows, n, rows) = -scaled.imag().transpose();
    scaled = scaled * (std::complex<double>(0.0, step_) * omega_).asDiagonal();
  }
  turned_.resize(n, 4);
  for (Index i = 0; i < n; ++i)
    turned_.row(i).head<2>() << std::cos(step_ * omega_[i]), std::sin(step_ * omega_[i]);
  phasors_.resize(2 * n, slice);
  for (Page& page : pages_) {
    page.number = -1;
    page.values.resize(points, parts_.cols());
  }
}

/// Rotates the phasors of each slice from the last one; each page restarts before rounding matters.
void Signals::fill(Index number, Page& page) const {
  const Index n = omega_.size();
  for (Index i = 0; i < n; ++i) {
    const double angle = static_cast<double>(number * points) * (step_ * omega_[i]);
    turned_.row(i).tail<2>() << std::cos(angle), std::sin(angle);
  }
  page.values.setZero();
  for (Index first = 0; first < points; first += slice) {
    for (Index i = 0; i < n; ++i) {
      const double a = turned_(i, 0), b = turned_(i, 1);
      double x = turned_(i, 2), y = turned_(i, 3);
      for (Index k = 0; k < slice; ++k) {
        phasors_(i, k) = x;
        phasors_(n + i, k) = y;
        const double next = a * x - b * y;
        y = a * y + b * x;
        x = next;
      }
      turned_(i, 2) = x;
      turned_(i, 3) = y;
    }
    dense::kernels().add_product(2 * n, slice, phasors_.data(), parts_.cols(), parts_.data(),
                                 page.values.row(first).data());
  }
  page.number = number;
}

const double* Signals::at_point(Index k) const {
  const Index number = k / points;
  Page& page = pages_[static_cast<std::size_t>(number) % pages_.size()];
  if (page.number != number)
    fill(number, page);
  return page.values.row(k - number * points).data();
}

void Signals::operator()(double t, Eigen::Ref<VectorX> out) const {
  const double growth = ramp(t, ramp_);
  if (growth == 0.0) {
    out.setZero();
    return;
  }
  const double place = step_ > 0.0 ? t / step_ : -1.0;
  if (place < 0.0 || place > static_cast<double>(cells_)) {
    sum(t, out);
  } else {
    const auto k = std::min(static_cast<Index>(place), cells_ - 1);
    const double x = place - static_cast<double>(k), y = 1.0 - x;
    const double x3 = x * x * x, y3 = y * y * y;
    // Basis of the right end in x; that of the left end is its mirror image.
    const double right0 = x3 * (10.0 - 15.0 * x + 6.0 * x * x), left0 = 1.0 - right0;
    const double right1 = x3 * (-4.0 + 7.0 * x - 3.0 * x * x);
    const double left1 = -y3 * (-4.0 + 7.0 * y - 3.0 * y * y);
    const double right2 = 0.5 * x3 * y * y, left2 = 0.5 * y3 * x * x;
    const Index n = out.size(), rows = size();
    const Eigen::Map<const VectorX> a(at_point(k), 3 * rows), b(at_point(k + 1), 3 * rows);
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
