#include "hydrodae/integrate/stage_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hydrodae::integrate {

namespace {
constexpr double rounding = 1e2 * std::numeric_limits<double>::epsilon();
// Error of the iteration in units of the error tolerance. It adds up over the steps where the
// truncation error, which the estimate of lower order exaggerates, does not.
constexpr double accuracy = 1e-3;
} // namespace

StageNewton::StageNewton(linalg::Equations& equations, const RungeKutta& rk)
    : e_(equations), rk_(rk),
      real_(std::make_unique<linalg::NewtonMatrix<double>>(e_.system, e_.pattern)) {
  const Index n = e_.system.n;
  for (std::size_t k = 0; k < rk_.pairs.size(); ++k)
    pairs_.push_back(
        std::make_unique<linalg::NewtonMatrix<std::complex<double>>>(e_.system, e_.pattern));
  stage_ = rate_ = residual_ = work_ = MatrixX::Zero(n, rk_.stages);
  y_ = yp_ = r_ = VectorX::Zero(n);
  complex_.resize(static_cast<std::size_t>(n));
}

bool StageNewton::factorise(double h) {
  bool good = real_->factorise(e_.parts, 1.0 / (rk_.gamma0 * h));
  for (std::size_t p = 0; p < pairs_.size() && good; ++p)
    good = pairs_[p]->factorise(e_.parts, rk_.pairs[p] / h);
  if (good && renewal_ == 0.0) {
    one_ = real_->work();
    renewal_ = find_renewal();
  }
  e_.statistics.factor_work += n_systems() * one_.factorise;
  return good;
}

/// Real systems that cost as much as those of all eigenvalues: a complex one is worth two.
double StageNewton::n_systems() const { return 1.0 + 2.0 * static_cast<double>(pairs_.size()); }

/// By the operations of the matrix for one stage.
double StageNewton::find_renewal() const {
  const auto entries = static_cast<double>(e_.pattern.row.size());
  return (n_systems() * one_.factorise + linalg::of_jacobian * entries) /
         (n_systems() * one_.solve + linalg::of_residual * entries * rk_.stages);
}

void StageNewton::rates(double h, const MatrixX& Z, MatrixX& out) const {
  out.noalias() = Z.lazyProduct(rk_.a_inverse.transpose()); // of few columns: no blocks
  out /= h;
}

bool StageNewton::residuals(double t, double h, const VectorX& y0, const MatrixX& Z) {
  rates(h, Z, rate_);
  stage_ = Z.colwise() + y0;
  for (int i = 0; i < rk_.stages; ++i) {
    y_ = stage_.col(i);
    yp_ = rate_.col(i);
    if (!e_.residual(t + rk_.c[i] * h, y_, yp_, r_))
      return false;
    residual_.col(i) = r_;
  }
  return true;
}

/// Root mean square over all stages of positions, velocities and memory states. Multipliers follow
/// from these linearly; in a singular pose they are not unique, and say nothing.
double StageNewton::size(const VectorX& w, const MatrixX& dZ) const {
  const Index d = e_.system.lambda0;
  if (e_.system.n_error_groups() <= 1)
    return std::sqrt((dZ.topRows(d).array().colwise() * w.head(d).array()).square().sum() /
                     static_cast<double>(std::max<Index>(d * rk_.stages, 1)));
  const VectorX squares =
      dZ.topRows(d).rowwise().squaredNorm().cwiseProduct(w.head(d).cwiseAbs2()) / rk_.stages;
  return linalg::largest_by_group(e_.system, squares.data(), sums_);
}

/// Newton with increments by `solve`, which overwrites residual_ with the increment (sign as in
/// Z -= increment) and returns false where it cannot. Increments below `stalled` that no longer
/// shrink are rounding: converged.
template <class Solve>
NewtonResult StageNewton::iterate(double t, double h, const VectorX& y0, const VectorX& w,
                                  MatrixX& Z, int most, double stalled, Solve&& solve) {
  double before = 0.0;
  // Rounding of the residual as the unknowns feel it sets a floor.
  const Index n_q = e_.system.n_q;
  const double floor =
      rounding *
      std::max(1.0 / e_.rtol, y0.head(n_q).cwiseProduct(w.head(n_q)).lpNorm<Eigen::Infinity>());
  contraction = 0.0;
  for (iterations = 1; iterations <= most; ++iterations) {
    if (!residuals(t, h, y0, Z) || !solve())
      return NewtonResult::failed;
    Z -= residual_;
    ++e_.statistics.newton_iterations;
    const double now = size(w, residual_);
    if (!std::isfinite(now))
      return NewtonResult::failed;

    if (now <= floor)
      return NewtonResult::converged;
    if (iterations > 1) {
      const double rate = now / before;
      contraction = iterations == 2 ? rate : std::sqrt(contraction * rate);
      if (rate < 1.0 && rate / (1.0 - rate) * now <= accuracy)
        return NewtonResult::converged;
      if (rate >= 0.98 ||
          (iterations > 2 && now * std::pow(rate, most - iterations) > accuracy * 10.0))
        return now <= std::max(10.0 * floor, stalled) ? NewtonResult::converged
                                                      : NewtonResult::slow;
    }
    before = now;
  }
  return NewtonResult::slow;
}

