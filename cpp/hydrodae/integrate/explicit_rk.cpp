#include "hydrodae/integrate/explicit_rk.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/integrate/dormand_prince_5.h"
#include "hydrodae/integrate/dormand_prince_8.h"
#include "hydrodae/integrate/explicit_steps.h"
#include "hydrodae/integrate/stiffness.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::integrate {

namespace {

struct Pair {
  int stages = 0, order = 0;
  std::span<const double> a, b, c;
};

const Pair order_5{6, 5, tableaux::rk5_a, tableaux::rk5_b, tableaux::rk5_c};
const Pair order_8{12, 8, tableaux::rk8_a, tableaux::rk8_b, tableaux::rk8_c};

/// Integrates y = [q | u | z] with the rates f(t, y) from the saddle-point matrix; multipliers
/// follow from y:
///
///   k_i = f(t + c_i h, y + h sum_j a_ij k_j),     y_1 = P(y + h sum_i b_i k_i)
///
/// with the projection P onto positions and rates of the constraints.
class ExplicitRk : public Integrator {
public:
  ExplicitRk(const system::Regime& system, const system::Pattern& pattern,
             const SolverOptions& options, double t0, const VectorX& y, const VectorX& yp)
      : pair_(options.order == 5 ? order_5 : order_8), fixed_(options.step > 0.0),
        max_step_(options.max_step > 0.0 ? options.max_step : options.end_time),
        idle_reactions_(system::has_idle_reactions(system)), full_pattern_(pattern),
        e_(system, pattern, options.rtol), saddle_(e_), n_(system.lambda0),
        guard_(t0, options.end_time, e_.time_scale()), t_(t0), t0_(t0), y_(y), yp_(yp),
        w_(system.n), k_(n_, 17) {
    e_.accept(t_, y_, yp_);
    y0_ = stage_ = stage_yp_ = trial_ = trial_yp_ = inside_ = inside_yp_ = y_;
    // The step lets rounding errors grow by at most 1e3: it is not the smallest possible one, as it
    // is for a method of order 1.
    state_.h = fixed_ ? options.step
                      : std::min(max_step_, linalg::first_step(system, options.rtol, y, yp) *
                                                std::pow(options.rtol, 0.2 - 0.5));
    if (!saddle_.accelerations(t_, y_, yp_))
      throw SolverError(t_, {Reason::not_finite, "no finite accelerations at the start"});
  }

  double step(double end, double bound) override;
  bool restart(double t, const VectorX& y, const VectorX& yp) override;
  void interpolate(double t, VectorX& y, VectorX& yp) override;
  void look_inside(double t, VectorX& y, VectorX& yp) override;
  void follow_motion(double t, VectorX& y, VectorX& yp) override;
  int degree() const override { return pair_.order == 5 ? 4 : 7; }
  std::span<const double> stage_weights() const override {
    return idle_reactions_ && done_ > 0.0 ? pair_.b : std::span<const double>();
  }
  double stage(std::size_t i, VectorX& y, VectorX& yp) override;
  linalg::Statistics statistics() const override { return e_.statistics; }
  int quadrature_nodes() const override { return pair_.order == 5 ? 4 : 6; }
  double gap() const override { return fixed_ ? 1.0 : ExplicitSteps::gap; }
  Memory state() const override {
    return ExplicitState{state_.h,
                         state_.last_error,
                         state_.usual_jump,
                         {e_.statistics.last_step, e_.statistics.last_order},
                         guard_.state()};
  }
  void set(const Memory& state) override {
    state_ = memory_of<ExplicitState>(state);
    e_.statistics.last_step = state_.made.length;
    e_.statistics.last_order = state_.made.order;
    guard_.set(state_.guard);
  }

private:
  /// Exponent of the error that controls the next step.
  double power() const { return 1.0 / (pair_.order == 5 ? 5.0 : 8.0); }
  void set_stage(const VectorX& start, double h, int stages, std::span<const double> a);
  bool try_step(double h);
  bool find_end(double h);
  void add_rates(double h, std::span<const double> weights);
  double error(double h);
  bool is_smooth(double h);
  double longest_at_rest(double err);
  void accept(double h, double t);
  void extend();
  void follow_polynomial(double x);
  [[noreturn]] void fail(Reason reason, const std::string& what);

