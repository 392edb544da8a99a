#include "hydrodae/linalg/saddle_matrix.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/math/dense_cholesky.h"

namespace hydrodae::linalg {

namespace {

constexpr double regularisation = 1e-8; ///< regularisation e
/// D is at least this part of diag(G M^-1 G^T), so that eD stays a hundred times above rounding.
constexpr double least_metric = 1e-6;
/// Refinements before pivots are checked; the residual may stay in singular poses
constexpr int usual_refinements = 4;
constexpr int refinements = 20;
constexpr double stalled = 0.5;    ///< ratio of residuals above which refinement stops
constexpr double much_left = 1e-6; ///< residual above that of regularisation
/// Squared lengths relative to the largest, below which a direction has no inertia, or no row.
constexpr double singular_mass = 1e-14;

template <class Vector> double largest(const Vector& v) {
  return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
}

} // namespace

SaddleMatrix::SaddleMatrix(const system::Regime& system, const system::Pattern& pattern)
    : s_(system), n_(s_.n_u + s_.n_lambda), r_(n_) {
  find_slots(pattern);
  find_mechanisms();
  find_blocks();
}

void SaddleMatrix::find_slots(const system::Pattern& p) {
  auto place = [&](Index i) -> Index { // row or column of y in the small matrix
    if (i >= s_.u0 && i < s_.z0)
      return i - s_.u0;
    if (i >= s_.lambda0 && i < s_.mu0)
      return i - s_.lambda0 + s_.n_u;
    return -1;
  };
  struct Visit {
    Index column, row, from;
    std::vector<Run>* list;
  };
  std::vector<Visit> visits;
  for (Index column = 0; column < s_.n; ++column)
    for (Index k = p.column_start[column]; k < p.column_start[column + 1]; ++k) {
      const Index row = place(p.row[k]), c = place(column);
      if (row < 0 || c < 0 || (row >= s_.n_u && c >= s_.n_u))
        continue;
      const bool mass = row < s_.n_u && c < s_.n_u;
      if (!mass || p.has_rate[k])
        visits.push_back({c, row, k, mass ? &of_mass_ : row < s_.n_u ? &of_loads_ : &of_rows_});
    }
  for (Index i = s_.n_u; i < n_; ++i)
    visits.push_back({i, i, -1, nullptr});
  std::sort(visits.begin(), visits.end(), [](const Visit& a, const Visit& b) {
    return std::tie(a.column, a.row) < std::tie(b.column, b.row);
  });
  start_.assign(n_ + 1, 0);
  mass_.assign(s_.n_u, -1);
  for (const Visit& v : visits) {
    const auto slot = static_cast<Index>(row_.size());
    row_.push_back(v.row);
    ++start_[v.column + 1];
    if (!v.list)
      diagonal_.push_back(slot);
    else if (v.list->empty() || v.list->back().from + v.list->back().count != v.from ||
             v.list->back().slot + v.list->back().count != slot)
      v.list->push_back({v.from, slot, 1});
    else
      ++v.list->back().count;
    if (strips_.empty() || strips_.back().column != v.column ||
        strips_.back().row + strips_.back().count != v.row)
      strips_.push_back({v.column, v.row, slot, 1});
    else
      ++strips_.back().count;
    if (v.row == v.column && v.column < s_.n_u)
      mass_[v.column] = slot;
  }
  for (Index c = 0; c < n_; ++c)
    start_[c + 1] += start_[c];
  plain_.resize(row_.size());
}

void SaddleMatrix::find_mechanisms() {
  metric_.resize(s_.n_lambda);
  sums_.resize(static_cast<std::size_t>(s_.n_lambda));
  damping_.resize(s_.n_lambda);
  heaviest_.resize(static_cast<std::size_t>(s_.n_mechanisms) +
                   1); // the last: of what is not a body
  mechanism_.assign(s_.n_u, heaviest_.size() - 1);
  turns_.assign(s_.n_u, false);
  for (const system::BodyData& b : s_.bodies)
    for (int k = 0; k < b.n_active; ++k) {
      mechanism_[b.u0 - s_.u0 + k] =
          b.mechanism < 0 ? heaviest_.size() - 1 : static_cast<std::size_t>(b.mechanism);
      turns_[b.u0 - s_.u0 + k] = k >= b.n_translations;
    }
}

/// Keeps coordinates of a body together. Tables with unsymmetric added mass have no Cholesky
/// factors that refinement could use.
void SaddleMatrix::find_blocks() {
  const auto crooked = [](const auto& A) {
    return A.size() > 0 && (A - A.transpose()).cwiseAbs().maxCoeff() > much_left * largest(A);
  };
  chosen_ = crooked(s_.hydro.added_mass.moving);
  for (const water::PoseTable& table : s_.hydro.added_mass.tables)
    chosen_ = chosen_ || std::any_of(table.added_mass.begin(), table.added_mass.end(), crooked);
  if (chosen_)
    return;
  std::vector<Index> together(static_cast<std::size_t>(s_.n_u));
  std::iota(together.begin(), together.end(), Index{0});
  for (const system::BodyData& b : s_.bodies)
    for (int k = 0; k < b.n_active; ++k)
      together[static_cast<std::size_t>(b.u0 - s_.u0 + k)] = b.u0 - s_.u0;
  blocks_ = std::make_unique<BlockFactor>(start_, row_, s_.n_u, together);
  chosen_ = blocks_->work() <= dense::lanes * blocks_->least_work();
}

/// Finds the largest mass of each mechanism, and its largest moment of inertia, including that mass
/// at the longest lever of a row.
void SaddleMatrix::find_heaviest() {
  for (Heaviest& h : heaviest_)
    h = {};
  for (Index k = 0; k < s_.n_u; ++k) {
    Heaviest& h = heaviest_[mechanism_[k]];
    double& most = turns_[k] ? h.inertia : h.mass;
    most = std::max(most, plain_[mass_[k]]);
  }
  for (Index i = s_.n_u; i < n_; ++i) {
    const RowSums& row = sums_[static_cast<std::size_t>(i - s_.n_u)] = sums_of(i);
    if (row.shift > 0.0) {
      Heaviest& h = heaviest_[row.mechanism];
      h.inertia = std::max(h.inertia, h.mass * row.turn / row.shift);
    }
  }
}

/// Sums over the entries of G in row i of the matrix, a constraint.
SaddleMatrix::RowSums SaddleMatrix::sums_of(Index i) const {
  RowSums out;
  for (Index k = start_[i]; k < start_[i + 1]; ++k)
    if (const Index u = row_[k]; u < s_.n_u && plain_[k] != 0.0) {
      const double square = plain_[k] * plain_[k];
      (turns_[u] ? out.turn : out.shift) += square;
      if (const double mass = plain_[mass_[u]]; mass > 0.0)
        out.yields += square / mass;
      out.mechanism = mechanism_[u];
    }
  return out;
}

/// Factorises K with e > 0. D_i is the diagonal entry of the row with the heaviest body of its
/// mechanism: the smallest eigenvalues of G M^-1 G^T have that size, however light other bodies
/// are.
bool SaddleMatrix::factorise_anew() {
  find_heaviest();
  for (Index i = s_.n_u; i < n_; ++i) {
    const RowSums& row = sums_[static_cast<std::size_t>(i - s_.n_u)];
    const Heaviest& h = heaviest_[row.mechanism];
    const bool shifts = row.shift > 0.0;
    double d = shifts ? row.shift : row.turn;
    if (const double most = shifts ? h.mass : h.inertia; most > 0.0)
      d /= most;
    d = std::max(d, least_metric * row.yields);
    metric_[i - s_.n_u] = d > 0.0 ? d : 1.0;
    damping_[i - s_.n_u] = regularisation * metric_[i - s_.n_u];
  }
  if (!chosen_) { // cost of dense blocks per multiply-add is lower
    chosen_ = true;
    if (!factorise_sparse())
      return false;
    if (blocks_->work() > dense::lanes * lu_->work().factorise)
      blocks_.reset();
    return true;
  }
  in_blocks_ = blocks_ && blocks_->factorise(plain_, damping_);
  return in_blocks_ || factorise_sparse();
}

bool SaddleMatrix::factorise() {
  factored_ = factored_ || factorise_anew();
  return factored_;
}

bool SaddleMatrix::factorise_sparse() {
  in_blocks_ = false;
  if (!lu_)
    lu_ = std::make_unique<SparseLu<double>>(start_, row_);
  std::vector<double>& values = lu_->values();
  std::copy(plain_.begin(), plain_.end(), values.begin());
  for (Index i = 0; i < s_.n_lambda; ++i)
    values[diagonal_[i]] = -damping_[i];
  old_pivots_ = lu_->refactorise();
  return old_pivots_ || lu_->factorise();
}

/// Subtracts a product: out -= K x with e = 0.
void SaddleMatrix::subtract_product(const VectorX& x, VectorX& out) const {
  for (const Strip& strip : strips_) {
    const double* const from = plain_.data() + strip.slot;
    double* const to = out.data() + strip.row;
    const double by = x[strip.column];
    for (Index k = 0; k < strip.count; ++k)
      to[k] -= from[k] * by;
  }
}

/// Largest inertia force at the accelerations x.
double SaddleMatrix::inertia(const VectorX& x) const {
  double most = 0.0;
  for (Index k = 0; k < s_.n_u; ++k)
    most = std::max(most, std::abs(plain_[mass_[k]] * x[k]));
  return most;
}

void SaddleMatrix::solve(const VectorX& b, VectorX& x, double accuracy) {
  x = b;
  solve_factored(x.data());
  double before = HUGE_VAL;
  for (int i = 0; i < refinements; ++i) {
    r_ = b;
    subtract_product(x, r_);
    // Forces and gaps have different units, and converge each relative to its own size.
    const double motion = largest(x.head(s_.n_u)), forces = largest(r_.head(s_.n_u)),
                 gaps = largest(r_.tail(s_.n_lambda));
    double load = largest(b.head(s_.n_u));
    if (load == 0.0) // load of a projection: inertia, which the rows balance
      load = inertia(x);
    if (forces <= accuracy * load && gaps <= accuracy * motion)
      return;
    if ((old_pivots_ || in_blocks_) &&
        !(forces <= much_left * load && gaps <= much_left * motion)) {
      const bool sparse = !in_blocks_;
      const bool renewed = sparse ? lu_->factorise() : factorise_sparse();
      old_pivots_ = old_pivots_ && !sparse;
      if (!renewed) {
        factored_ = false;
        x.setConstant(NAN);
        return;
      }
      return solve(b, x, accuracy);
    }
    const double left =
        std::max(load > 0.0 ? forces / load : 0.0, motion > 0.0 ? gaps / motion : 0.0);
    if (i >= usual_refinements && left > stalled * before)
      return;
    before = left;
    solve_factored(r_.data());
    x += r_;
  }
}

void SaddleMatrix::fill(const system::JacobianParts& parts) {
  const auto take = [this](const std::vector<Run>& runs, const double* values, double sign) {
    for (const Run& run : runs) {
      double* const to = plain_.data() + run.slot;
      const double* const from = values + run.from;
      bool same = true;
      for (Index k = 0; k < run.count; ++k) {
        same &= to[k] == sign * from[k];
        to[k] = sign * from[k];
      }
      factored_ &= same;
    }
  };
  take(of_mass_, parts.by_yp.data(), 1.0);
  take(of_rows_, parts.by_y.data(), 1.0);
  take(of_loads_, parts.by_y.data(), -1.0);
}

/// Directions (n_u,) along which the block of M of a body is singular.
std::vector<VectorX> SaddleMatrix::massless_directions() const {
  std::vector<VectorX> out;
  for (const system::BodyData& b : s_.bodies) {
    const Index t = b.n_translations;
    for (const auto& [from, n] : {std::pair{Index(0), t}, std::pair{t, b.n_active - t}}) {
      const Index first = b.u0 - s_.u0 + from;
      Matrix3 own = Matrix3::Identity(); // coordinates that do not move count as heavy
      for (Index c = 0; c < n; ++c)
        for (Index k = start_[first + c]; k < start_[first + c + 1]; ++k)
          if (row_[k] >= first && row_[k] < first + n)
            own(row_[k] - first, c) = plain_[k];
      const double most = own.topLeftCorner(n, n).norm();
      for (Index c = n; c < 3; ++c)
        own(c, c) = most > 0.0 ? most : 1.0;
      const Eigen::SelfAdjointEigenSolver<Matrix3> modes(own);
      for (Index k = 0; k < 3; ++k)
        if (modes.eigenvalues()[k] <= singular_mass * most) {
          out.push_back(VectorX::Zero(s_.n_u));
          out.back().segment(first, n) = modes.eigenvectors().col(k).head(n);
        }
    }
  }
  return out;
}

VectorX SaddleMatrix::undetermined() const {
  const std::vector<VectorX> massless = massless_directions();
  if (massless.empty())
    return {};
  MatrixX Z(s_.n_u, std::ssize(massless));
  for (Index k = 0; k < Z.cols(); ++k)
    Z.col(k) = massless[static_cast<std::size_t>(k)];
  // Rows along them, relative to each row along all of u.
  MatrixX along = MatrixX::Zero(s_.n_lambda, Z.cols());
  for (Index i = s_.n_u; i < n_; ++i) {
    double square = 0.0;
    for (Index k = start_[i]; k < start_[i + 1]; ++k)
      if (row_[k] < s_.n_u) {
        square += plain_[k] * plain_[k];
        along.row(i - s_.n_u) += plain_[k] * Z.row(row_[k]);
      }
    if (square > 0.0)
      along.row(i - s_.n_u) /= std::sqrt(square);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixX> held(along.transpose() * along);
  if (held.eigenvalues()[0] > singular_mass)
    return {};
  return Z * held.eigenvectors().col(0);
}

VectorX SaddleMatrix::independence(const std::vector<int>& part, int parts) {
  constexpr int iterations = 20; // inverse iteration x <- (G M^-1 G^T)^-1 D x, part by part
  VectorX x(s_.n_lambda);
  for (Index i = 0; i < x.size(); ++i) // start without symmetry, which could hide an eigenvector
    x[i] = 1.0 + 0.5 * std::sin(static_cast<double>(1 + i * i));
  const auto products = [&](const VectorX& a, const VectorX& b) {
    VectorX sums = VectorX::Zero(parts);
    for (Index i = 0; i < a.size(); ++i)
      sums[part[static_cast<std::size_t>(i)]] += a[i] * metric_[i] * b[i];
    return sums;
  };
  VectorX smallest = VectorX::Ones(parts);
  for (int k = 0; k < iterations && x.size() > 0; ++k) {
    const VectorX sizes = products(x, x).cwiseSqrt();
    for (Index i = 0; i < x.size(); ++i)
      x[i] /= sizes[part[static_cast<std::size_t>(i)]];
    r_.head(s_.n_u).setZero();
    r_.tail(s_.n_lambda) = metric_.cwiseProduct(x);
    solve_factored(r_.data());
    const VectorX next = -r_.tail(s_.n_lambda), gains = products(x, next);
    for (Index m = 0; m < parts; ++m)
      if (sizes[m] > 0.0)
        smallest[m] = 1.0 / gains[m];
    x = next;
  }
  return smallest;
}

double SaddleMatrix::mismatch(const VectorX& b, const VectorX& x) {
  r_ = b;
  subtract_product(x, r_);
  // without weight and spin: inertia, which the rows balance
  const double load = std::max(largest(b.head(s_.n_u)), inertia(x));
  const double forces = largest(r_.head(s_.n_u)), rates = largest(r_.tail(s_.n_lambda));
  double motion = std::max(largest(x.head(s_.n_u)), largest(b.tail(s_.n_lambda)));
  for (Index k = 0; k < s_.n_u; ++k) // nothing moves: the accelerations without the rows
    if (const double mass = plain_[mass_[k]]; mass > 0.0)
      motion = std::max(motion, std::abs(b[k]) / mass);
  return std::max(forces > 0.0 ? forces / load : 0.0, rates > 0.0 ? rates / motion : 0.0);
}

} // namespace hydrodae::linalg