NewtonResult StageNewton::simplified(double t, double h, const VectorX& y0, const VectorX& w,
                                     MatrixX& Z) {
  const int most = 7 + rk_.stages;
  return iterate(t, h, y0, w, Z, most, accuracy, [&] {
    // W = (T^-1 x I) dZ decouples: a real system and complex ones, x + i y from the pair's columns.
    work_.noalias() = residual_.lazyProduct(rk_.T_inverse.transpose());
    int column = 0;
    if (!rk_.real.empty())
      real_->solve(work_.col(column++).data());
    for (std::unique_ptr<linalg::NewtonMatrix<std::complex<double>>>& lu : pairs_) {
      for (Index k = 0; k < e_.system.n; ++k)
        complex_[static_cast<std::size_t>(k)] = {work_(k, column), work_(k, column + 1)};
      lu->solve(complex_.data());
      for (Index k = 0; k < e_.system.n; ++k) {
        work_(k, column) = complex_[static_cast<std::size_t>(k)].real();
        work_(k, column + 1) = complex_[static_cast<std::size_t>(k)].imag();
      }
      column += 2;
    }
    residual_.noalias() = work_.lazyProduct(rk_.T.transpose());
    e_.statistics.factor_work += n_systems() * one_.solve;
    return true;
  });
}

/// Pattern of all stages: J and B in the diagonal blocks, B elsewhere.
void StageNewton::make_full() {
  const int s = rk_.stages;
  full_ = std::make_unique<Full>(system::find_pattern(e_.system));
  const system::Pattern& p = full_->pattern;
  full_->slots.assign(static_cast<std::size_t>(s * s), std::vector<Index>(p.row.size(), -1));
  full_->start.assign(1, 0);
  for (int j = 0; j < s; ++j)
    for (Index c = 0; c < p.n; ++c) {
      for (int i = 0; i < s; ++i)
        for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k) {
          if (i != j && !p.has_rate[static_cast<std::size_t>(k)])
            continue;
          full_->slots[static_cast<std::size_t>(i * s + j)][static_cast<std::size_t>(k)] =
              static_cast<Index>(full_->row.size());
          full_->row.push_back(i * p.n + p.row[static_cast<std::size_t>(k)]);
        }
      if (c >= e_.system.lambda0 && c < e_.system.sigma0) {
        const auto first = p.row.begin() + p.column_start[c],
                   last = p.row.begin() + p.column_start[c + 1];
        const bool present = std::find(first, last, c) != last; // mu = 0 in other formulations
        full_->diagonal.push_back(present ? -1 : static_cast<Index>(full_->row.size()));
        if (!present)
          full_->row.push_back(j * p.n + c);
      }
      full_->start.push_back(static_cast<Index>(full_->row.size()));
    }
  // Unknown by unknown, all stages of each, in the order of the matrix of one stage: its fill, in
  // blocks of s x s.
  const linalg::Elimination one =
      e_.system.has_memory() ? linalg::SparseLu<double>(p.column_start, p.row).elimination()
                             : real_->elimination();
  linalg::Elimination all;
  for (std::size_t k = 0; k < one.row.size(); ++k)
    for (int i = 0; i < s; ++i) {
      all.row.push_back(i * p.n + one.row[k]);
      all.column.push_back(i * p.n + one.column[k]);
    }
  full_->lu = std::make_unique<linalg::SparseLu<double>>(full_->start, full_->row, all);
}

bool StageNewton::factorise_full(double t, double h) {
  const int s = rk_.stages;
  const std::size_t nonzeros = full_->pattern.row.size();
  const system::JacobianParts& parts = full_->parts;
  std::vector<double>& values = full_->lu->values();
  const double alpha = 1.0 / (rk_.gamma0 * h);
  VectorX regular(e_.system.sigma0 - e_.system.lambda0);
  for (int i = 0; i < s; ++i) {
    y_ = stage_.col(i);
    yp_ = rate_.col(i);
    e_.jacobian(t + rk_.c[i] * h, y_, yp_);
    e_.regularisation(alpha, regular);
    if (e_.system.has_memory())
      e_.jacobian(t + rk_.c[i] * h, y_, yp_, full_->pattern, full_->parts);
    else
      std::swap(e_.parts, full_->parts);
    for (Index m = 0; m < regular.size(); ++m) {
      const Index slot = full_->diagonal[static_cast<std::size_t>(i * regular.size() + m)];
      if (slot >= 0)
        values[static_cast<std::size_t>(slot)] = regular[m];
    }
    for (int j = 0; j < s; ++j) {
      const std::vector<Index>& slots = full_->slots[static_cast<std::size_t>(i * s + j)];
      const double factor = rk_.a_inverse(i, j) / h;
      for (std::size_t k = 0; k < nonzeros; ++k)
        if (slots[k] >= 0)
          values[static_cast<std::size_t>(slots[k])] =
              (i == j ? parts.by_y[k] : 0.0) + factor * parts.by_yp[k];
    }
  }
  if (!full_->lu->factorise())
    return false;
  if (full_->work.factorise == 0.0)
    full_->work = full_->lu->work();
  e_.statistics.factor_work += full_->work.factorise;
  return true;
}

NewtonResult StageNewton::full(double t, double h, const VectorX& y0, const VectorX& w,
                               MatrixX& Z) {
  if (!full_)
    make_full();
  // At a stage close to a singular pose rounding keeps the increments above any finer bound.
  const double stalled = 0.5;
  return iterate(t, h, y0, w, Z, 15, stalled, [&] {
    const bool settled = iterations > 2 && contraction < 0.01; // then the matrix serves on
    if (!settled && !factorise_full(t, h))
      return false;
    full_->lu->solve(residual_.data()); // columns one after the other: the order of the blocks
    e_.statistics.factor_work += full_->work.solve;
    return true;
  });
}

} // namespace hydrodae::integrate