  const Pair& pair_;
  const bool fixed_;
  const double max_step_;
  const bool idle_reactions_; ///< no multiplier does work or determines an unknown
  const system::Pattern& full_pattern_;
  linalg::Equations e_;
  linalg::SaddlePoint saddle_;
  const Index n_; ///< number of q, u and z, which the method integrates
  linalg::ProgressGuard guard_;
  double t_ = 0.0, t0_ = 0.0, done_ = 0.0; ///< `done_`: length of the last step
  /// y, y' at the end of the last step, and y at its start
  VectorX y_, yp_, y0_;
  VectorX stage_, stage_yp_, trial_, trial_yp_, inside_, inside_yp_, w_;
  MatrixX k_;     ///< rates of the stages, one column each
  MatrixX dense_; ///< coefficients of the interpolant of order 7
  bool extended_ = false;
  ExplicitState state_;    ///< state without the last step and the guard
  double rest_step_ = 0.0; ///< longest stable step of this rest; 0: not at rest
};

void ExplicitRk::fail(Reason reason, const std::string& what) {
  const std::string jam = saddle_.jam().empty() ? "" : ": " + saddle_.jam();
  throw SolverError(t_, {jam.empty() ? reason : Reason::friction,
                         what + jam + ", last step " + number_text(state_.h) + " s",
                         "",
                         {{"step", state_.h}},
                         "",
                         e_.diagnosis(t_, y_, yp_)});
}

/// Sets stage_ = start + h sum_j a_j k_j.
void ExplicitRk::set_stage(const VectorX& start, double h, int stages, std::span<const double> a) {
  stage_.head(n_) = start.head(n_);
  add_rates(h, a.first(static_cast<std::size_t>(stages)));
}

/// Adds h sum_j weights_j k_j to stage_.
void ExplicitRk::add_rates(double h, std::span<const double> weights) {
  for (std::size_t j = 0; j < weights.size(); ++j)
    if (weights[j] != 0.0)
      stage_.head(n_) += h * weights[j] * k_.col(static_cast<Index>(j));
}

/// Computes the stages k_i, and trial_ = y + h sum_i b_i k_i before the projection. Returns false
/// if no finite accelerations exist.
bool ExplicitRk::try_step(double h) {
  const int s = pair_.stages;
  k_.col(0) = yp_.head(n_);
  for (int i = 1; i < s; ++i) {
    set_stage(y_, h, i, pair_.a.subspan(static_cast<std::size_t>(i * s)));
    if (!saddle_.accelerations(t_ + pair_.c[i] * h, stage_, stage_yp_))
      return false;
    k_.col(i) = stage_yp_.head(n_);
  }
  set_stage(y_, h, s, pair_.b);
  trial_ = stage_;
  return pair_.order == 8 || find_end(h);
}

/// Computes the rates at the end of the step. Order 8 needs them only after the projection, because
/// its error estimate does not use them.
bool ExplicitRk::find_end(double h) {
  if (!saddle_.accelerations(t_ + h, trial_, trial_yp_))
    return false;
  k_.col(pair_.stages) = trial_yp_.head(n_);
  return true;
}

/// Local error in units of the tolerance; for order 8 from both estimates (Hairer, Norsett and
/// Wanner, section II.10).
double ExplicitRk::error(double h) {
  e_.weights(y_, w_);
  auto size = [&](std::span<const double> weights) {
    stage_.setZero();
    add_rates(h, weights);
    return e_.norm(w_, stage_);
  };
  if (pair_.order == 5)
    return size(tableaux::rk5_e);
  const double five = size(tableaux::rk8_e5), both = std::hypot(five, 0.1 * size(tableaux::rk8_e3));
  return both > 0.0 ? five * five / both : 0.0;
}

/// Returns whether the accelerations at the end of the step agree with those of the last stage at
/// the same time. The estimate of order 8 uses only the latter: it would miss a stop that the end
/// hits and the stages do not.
bool ExplicitRk::is_smooth(double h) {
  if (pair_.order == 5)
    return true; // the estimate of order 5 uses the end
  stage_.setZero();
  stage_.head(n_) = h * (k_.col(pair_.stages) - k_.col(pair_.stages - 1));
  return ExplicitSteps::is_usual(e_.norm(w_, stage_), state_.usual_jump);
}

/// Longest step at rest. No error bounds the steps there, and steps beyond the stability limit
/// amplify rounding into motion. The limit is about 5 (order 8) or 2.5 (order 5) over the fastest
/// rate, which is found once in each rest.
double ExplicitRk::longest_at_rest(double err) {
  constexpr double nothing = 1e-6; // part of the tolerance
  if (err >= nothing) {
    rest_step_ = 0.0;
    return HUGE_VAL;
  }
  if (rest_step_ == 0.0) {
    const double rate = fastest_rate(e_.system, full_pattern_, t_, y_, yp_);
    rest_step_ = rate > 0.0 ? (pair_.order == 5 ? 2.5 : 5.0) / rate : HUGE_VAL;
  }
  return rest_step_;
}

/// Accepts the step of length h to time t, which ends in trial_.
void ExplicitRk::accept(double h, double t) {
  y0_ = y_;
  y_ = trial_;
  yp_ = trial_yp_;
  t0_ = t_;
  t_ = t;
  done_ = h;
  e_.accept(t_, y_, yp_);
  ++e_.statistics.steps;
  e_.statistics.last_step = done_;
  e_.statistics.last_order = pair_.order;
}

double ExplicitRk::step(double end, double bound) {
  extended_ = false;
  bool failed = false;
  for (;;) {
    const double left = end - t_, wanted = state_.h;
    const double allowed = fixed_ ? left : std::min(left, bound - t_);
    double h = std::min(state_.h, allowed);
    if (allowed - h < 0.1 * h) // avoids a tiny next step
      h = allowed;
    if (h < 1e-13 * std::max(std::abs(t_), e_.time_scale()) && h < left)
      fail(Reason::step, failed ? "the local error stays too large however short the step"
                                : "the step has become too short");
    const auto shorten = [&](long& failures, double part) {
      ++failures;
      state_.h = part * h;
      failed = true;
    };
    if (!try_step(h)) {
      if (fixed_)
        fail(Reason::not_finite, "no finite accelerations within the step");
      shorten(e_.statistics.convergence_failures, 0.25);
      continue;
    }
    const double err = fixed_ ? 0.0 : error(h);
    const bool good = err <= 1.0 && std::isfinite(err);
    if (good && !(saddle_.project(t_ + h, trial_) && find_end(h))) {
      if (fixed_)
        fail(Reason::drift, "the constraints cannot be met at the end of the step");
      shorten(e_.statistics.convergence_failures, 0.25);
      continue;
    }
    if (const bool rough = good && !fixed_ && !is_smooth(h); !good || rough) {
      const double kept = std::isfinite(err) ? ExplicitSteps::safety * std::pow(err, -power())
                                             : ExplicitSteps::least_growth;
      shorten(e_.statistics.error_test_failures,
              rough ? 0.25 : std::max(ExplicitSteps::least_growth, kept));
      continue;
    }
    accept(h, h == left ? end : t_ + h);
    if (!fixed_) {
      state_.h = h * ExplicitSteps::growth(err, power(), failed ? 1.0 : ExplicitSteps::most_growth,
                                           state_.last_error);
      if (h == left) // a shortened step is no evidence against longer ones
        state_.h = std::max(state_.h, wanted);
      state_.h = std::min({state_.h, max_step_, longest_at_rest(err)});
    }
    guard_.after_step(t_, [&] { return e_.diagnosis(t_, y_, yp_); });
    return t_;
  }
}

bool ExplicitRk::restart(double t, const VectorX& y, const VectorX& yp) {
  t_ = t0_ = t;
  y_ = y;
  yp_ = yp;
  e_.accept(t_, y_, yp_);
  y0_ = y_;
  done_ = state_.usual_jump = 0.0;
  state_.last_error = 1e-4;
  rest_step_ = 0.0;
  extended_ = false;
  return saddle_.accelerations(t_, y_, yp_);
}

/// Computes the three further stages of the interpolant of order 7, and its coefficients.
void ExplicitRk::extend() {
  if (extended_ || pair_.order == 5)
    return;
  for (int i = 0; i < 3; ++i) {
    set_stage(y0_, done_, 13 + i,
              std::span(tableaux::rk8_extra_a).subspan(static_cast<std::size_t>(16 * i)));
    if (!saddle_.accelerations(t0_ + tableaux::rk8_extra_c[i] * done_, stage_, stage_yp_))
      fail(Reason::not_finite, "no finite accelerations inside the step");
    k_.col(13 + i) = stage_yp_.head(n_);
  }
  // Columns f_0 = dy, f_1 = h k_0 - dy, f_2 = 2 dy - h (k_end + k_0), f_3.. = h D k; nested in x, 1
  // - x.
  const auto dy = y_.head(n_) - y0_.head(n_);
  dense_.setZero(n_, 7);
  dense_.col(0) = dy;
  dense_.col(1) = done_ * k_.col(0) - dy;
  dense_.col(2) = 2.0 * dy - done_ * (k_.col(12) + k_.col(0));
  for (int i = 3; i < 7; ++i)
    for (int j = 0; j < 16; ++j)
      if (const double d = tableaux::rk8_d[16 * (i - 3) + j]; d != 0.0)
        dense_.col(i) += done_ * d * k_.col(j);
  extended_ = true;
}

/// Sets inside_ and its rates at x = (t - t0) / h of the last step, on the polynomial.
void ExplicitRk::follow_polynomial(double x) {
  Eigen::Matrix<double, 7, 1> value, slope; // factors of the columns; slope = d value / dx
  inside_ = y0_;
  inside_yp_ = yp_;
  if (pair_.order == 5) {
    value.setZero();
    slope.setZero();
    for (int i = 0; i < 7; ++i) {
      double power = 1.0;
      for (int k = 0; k < 4; ++k, power *= x) {
        value[i] += tableaux::rk5_p[4 * i + k] * power * x;
        slope[i] += tableaux::rk5_p[4 * i + k] * power * (k + 1);
      }
    }
    inside_.head(n_).noalias() += k_.leftCols(7) * (done_ * value);
    inside_yp_.head(n_).noalias() = k_.leftCols(7) * slope;
    return;
  }
  extend();
  value[0] = x;
  slope[0] = 1.0;
  for (int i = 1; i < 7; ++i) { // products of x and 1 - x in turn
    const double factor = i % 2 == 0 ? x : 1.0 - x;
    value[i] = factor * value[i - 1];
    slope[i] = factor * slope[i - 1] + (i % 2 == 0 ? value[i - 1] : -value[i - 1]);
  }
  inside_.head(n_).noalias() += dense_ * value;
  inside_yp_.head(n_).noalias() = dense_ * (slope / done_);
}

void ExplicitRk::look_inside(double t, VectorX& y, VectorX& yp) {
  if (idle_reactions_)
    follow_motion(t, y, yp);
  else
    interpolate(t, y, yp);
}

double ExplicitRk::stage(std::size_t i, VectorX& y, VectorX& yp) {
  const auto s = static_cast<std::size_t>(pair_.stages);
  set_stage(y0_, done_, static_cast<int>(i), pair_.a.subspan(i * s));
  y = y_;
  yp = yp_;
  y.head(n_) = stage_.head(n_);
  yp.head(n_) = k_.col(static_cast<Index>(i));
  system::normalise(e_.system, y);
  return t0_ + pair_.c[i] * done_;
}

void ExplicitRk::follow_motion(double t, VectorX& y, VectorX& yp) {
  if (t >= t_ || done_ == 0.0)
    return interpolate(t, y, yp);
  follow_polynomial((t - t0_) / done_);
  y = y_;
  yp = yp_;
  y.head(n_) = inside_.head(n_);
  yp.head(n_) = inside_yp_.head(n_);
  system::normalise(e_.system, y);
}

void ExplicitRk::interpolate(double t, VectorX& y, VectorX& yp) {
  if (t >= t_ || done_ == 0.0) {
    y = y_;
    yp = yp_;
    return;
  }
  follow_polynomial((t - t0_) / done_);
  // The polynomial misses the joints by its error, which `close` removes.
  if (!saddle_.accelerations(t, inside_, inside_yp_))
    fail(Reason::not_finite, "no finite accelerations inside the step");
  saddle_.close(t, inside_);
  y = inside_;
  yp = inside_yp_;
  system::normalise(e_.system, y);
}

} // namespace

std::unique_ptr<Integrator> make_explicit_rk(const system::Regime& system,
                                             const system::Pattern& pattern,
                                             const SolverOptions& options, double t0,
                                             const VectorX& y, const VectorX& yp) {
  return std::make_unique<ExplicitRk>(system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::integrate
