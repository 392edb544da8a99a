#include "hydrodae/linalg/saddle_point.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/core/error.h"
#include "hydrodae/linalg/pressed_friction.h"
#include "hydrodae/math/dense_cholesky.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::linalg {

namespace {

constexpr double regularisation = 1e-8; ///< e
/// D is at least this part of diag(G M^-1 G^T), so that eD stays a hundred times above rounding.
constexpr double least_metric = 1e-6;
constexpr int usual_refinements = 4; ///< in singular poses the residual may stay
constexpr int refinements = 20;
constexpr double stalled = 0.5;    ///< what a refinement leaves of the residual: more is the end
constexpr double much_left = 1e-6; ///< likewise: more than regularisation leaves
constexpr int projections = 8;
/// Squares of lengths, relative to the largest: below, a direction has no inertia, or no row.
constexpr double singular_mass = 1e-14;
constexpr double rough = 1e-6;  ///< residual of a step of a projection, which the next step mends
constexpr double longest = 1e4; ///< way that closes a gap, relative to the gap
constexpr double moving = 1e-8; ///< rates of the gaps likewise: more means that the loop is locked

template <class Vector> double largest(const Vector& v) {
  return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0;
}

} // namespace

SaddlePoint::SaddlePoint(Equations& equations)
    : e_(equations), s_(equations.system),
      pattern_(system::find_pattern(s_, system::Part::accelerations)), parts_(pattern_),
      n_(s_.n_u + s_.n_lambda), residual_(s_.n), rhs_(n_), x_(n_), r_(n_),
      yp0_(VectorX::Zero(s_.n)) {
  const system::Pattern& p = pattern_;
  auto place = [&](Index i) -> Index { // of a row or column of y in the small matrix
    if (i >= s_.u0 && i < s_.z0)
      return i - s_.u0;
    if (i >= s_.lambda0 && i < s_.mu0)
      return i - s_.lambda0 + s_.n_u;
    return -1;
  };
  struct Visit {
    Index column, row, from;
    std::vector<Entry>* list;
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
    if (v.list)
      v.list->push_back({v.from, slot});
    else
      diagonal_.push_back(slot);
    if (v.row == v.column && v.column < s_.n_u)
      mass_[v.column] = slot;
  }
  for (Index c = 0; c < n_; ++c)
    start_[c + 1] += start_[c];
  plain_.resize(row_.size());
  metric_.resize(s_.n_lambda);
  damping_.resize(s_.n_lambda);
  heaviest_.resize(static_cast<std::size_t>(s_.n_mechanisms) +
                   1); // the last: of what is not a body
  sums_.resize(static_cast<std::size_t>(s_.n_lambda));
  for (Index z = s_.z0; z < s_.memory0; ++z)
    if (s_.is_algebraic(z))
      algebraic_.push_back(z);
  mechanism_.assign(s_.n_u, heaviest_.size() - 1);
  turns_.assign(s_.n_u, false);
  for (const system::BodyData& b : s_.bodies)
    for (int k = 0; k < b.n_active; ++k) {
      mechanism_[b.u0 - s_.u0 + k] =
          b.mechanism < 0 ? heaviest_.size() - 1 : static_cast<std::size_t>(b.mechanism);
      turns_[b.u0 - s_.u0 + k] = k >= b.n_translations;
    }
  find_blocks();
  pressed_ = Pressed::find(s_);
}

SaddlePoint::~SaddlePoint() = default;

