#include "hydrodae/integrate/stage_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hydrodae::integrate {

namespace {
constexpr double rounding = 1e2 * std::numeric_limits<double>::epsilon();
// Error of the iteration in units of the error tolerance. It accumulates over the steps; the
// truncation error, which the lower-order estimate exaggerates, does not.
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

/// Number of real systems with the cost of all eigenvalues: a complex one counts as two.
double StageNewton::n_systems() const { return 1.0 + 2.0 * static_cast<double>(pairs_.size()); }

/// Cost of a renewal in iterations, from the operations of the matrix for one stage.
double StageNewton::find_renewal() const {
  const auto entries = static_cast<double>(e_.pattern.row.size());
  return (n_systems() * one_.factorise + linalg::of_jacobian * entries) /
         (n_systems() * one_.solve + linalg::of_residual * entries * rk_.stages);
}

void StageNewton::rates(double h, const MatrixX& Z, MatrixX& out) const {
  out.noalias() = Z.lazyProduct(rk_.a_inverse.transpose()); // few columns: no blocks
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

/// Root mean square over all stages of positions, velocities and memory states. Multipliers depend
/// linearly on these, and are not unique in a singular pose.
double StageNewton::size(const VectorX& w, const MatrixX& dZ) const {
  const Index d = e_.system.lambda0;
  if (e_.system.n_error_groups() <= 1)
    return std::sqrt((dZ.topRows(d).array().colwise() * w.head(d).array()).square().sum() /
                     static_cast<double>(std::max<Index>(d * rk_.stages, 1)));
  const VectorX squares =
      dZ.topRows(d).rowwise().squaredNorm().cwiseProduct(w.head(d).cwiseAbs2()) / rk_.stages;
  return linalg::largest_by_group(e_.system, squares.data(), sums_);
}

/// Newton's iteration with increments by `solve`, which overwrites residual_ with the increment
/// (sign as in Z -= increment) and returns false if it cannot. Increments below `stalled` that no
/// longer shrink are rounding: converged.
template <class Solve>
NewtonResult StageNewton::iterate(double t, double h, const VectorX& y0, const VectorX& w,
                                  MatrixX& Z, int most, double stalled, Solve&& solve) {
  double before = 0.0;
  // Rounding of the residual sets a lower bound on the increments.
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
    // Transformation W = (T^-1 x I) dZ decouples the stages: a real system, and complex ones x + i
    // y from the columns of a pair.
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

/// Pattern of all stages: J and B in the diagonal blocks, B elsewhere. Velocities of points are
/// eliminated by their places at all stages.
void StageNewton::make_full() {
  const int s = rk_.stages;
  full_ = std::make_unique<Full>(e_.system, e_.pattern);
  const linalg::PointElimination& p = full_->points;
  std::vector<bool> rates = p.empty() ? full_->pattern.has_rate : p.has_rate;
  const Index n = p.n;
  if (e_.system.has_memory()) {
    full_->memory.emplace(e_.system);
    linalg::for_each_memory_entry(
        e_.system, [&](Index row, Index column, std::size_t, int, std::size_t, int) {
          const std::vector<Index>&start = full_->pattern.column_start, &in = full_->pattern.row;
          const auto entry =
              std::lower_bound(in.begin() + start[static_cast<std::size_t>(column)],
                               in.begin() + start[static_cast<std::size_t>(column) + 1], row) -
              in.begin();
          const Index stays = p.empty() ? entry : p.target[static_cast<std::size_t>(entry)];
          full_->memory_slots.push_back(stays);
          rates[static_cast<std::size_t>(stays)] = true;
        });
  }
  full_->slots.assign(static_cast<std::size_t>(s * s), std::vector<Index>(p.row.size(), -1));
  full_->start.assign(1, 0);
  for (int j = 0; j < s; ++j)
    for (Index c = 0; c < n; ++c) {
      for (int i = 0; i < s; ++i)
        for (Index k = p.start[c]; k < p.start[c + 1]; ++k) {
          if (i != j && !rates[static_cast<std::size_t>(k)])
            continue;
          full_->slots[static_cast<std::size_t>(i * s + j)][static_cast<std::size_t>(k)] =
              static_cast<Index>(full_->row.size());
          full_->row.push_back(i * n + p.row[static_cast<std::size_t>(k)]);
        }
      const Index unknown = p.empty() ? c : p.unknown[static_cast<std::size_t>(c)];
      if (unknown >= e_.system.lambda0 && unknown < e_.system.sigma0) {
        const auto first = p.row.begin() + p.start[c], last = p.row.begin() + p.start[c + 1];
        const bool present = std::find(first, last, c) != last; // mu = 0 in other formulations
        full_->diagonal.push_back(present ? -1 : static_cast<Index>(full_->row.size()));
        if (!present)
          full_->row.push_back(j * n + c);
      }
      full_->start.push_back(static_cast<Index>(full_->row.size()));
    }
  full_->by_y = full_->by_yp = MatrixX::Zero(std::ssize(p.lifted), s);
  full_->stays = MatrixX::Zero(p.empty() ? 0 : n, s);
  // The matrix is ordered as a whole: the order of one stage, with all stages of each unknown
  // together, has more fill-in.
  full_->lu = std::make_unique<linalg::SparseLu<double>>(full_->start, full_->row);
}

bool StageNewton::factorise_full(double t, double h) {
  const int s = rk_.stages;
  const linalg::PointElimination& points = full_->points;
  const std::size_t nonzeros = full_->pattern.row.size();
  const system::JacobianParts& parts = full_->parts;
  std::vector<double>& values = full_->lu->values();
  const double alpha = 1.0 / (rk_.gamma0 * h);
  const MatrixX twice = rk_.a_inverse * rk_.a_inverse;
  std::fill(values.begin(), values.end(), 0.0);
  VectorX regular(e_.system.sigma0 - e_.system.lambda0);
  for (int i = 0; i < s; ++i) {
    y_ = stage_.col(i);
    yp_ = rate_.col(i);
    e_.jacobian(t + rk_.c[i] * h, y_, yp_);
    e_.regularisation(alpha, regular);
    std::swap(e_.parts, full_->parts);
    if (full_->memory)
      full_->memory->take(static_cast<std::size_t>(i), parts);
    for (Index m = 0; m < regular.size(); ++m) {
      const Index slot = full_->diagonal[static_cast<std::size_t>(i * regular.size() + m)];
      if (slot >= 0)
        values[static_cast<std::size_t>(slot)] = regular[m];
    }
    for (std::size_t k = 0; k < points.lifted.size(); ++k) {
      const auto entry = static_cast<std::size_t>(points.lifted[k].entry);
      full_->by_y(static_cast<Index>(k), i) = parts.by_y[entry];
      full_->by_yp(static_cast<Index>(k), i) = parts.by_yp[entry];
    }
    for (int j = 0; j < s; ++j) {
      const std::vector<Index>& slots = full_->slots[static_cast<std::size_t>(i * s + j)];
      const double one = i == j ? 1.0 : 0.0, factor = rk_.a_inverse(i, j) / h,
                   square = twice(i, j) / (h * h);
      std::size_t next = 0; // index among the lifted entries
      for (std::size_t k = 0; k < nonzeros; ++k) {
        const Index stays = points.empty() ? static_cast<Index>(k) : points.target[k];
        const Index slot = stays < 0 ? -1 : slots[static_cast<std::size_t>(stays)];
        const bool lifts =
            next < points.lifted.size() && static_cast<std::size_t>(points.lifted[next].entry) == k;
        next += lifts ? 1 : 0;
        if (slot >= 0)
          values[static_cast<std::size_t>(slot)] +=
              lifts ? factor * parts.by_y[k] + square * parts.by_yp[k]
                    : one * parts.by_y[k] + factor * parts.by_yp[k];
      }
    }
  }
  if (full_->memory)
    add_memory(h);
  if (!full_->lu->factorise())
    return false;
  if (full_->work.factorise == 0.0)
    full_->work = full_->lu->work();
  e_.statistics.factor_work += full_->work.factorise;
  return true;
}

void StageNewton::add_memory(double h) {
  const int s = rk_.stages;
  std::vector<double>& values = full_->lu->values();
  full_->memory->prepare(rk_.a_inverse, h);
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < s; ++j) {
      const std::vector<Index>& slots = full_->slots[static_cast<std::size_t>(i * s + j)];
      full_->memory->for_each_load(i, j, s, [&](std::size_t k, double value) {
        values[static_cast<std::size_t>(slots[static_cast<std::size_t>(full_->memory_slots[k])])] +=
            value;
      });
    }
}

void StageNewton::solve_full(double h) {
  if (full_->memory)
    full_->memory->forward(residual_);
  solve_bodies(h);
  if (full_->memory)
    full_->memory->backward(residual_);
}

/// Overwrites residual_ with the increment; the blocks are ordered column by column. Velocities of
/// points: dU = dQ A^T / h - R, with their places Q and the residuals R of their rows.
void StageNewton::solve_bodies(double h) {
  const linalg::PointElimination& p = full_->points;
  if (p.empty()) {
    full_->lu->solve(residual_.data());
    return;
  }
  const int s = rk_.stages;
  for (std::size_t k = 0; k < p.lifted.size(); ++k) {
    const linalg::PointElimination::Lifted& of = p.lifted[k];
    const auto R = residual_.row(p.pairs[static_cast<std::size_t>(of.pair)].place);
    const auto entry = static_cast<Index>(k);
    for (int i = 0; i < s; ++i) {
      double sum = full_->by_y(entry, i) * R[i];
      if (const double mass = full_->by_yp(entry, i); mass != 0.0)
        sum += mass / h * rk_.a_inverse.row(i).dot(R);
      residual_(of.row, i) += sum;
    }
  }
  for (Index i = 0; i < p.n; ++i)
    full_->stays.row(i) = residual_.row(p.equation[static_cast<std::size_t>(i)]);
  full_->lu->solve(full_->stays.data());
  for (const linalg::PointElimination::Pair& of : p.pairs)
    residual_.row(of.velocity) = -residual_.row(of.place);
  for (Index i = 0; i < p.n; ++i)
    residual_.row(p.unknown[static_cast<std::size_t>(i)]) = full_->stays.row(i);
  for (const linalg::PointElimination::Pair& of : p.pairs)
    residual_.row(of.velocity).noalias() += residual_.row(of.place) * rk_.a_inverse.transpose() / h;
}

NewtonResult StageNewton::full(double t, double h, const VectorX& y0, const VectorX& w,
                               MatrixX& Z) {
  if (!full_)
    make_full();
  // Near a singular pose rounding keeps the increments above any finer bound.
  const double stalled = 0.5;
  return iterate(t, h, y0, w, Z, 15, stalled, [&] {
    const bool settled = iterations > 2 && contraction < 0.01; // the matrix then serves again
    if (!settled && !factorise_full(t, h))
      return false;
    solve_full(h);
    e_.statistics.factor_work += full_->work.solve;
    return true;
  });
}

} // namespace hydrodae::integrate
