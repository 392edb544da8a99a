#include "hydrodae/sea/quadratic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hydrodae/math/dense_cholesky.h"

namespace hydrodae::sea {
namespace {

constexpr Index phasor_slice = 32; ///< points of a page whose phasors are made at once

using Complex = std::complex<double>;

/// Memory for n numbers; allocates nothing after a first call.
template <class S> S* product_memory(Index n) {
  thread_local std::vector<S> memory;
  if (std::ssize(memory) < n)
    memory.resize(static_cast<std::size_t>(n));
  return memory.data();
}

} // namespace

QuadraticSignals::QuadraticSignals(VectorX omega, std::vector<QuadraticForm> forms, double end,
                                   double ramp, double tolerance)
    : omega_(std::move(omega)), ramp_(ramp), forms_(std::move(forms)) {
  double weight = 0.0;
  for (const QuadraticForm& form : forms_) {
    products_ += form.s.size();
    numbers_ += form.sum ? 2 : 1;
    for (Index r = 0; r < form.s.size() && form.sum; ++r) {
      const VectorX power = std::abs(form.s[r]) * form.v.row(r).cwiseAbs2().transpose();
      carrier_ += power.dot(omega_);
      weight += power.sum();
    }
  }
  carrier_ = weight > 0.0 ? carrier_ / weight : 0.0;
  omega_.array() -= carrier_;
  const double longest = longest_step(tolerance);
  if (omega_.size() <= few || !std::isfinite(longest))
    return;
  cells_ = std::max<Index>(1, static_cast<Index>(std::ceil(end / longest)));
  step_ = end / static_cast<double>(cells_);
  make_table();
}

/// The error of the quintic Hermite polynomial is h^6 w^6 / 46080 of each pair of components, w its
/// difference of frequencies, or its sum less that of two carriers.
double QuadraticSignals::longest_step(double tolerance) const {
  double step = INFINITY;
  for (const QuadraticForm& form : forms_) {
    const Eigen::MatrixXcd left = form.v.transpose() * form.s.asDiagonal();
    const MatrixX pairs =
        (form.sum ? Eigen::MatrixXcd(left * form.v) : Eigen::MatrixXcd(left * form.v.conjugate()))
            .cwiseAbs2();
    double square = 0.0, square_6 = 0.0;
    for (Index j = 0; j < omega_.size(); ++j)
      for (Index i = 0; i < omega_.size(); ++i) {
        const double w = form.sum ? omega_[i] + omega_[j] : omega_[i] - omega_[j];
        square += pairs(i, j);
        square_6 += pairs(i, j) * std::pow(w * w, 6);
      }
    if (square_6 > 0.0)
      step = std::min(
          step, std::pow(46080.0 * tolerance * 0.5 * std::sqrt(square / square_6), 1.0 / 6.0));
  }
  return step;
}

void QuadraticSignals::make_table() {
  const Index n = omega_.size();
  Eigen::MatrixXcd v(products_, n);
  Index first = 0;
  for (const QuadraticForm& form : forms_) {
    v.middleRows(first, form.s.size()) = form.v;
    first += form.s.size();
  }
  // Re(v e) = [Re v, -Im v] [cos; sin], Im(v e) = [Im v, Re v] [cos; sin].
  parts_ = RowMajor::Zero(2 * n, dense::padded(6 * products_));
  for (int d = 0; d < 3; ++d) {
    const Index re = 2 * d * products_, im = re + products_;
    parts_.block(0, re, n, products_) = v.real().transpose();
    parts_.block(n, re, n, products_) = -v.imag().transpose();
    parts_.block(0, im, n, products_) = v.imag().transpose();
    parts_.block(n, im, n, products_) = v.real().transpose();
    v = v * (Complex(0.0, step_) * omega_).asDiagonal();
  }
  turned_.resize(n, 4);
  for (Index i = 0; i < n; ++i)
    turned_.row(i).head<2>() << std::cos(step_ * omega_[i]), std::sin(step_ * omega_[i]);
  phasors_.resize(2 * n, phasor_slice);
  signals_.resize(phasor_slice, parts_.cols());
  for (Page& page : pages_) {
    page.number = -1;
    page.values.resize(points, 3 * numbers_);
  }
}

/// f, h f' and h^2 f'' of all functions from u, h u' and h^2 u'' of all products.
void QuadraticSignals::combine(const double* signals, double* values) const {
  const Index P = products_;
  Index r = 0, out = 0;
  for (const QuadraticForm& form : forms_) {
    double f[3] = {form.offset, 0.0, 0.0}, g[3] = {0.0, 0.0, 0.0};
    for (Index k = 0; k < form.s.size(); ++k, ++r) {
      const double s = form.s[k];
      const double a = signals[r], b = signals[P + r], a1 = signals[2 * P + r],
                   b1 = signals[3 * P + r], a2 = signals[4 * P + r], b2 = signals[5 * P + r];
      if (form.sum) {
        f[0] += s * (a * a - b * b);
        g[0] += s * 2.0 * a * b;
        f[1] += s * 2.0 * (a * a1 - b * b1);
        g[1] += s * 2.0 * (a * b1 + b * a1);
        f[2] += s * 2.0 * (a1 * a1 - b1 * b1 + a * a2 - b * b2);
        g[2] += s * 2.0 * (2.0 * a1 * b1 + a * b2 + b * a2);
      } else {
        f[0] += s * (a * a + b * b);
        f[1] += s * 2.0 * (a * a1 + b * b1);
        f[2] += s * 2.0 * (a1 * a1 + b1 * b1 + a * a2 + b * b2);
      }
    }
    for (int d = 0; d < 3; ++d)
      values[d * numbers_ + out] = f[d];
    ++out;
    if (!form.sum)
      continue;
    for (int d = 0; d < 3; ++d)
      values[d * numbers_ + out] = g[d];
    ++out;
  }
}

/// The phasors of each slice are turned on from those before it; each page begins again.
void QuadraticSignals::fill(Index number, Page& page) const {
  const Index n = omega_.size();
  const double start = static_cast<double>(number * points) * step_;
  for (Index i = 0; i < n; ++i) {
    turned_(i, 2) = std::cos(omega_[i] * start);
    turned_(i, 3) = std::sin(omega_[i] * start);
  }
  for (Index first = 0; first < points; first += phasor_slice) {
    for (Index i = 0; i < n; ++i) {
      const double a = turned_(i, 0), b = turned_(i, 1);
      double x = turned_(i, 2), y = turned_(i, 3);
      for (Index k = 0; k < phasor_slice; ++k) {
        phasors_(i, k) = x;
        phasors_(n + i, k) = y;
        const double next = a * x - b * y;
        y = a * y + b * x;
        x = next;
      }
      turned_(i, 2) = x;
      turned_(i, 3) = y;
    }
    signals_.setZero();
    dense::kernels().add_product(2 * n, phasor_slice, phasors_.data(), parts_.cols(), parts_.data(),
                                 signals_.data());
    for (Index k = 0; k < phasor_slice; ++k)
      combine(signals_.row(k).data(), page.values.row(first + k).data());
  }
  page.number = number;
}

const double* QuadraticSignals::at_point(Index k) const {
  const Index number = k / points;
  Page& page = pages_[static_cast<std::size_t>(number) % pages_.size()];
  if (page.number != number)
    fill(number, page);
  return page.values.row(k - number * points).data();
}

void QuadraticSignals::sum(double t, double* out) const {
  for (const QuadraticForm& form : forms_) {
    Complex total = form.offset;
    for (Index r = 0; r < form.s.size(); ++r) {
      Complex u = 0.0;
      for (Index i = 0; i < omega_.size(); ++i)
        u += form.v(r, i) * std::polar(1.0, (omega_[i] + carrier_) * t);
      total += form.s[r] * (form.sum ? u * u : Complex(std::norm(u)));
    }
    *out++ = total.real();
  }
}

void QuadraticSignals::operator()(double t, double* out) const {
  const double growth = ramp(t, ramp_);
  if (growth == 0.0) {
    std::fill_n(out, forms_.size(), 0.0);
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
    const double *a = at_point(k), *b = at_point(k + 1);
    const auto value = [&](Index i) {
      const Index d = numbers_;
      return left0 * a[i] + right0 * b[i] + left1 * a[d + i] + right1 * b[d + i] +
             left2 * a[2 * d + i] + right2 * b[2 * d + i];
    };
    const double c = std::cos(2.0 * carrier_ * t), s = std::sin(2.0 * carrier_ * t);
    Index i = 0;
    for (std::size_t j = 0; j < forms_.size(); ++j) {
      out[j] = forms_[j].sum ? c * value(i) - s * value(i + 1) : value(i);
      i += forms_[j].sum ? 2 : 1;
    }
  }
  for (std::size_t j = 0; j < forms_.size(); ++j)
    out[j] *= growth * growth;
}

DriftingQuadratic::DriftingQuadratic(std::vector<Component> components,
                                     std::vector<QuadraticForm> forms, double ramp)
    : forms_(std::move(forms)), first_{0}, ramp_(ramp) {
  for (const QuadraticForm& form : forms_)
    first_.push_back(first_.back() + form.s.size());
  Eigen::MatrixXcd rows(2 * first_.back(), std::ssize(components));
  for (std::size_t k = 0; k < forms_.size(); ++k) {
    const Index n = forms_[k].s.size();
    rows.middleRows(2 * first_[k], n) = forms_[k].v;
    rows.middleRows(2 * first_[k] + n, n) = Complex(0.0, -1.0) * forms_[k].v; // Re(-i u) = Im u
  }
  signals_ = DriftingSignals(std::move(components), std::move(rows), ramp);
}

template <class S>
void DriftingQuadratic::operator()(double t, const S& x, const S& y, Index first, Index count,
                                   S* out) const {
  const Index n = rows(first, count);
  S* u = product_memory<S>(n);
  if (n > 0)
    signals_(t, x, y, 2 * first_[at(first)], n, u);
  const double growth = ramp(t, ramp_);
  for (Index k = first; k < first + count; ++k) {
    const QuadraticForm& form = forms_[at(k)];
    const Index products = form.s.size();
    S total(form.offset * growth * growth);
    for (Index r = 0; r < products; ++r) {
      const S a = u[r], b = u[products + r];
      total += S(form.s[r]) * (form.sum ? a * a - b * b : a * a + b * b);
    }
    *out++ = total;
    u += 2 * products;
  }
}

template void DriftingQuadratic::operator()(double, const double&, const double&, Index, Index,
                                            double*) const;
template void DriftingQuadratic::operator()(double, const Dual&, const Dual&, Index, Index,
                                            Dual*) const;

void DriftingQuadratic::slopes(double t, double x, double y, Index first, Index count, double* by_x,
                               double* by_y) const {
  const Index n = rows(first, count);
  double *u = product_memory<double>(3 * n), *u_x = u + n, *u_y = u_x + n;
  if (n > 0) {
    signals_(t, x, y, 2 * first_[at(first)], n, u);
    signals_.slopes(t, x, y, 2 * first_[at(first)], n, u_x, u_y);
  }
  for (Index k = first, r = 0; k < first + count; ++k) {
    const QuadraticForm& form = forms_[at(k)];
    const Index products = form.s.size();
    *by_x = *by_y = 0.0;
    for (Index j = 0; j < products; ++j, ++r) {
      const double a = 2.0 * form.s[j] * u[r],
                   b = (form.sum ? -2.0 : 2.0) * form.s[j] * u[products + r];
      *by_x += a * u_x[r] + b * u_x[products + r];
      *by_y += a * u_y[r] + b * u_y[products + r];
    }
    r += products;
    ++by_x;
    ++by_y;
  }
}

} // namespace hydrodae::sea
