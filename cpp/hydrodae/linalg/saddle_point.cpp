#include "hydrodae/linalg/saddle_point.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/linalg/pressed_friction.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::linalg {

namespace {

/// Residual of a step of a projection, which the next step corrects
constexpr double rough = 1e-6;
constexpr double longest = 1e4; ///< longest displacement to close a gap, relative to the gap

} // namespace

SaddlePoint::SaddlePoint(Equations& equations)
    : e_(equations), s_(equations.system),
      pattern_(system::find_pattern(s_, system::Part::accelerations)), parts_(pattern_),
      matrix_(s_, pattern_), residual_(s_.n), rhs_(s_.n_u + s_.n_lambda), x_(rhs_.size()),
      yp0_(VectorX::Zero(s_.n)), pressed_(Pressed::find(s_)) {
  for (Index z = s_.z0; z < s_.memory0; ++z)
    if (s_.is_algebraic(z))
      algebraic_.push_back(z);
}

SaddlePoint::~SaddlePoint() = default;

/// Fills the matrix at the pose of y.
void SaddlePoint::fill(double t, const VectorX& y) {
  e_.mass_and_rows(t, y, yp0_, pattern_, parts_);
  matrix_.fill(parts_);
}

bool SaddlePoint::linearise(double t, VectorX& y) {
  y.tail(s_.n - s_.lambda0).setZero();
  fill(t, y);
  return matrix_.factorise();
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
    if (s_.holds(c)) // explicit time derivative of the velocity row: -f'' or -f'
      rhs_[s_.lambda(c) - s_.lambda0 + s_.n_u] += s_.drive(c, t)[c.velocity_level ? 1 : 2];
  if (!matrix_.factorise())
    return false;
  matrix_.solve(rhs_, x_);
  const bool balanced = !pressed_ || press(t, y, yp);
  yp.segment(s_.u0, s_.n_u) = x_.head(s_.n_u);
  y.segment(s_.lambda0, s_.n_lambda) = -x_.tail(s_.n_lambda);
  return balanced && x_.allFinite();
}

SaddlePoint::Strike SaddlePoint::strike(double t, VectorX& y, const VectorX& rates) {
  if (!e_.residual(t, y, yp0_, residual_))
    throw SolverError(t, {Reason::not_finite, "no finite velocities at the impact"});
  Strike out;
  out.before = residual_.segment(s_.lambda0, s_.n_lambda);
  rhs_.setZero();
  rhs_.tail(s_.n_lambda) = rates - out.before;
  matrix_.solve(rhs_, x_);
  if (pressed_) {
    const std::optional<double> work = pressed_->rub(s_, y.segment(s_.u0, s_.n_u), x_);
    out.balanced = work.has_value();
    out.rubbed = work.value_or(0.0);
  }
  y.segment(s_.u0, s_.n_u) += x_.head(s_.n_u);
  out.impulses = -x_.tail(s_.n_lambda);
  return out;
}

/// Sets rhs_ = [0; -g] from the present residual; returns the largest gap in units of its scale.
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
  const double gap = rhs_.lpNorm<Eigen::Infinity>();
  matrix_.solve(rhs_, x_, rough);
  if (x_.head(s_.n_u).lpNorm<Eigen::Infinity>() <= longest * gap)
    system::retract(s_, x_.head(s_.n_u), y);
}

bool SaddlePoint::project(double t, VectorX& y, double accuracy) {
  system::normalise(s_, y);
  y.tail(s_.n - s_.lambda0).setZero();
  if (s_.n_lambda == 0)
    return true;
  double before = HUGE_VAL;
  for (int i = 0; i < projections; ++i) {
    if (!e_.constraint_residual(t, y, yp0_, residual_))
      return false;
    const double gap = gaps();
    if (gap <= accuracy || (i > 0 && gap >= 0.5 * before && gap < stalled))
      break;
    if (i > 1 && gap > 2.0 * before)
      return false;
    before = gap;
    if (i + 1 == projections && gap > open)
      return false;
    matrix_.solve(rhs_, x_, rough);
    system::retract(s_, x_.head(s_.n_u), y);
  }
  for (int i = 0; i < 2; ++i) { // two passes: the matrix belongs to a slightly different pose
    if (!e_.constraint_residual(t, y, yp0_, residual_))
      return false;
    rhs_.setZero();
    rhs_.tail(s_.n_lambda) = -residual_.segment(s_.lambda0, s_.n_lambda);
    matrix_.solve(rhs_, x_, rough);
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