/// Coordinates of a body stay together. Tables whose added mass is not symmetric have no Cholesky
/// factors that a refinement could use.
void SaddlePoint::find_blocks() {
  const auto crooked = [](const auto& A) {
    return A.size() > 0 && (A - A.transpose()).cwiseAbs().maxCoeff() > much_left * largest(A);
  };
  chosen_ = crooked(s_.hydro.added_mass);
  for (const water::PoseTable& table : s_.hydro.tables)
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

/// The heaviest mass of each mechanism and its largest moment of inertia, that of the mass at the
/// longest lever of a row included.
void SaddlePoint::find_heaviest() {
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

/// What row i of the matrix, a constraint, holds of G.
SaddlePoint::RowSums SaddlePoint::sums_of(Index i) const {
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

/// K with e > 0 from K. D_i is what the row would yield if the heaviest body of its mechanism were
/// at its end: the smallest eigenvalues of G M^-1 G^T are of that size, however light the others
/// are.
bool SaddlePoint::factorise() {
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
  if (!chosen_) { // dense blocks do so many multiply-adds at once
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

bool SaddlePoint::factorise_sparse() {
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

void SaddlePoint::multiply(const VectorX& x, VectorX& out) const {
  out.setZero();
  for (Index c = 0; c < n_; ++c)
    for (Index k = start_[c]; k < start_[c + 1]; ++k)
      out[row_[k]] += plain_[k] * x[c];
}

/// x = K^-1 rhs, the residual taken with e = 0, until what is left of it is below `accuracy`. Where
/// much of it is left the pivots may have gone bad, and are looked at.
void SaddlePoint::solve(VectorX& x, double accuracy) {
  x = rhs_;
  solve_factored(x.data());
  double before = HUGE_VAL;
  for (int i = 0; i < refinements; ++i) {
    multiply(x, r_);
    r_ = rhs_ - r_;
    // Forces and gaps are of different units, and converge each by their own size.
    const double motion = largest(x.head(s_.n_u)), forces = largest(r_.head(s_.n_u)),
                 gaps = largest(r_.tail(s_.n_lambda));
    double load = largest(rhs_.head(s_.n_u));
    if (load == 0.0) // of a projection: inertia, which the rows balance
      for (Index k = 0; k < s_.n_u; ++k)
        load = std::max(load, std::abs(plain_[mass_[k]] * x[k]));
    if (forces <= accuracy * load && gaps <= accuracy * motion)
      return;
    if ((old_pivots_ || in_blocks_) &&
        !(forces <= much_left * load && gaps <= much_left * motion)) {
      const bool sparse = !in_blocks_;
      const bool renewed = sparse ? lu_->factorise() : factorise_sparse();
      old_pivots_ = old_pivots_ && !sparse;
      if (!renewed) {
        x.setConstant(NAN);
        return;
      }
      return solve(x, accuracy);
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

/// K with e = 0, in the pose of y.
void SaddlePoint::fill(double t, const VectorX& y) {
  e_.mass_and_rows(t, y, yp0_, pattern_, parts_);
  for (const Entry& entry : of_mass_)
    plain_[entry.slot] = parts_.by_yp[entry.from];
  for (const Entry& entry : of_rows_)
    plain_[entry.slot] = parts_.by_y[entry.from];
  for (const Entry& entry : of_loads_)
    plain_[entry.slot] = -parts_.by_y[entry.from];
}

bool SaddlePoint::linearise(double t, VectorX& y) {
  y.tail(s_.n - s_.lambda0).setZero();
  fill(t, y);
  return factorise();
}

bool SaddlePoint::accelerations(double t, VectorX& y, VectorX& yp) {
  y.tail(s_.n - s_.lambda0).setZero();
  if (!e_.solve_algebraic(t, y) || !e_.free_residual(t, y, yp0_, residual_))
    return false;
  // Rows of q and z are y' = (explicit): with y' = 0 the residual is minus the rate.
  yp.segment(s_.u0, s_.n_u).setZero();
  yp.tail(s_.n - s_.lambda0).setZero();
  yp.head(s_.n_q) = -residual_.head(s_.n_q);
  yp.segment(s_.z0, s_.n_z) = -residual_.segment(s_.z0, s_.n_z);
  for (const Index z : algebraic_)
    yp[z] = 0.0;
  fill(t, y);
  rhs_.head(s_.n_u) = -residual_.segment(s_.u0, s_.n_u);
  rhs_.tail(s_.n_lambda) = -parts_.row_rates;
  for (const system::CouplerData& c : s_.couplers)
    if (s_.holds(c)) // the explicit time derivative of the velocity row: -f'' or -f'
      rhs_[s_.lambda(c) - s_.lambda0 + s_.n_u] += s_.drive(c, t)[c.velocity_level ? 1 : 2];
  if (!factorise())
    return false;
  solve(x_);
  const bool balanced = !pressed_ || press(t, y, yp);
  yp.segment(s_.u0, s_.n_u) = x_.head(s_.n_u);
  y.segment(s_.lambda0, s_.n_lambda) = -x_.tail(s_.n_lambda);
  return balanced && x_.allFinite();
}

/// Of each body the directions (n_u,) along which its block of M is singular.
std::vector<VectorX> SaddlePoint::massless_directions() const {
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

VectorX SaddlePoint::undetermined() const {
  const std::vector<VectorX> massless = massless_directions();
  if (massless.empty())
    return {};
  MatrixX Z(s_.n_u, std::ssize(massless));
  for (Index k = 0; k < Z.cols(); ++k)
    Z.col(k) = massless[static_cast<std::size_t>(k)];
  // The rows along them, relative to what each row has along all of u.
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

VectorX SaddlePoint::independence(const std::vector<int>& part, int parts) {
  constexpr int iterations = 20; // inverse iteration, x <- (G M^-1 G^T)^-1 D x, part by part
  VectorX x(s_.n_lambda);
  for (Index i = 0; i < x.size(); ++i) // no symmetry that an eigenvector could hide behind
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

double SaddlePoint::mismatch() {
  multiply(x_, r_);
  r_ = rhs_ - r_;
  double load = largest(rhs_.head(s_.n_u));
  for (Index k = 0; k < s_.n_u; ++k) // without weight and spin: inertia, which the rows balance
    load = std::max(load, std::abs(plain_[mass_[k]] * x_[k]));
  const double forces = largest(r_.head(s_.n_u)), rates = largest(r_.tail(s_.n_lambda));
  double motion = std::max(largest(x_.head(s_.n_u)), largest(rhs_.tail(s_.n_lambda)));
  for (Index k = 0; k < s_.n_u; ++k) // where nothing moves: the accelerations without the rows
    if (const double mass = plain_[mass_[k]]; mass > 0.0)
      motion = std::max(motion, std::abs(rhs_[k]) / mass);
  return std::max(forces > 0.0 ? forces / load : 0.0, rates > 0.0 ? rates / motion : 0.0);
}

SaddlePoint::Strike SaddlePoint::strike(double t, VectorX& y, const VectorX& rates) {
  if (!e_.residual(t, y, yp0_, residual_))
    throw SolverError(t, {Reason::not_finite, "no finite velocities at the impact"});
  Strike out;
  out.before = residual_.segment(s_.lambda0, s_.n_lambda);
  rhs_.setZero();
  rhs_.tail(s_.n_lambda) = rates - out.before;
  solve(x_);
  if (pressed_) {
    const std::optional<double> work = pressed_->rub(s_, y.segment(s_.u0, s_.n_u), x_);
    out.balanced = work.has_value();
    out.rubbed = work.value_or(0.0);
  }
  y.segment(s_.u0, s_.n_u) += x_.head(s_.n_u);
  out.impulses = -x_.tail(s_.n_lambda);
  return out;
}

/// rhs_ = [0; -g] from the residual at hand; the largest gap in units of its scale.
double SaddlePoint::gaps() {
  rhs_.setZero();
  double gap = 0.0;
  system::for_each_row(s_, [&](const system::Row& row, bool velocity_level) {
    if (!s_.holds(row) || velocity_level)
      return;
    const Index lambda = s_.lambda(row), mu = s_.mu(row);
    rhs_[lambda - s_.lambda0 + s_.n_u] = -residual_[mu];
    gap = std::max(gap, std::abs(residual_[mu]) / s_.row_scale[mu]);
  });
  return gap;
}

void SaddlePoint::close(double t, VectorX& y) {
  if (s_.n_lambda == 0 || !e_.constraint_residual(t, y, yp0_, residual_) || gaps() <= closed)
    return;
  const double gap = largest(rhs_);
  solve(x_, rough);
  if (largest(x_.head(s_.n_u)) <= longest * gap)
    system::retract(s_, x_.head(s_.n_u), y);
}

bool SaddlePoint::project(double t, VectorX& y, double accuracy) {
  for (const system::BodyData& b : s_.bodies)
    if (b.rotation == system::BodyData::Rotation::free)
      y.segment<4>(b.q0 + b.n_translations).normalize();
  y.tail(s_.n - s_.lambda0).setZero();
  if (s_.n_lambda == 0)
    return true;
  double before = HUGE_VAL;
  for (int i = 0; i < projections; ++i) {
    if (!e_.constraint_residual(t, y, yp0_, residual_))
      return false;
    const double gap = gaps();
    if (gap <= accuracy || (i > 0 && gap >= 0.5 * before && gap < 1e-10))
      break;
    if (i > 1 && gap > 2.0 * before)
      return false;
    before = gap;
    if (i + 1 == projections && gap > 1e-9)
      return false;
    solve(x_, rough);
    system::retract(s_, x_.head(s_.n_u), y);
  }
  for (int i = 0; i < 2; ++i) { // the matrix is of a pose a little off: twice
    if (!e_.constraint_residual(t, y, yp0_, residual_))
      return false;
    rhs_.setZero();
    rhs_.tail(s_.n_lambda) = -residual_.segment(s_.lambda0, s_.n_lambda);
    solve(x_, rough);
    y.segment(s_.u0, s_.n_u) += x_.head(s_.n_u);
  }
  if (!e_.constraint_residual(t, y, yp0_, residual_))
    return false;
  for (Index i = s_.lambda0; i < s_.mu0; ++i)
    if (std::abs(residual_[i]) >
        moving * std::max(s_.row_scale[i], y.segment(s_.u0, s_.n_u).cwiseAbs().maxCoeff()))
      return false;
  return y.allFinite();
}

} // namespace hydrodae::linalg
