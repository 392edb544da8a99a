#include "hydrodae/integrate/collocation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/integrate/stage_newton.h"
#include "hydrodae/linalg/saddle_point.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::integrate {

namespace {

constexpr int fewest = 3, most_stages = 7; ///< of radau when it chooses: order 5, 9, 13

int stages_of(Family family, int order) {
  switch (family) {
  case Family::radau_iia:
    return order == 0 ? fewest : (order + 1) / 2;
  case Family::gauss:
    return order == 0 ? 3 : order / 2;
  case Family::lobatto_iiic:
    break;
  }
  return order == 0 ? 3 : order / 2 + 1;
}

/// q' = E(q) u of the bodies (n_q,): quaternions turn by half the angular velocity.
VectorX position_rates(const system::Regime& s, const VectorX& y) {
  VectorX rates = VectorX::Zero(s.n_q);
  for (const system::BodyData& b : s.bodies) {
    const bool free = b.rotation == system::BodyData::Rotation::free;
    const Index q = b.q0 + b.n_translations;
    for (int k = 0; k < (free ? b.n_translations : b.n_active); ++k)
      rates[b.q0 + k] = y[b.u0 + k];
    if (free)
      rates.segment<4>(q) = 0.5 * quaternion_rate_matrix<double>(Vector4(y.segment<4>(q))) *
                            y.segment<3>(b.u0 + b.n_translations);
  }
  return rates;
}

class Collocation : public Integrator {
public:
  Collocation(Family family, const system::Regime& system, const system::Pattern& pattern,
              const model::SolverOptions& options, double t0, const VectorX& y, const VectorX& yp)
      : s_(system), pattern_(linalg::condensed(system, pattern)),
        e_(system, pattern_, options.rtol), family_(family), fixed_(options.step > 0.0),
        chooses_order_(options.order == 0 && !fixed_),
        project_(family_ == Family::gauss && system.formulation == system::Formulation::stabilised),
        max_step_(options.max_step > 0.0 ? options.max_step : options.end_time),
        guard_(t0, options.end_time, e_.time_scale()), t_(t0), t0_(t0), y_(y), yp_(yp), y0_(y),
        w_(system.n), error_(system.n), v_(VectorX::Zero(system.n)), guess_(system.n),
        guess_rate_(system.n) {
    use(stages_of(family_, options.order));
    if (project_)
      saddle_.emplace(e_);
    // The first step leaves rounding of the multipliers, eps / h, below the tolerance.
    h_ = fixed_ ? options.step : std::min(max_step_, 3.0 * e_.first_step(y, yp));
    reach_ = t0 + h_;
    find_driven();
    e_.accept(t_, y_, yp_);
  }

  double step(double end, double bound) override;
  bool restart(double t, const VectorX& y, const VectorX& yp) override;
  void interpolate(double t, VectorX& y, VectorX& yp) override;
  linalg::Statistics statistics() const override { return e_.statistics; }
  double gap() const override { return gap_; }
  int degree() const override { return last().stages; }
  int quadrature_nodes() const override { return newton_->rk().stages + 2; }
  void remember(Archive& a) override;

private:
  void use(int stages);
  void start_values(double h, bool extrapolate);
  void jacobian(double h, bool extrapolate);
  bool at_once() const { return last_contraction_ <= 1e-3; }
  bool serves(double h) const;
  bool simplified(double h);
  bool full(double h);
  double error(double h, bool refine);
  void find_driven();
  double drive_error(double h);
  void accept(double h);
  void between_ends(double x, VectorX& y) const;
  void choose_order(double error, bool cut);
  const RungeKutta& last() const { return methods_.at(static_cast<int>(Z_.cols()))->rk(); }
  void evaluate(double x, VectorX& y) const;
  static void evaluate(const system::Regime& s, const RungeKutta& rk, const VectorX& start,
                       const MatrixX& Z, double x, VectorX& y);
  void evaluate_rates(double x, VectorX& yp) const;
  [[noreturn]] void fail(Reason reason, const std::string& what);

  const system::Regime& s_;
  const system::Pattern pattern_; ///< of Newton's matrix
  linalg::Equations e_;
  const Family family_;
  const bool fixed_, chooses_order_, project_;
  const double max_step_;
  double end_ = 0.0;                          ///< of the step in the making [s]
  std::optional<linalg::SaddlePoint> saddle_; ///< where the end of a step is projected
  linalg::ProgressGuard guard_;
  std::map<int, std::unique_ptr<StageNewton>> methods_; ///< by number of stages
  StageNewton* newton_ = nullptr;
  double t_ = 0.0, t0_ = 0.0, h_ = 0.0, done_ = 0.0;
  double reach_ = 0.0; ///< time to which the error control would have stepped [s]
  VectorX y_, yp_, y0_, w_, error_, v_, guess_, guess_rate_;
  MatrixX Z_, start_, rates_; ///< stages of the last step; start values; their rates
  std::vector<std::pair<Index, int>> driven_; ///< rows that drives move, with their groups
  bool fresh_ = false;                        ///< the Jacobian is of this step
  double factored_ = 0.0;                     ///< step of the matrices at hand [s]
  double contraction_ = 1.0;                  ///< of the last step with matrices of its own
  int iterations_ = 0;                        ///< that this step took
  double last_contraction_ = 1.0;             ///< of the last step
  double extra_ = 0.0;                        ///< iterations that old matrices have cost since
  int wary_ = 0, wait_ = 0; ///< steps to make with new ones after old ones failed; left of them
  bool was_full_ = false;   ///< the last step took full Newton
  double last_h_ = 0.0, last_error_ = 1.0;
  VectorX nodes_;                    ///< of the interpolant, on [0, 1]
  double gap_ = 1.0;                 ///< see `gap`
  VectorX slope0_, slope_;           ///< rates of the positions at both ends, where it is a line
  int since_change_ = 0, slack_ = 0; ///< steps of this order; those last that Newton limited
};

void Collocation::use(int stages) {
  std::unique_ptr<StageNewton>& entry = methods_[stages];
  if (!entry)
    entry = std::make_unique<StageNewton>(e_, make_runge_kutta(family_, stages));
  newton_ = entry.get();
  nodes_ = newton_->rk().c;
  gap_ = fixed_ ? 1.0 : largest_gap({nodes_.begin(), nodes_.end()});
  if (family_ != Family::lobatto_iiic) {
    nodes_.conservativeResize(stages + 1);
    nodes_[stages] = 0.0;
  }
  factored_ = 0.0;
  since_change_ = slack_ = 0;
  last_h_ = 0.0; // its error was another method's
}

void Collocation::fail(Reason reason, const std::string& what) {
  throw SolverError(t_, {reason,
                         what + ", last step " + number_text(h_) + " s",
                         "",
                         {{"step", h_}},
                         "",
                         e_.diagnosis(t_, y_, yp_)});
}

/// y at x = (t - t0) / h of the last step: through its start and stages; Lobatto's first stage
/// stands at the start itself, and multipliers of Gauss have no value there.
void Collocation::evaluate(double x, VectorX& y) const {
  evaluate(s_, last(), y0_, Z_, x, y); // of the last step: the order may have changed since
}

void Collocation::evaluate(const system::Regime& s_, const RungeKutta& rk, const VectorX& start,
                           const MatrixX& Z_, double x, VectorX& y) {
  const bool with_start = rk.family != Family::lobatto_iiic;
  y = start;
  for (int i = 0; i < rk.stages; ++i) {
    double stages_only = 1.0;
    for (int j = 0; j < rk.stages; ++j)
      if (j != i)
        stages_only *= (x - rk.c[j]) / (rk.c[i] - rk.c[j]);
    const double weight = with_start ? stages_only * x / rk.c[i] : stages_only;
    const Index n = s_.lambda0, m = s_.n - n;
    if (with_start || i > 0) // the first stage of Lobatto IIIC misses the start by h^s
      y.head(n) += weight * Z_.col(i).head(n);
    y.tail(m) += (rk.family == Family::gauss ? stages_only : weight) * Z_.col(i).tail(m);
  }
}

/// y' at x of the last step, through its stages.
void Collocation::evaluate_rates(double x, VectorX& yp) const {
  const RungeKutta& rk = last();
  yp.setZero(s_.n);
  for (int i = 0; i < rk.stages; ++i) {
    double weight = 1.0;
    for (int j = 0; j < rk.stages; ++j)
      if (j != i)
        weight *= (x - rk.c[j]) / (rk.c[i] - rk.c[j]);
    yp += weight * rates_.col(i);
  }
}

/// First guess of the stages: the last step's polynomial, or a straight line.
void Collocation::start_values(double h, bool extrapolate) {
  const RungeKutta& rk = newton_->rk();
  start_.resize(s_.n, rk.stages);
  if (extrapolate) {
    for (int i = 0; i < rk.stages; ++i) {
      evaluate(1.0 + rk.c[i] * h / done_, guess_);
      start_.col(i) = guess_ - y_;
    }
    return;
  }
  for (int i = 0; i < rk.stages; ++i) {
    start_.col(i) = rk.c[i] * h * yp_;
    start_.col(i).tail(s_.n - s_.lambda0).setZero();
  }
}

/// One Jacobian for all stages: in the middle of the step, by the last polynomial if there is one:
/// so that it differs least from that of any stage; else at the start.
void Collocation::jacobian(double h, bool extrapolate) {
  if (extrapolate) {
    const double x = 1.0 + 0.5 * h / done_;
    evaluate(x, guess_);
    evaluate_rates(x, guess_rate_);
    e_.jacobian(t_ + 0.5 * h, guess_, guess_rate_);
  } else {
    e_.jacobian(t_, y_, yp_);
  }
  fresh_ = true;
  factored_ = extra_ = 0.0;
}

/// Do the matrices at hand serve a step h? Where Newton contracts at once; where they are
/// expensive, until the iterations that they cost beyond those of new ones are worth a renewal.
bool Collocation::serves(double h) const {
  constexpr double same = 1e-9;
  constexpr double dear = 4.0; // iterations
  return factored_ > 0.0 && std::abs(h - factored_) <= same * h &&
         (at_once() || (newton_->renewal() >= dear && extra_ < newton_->renewal() && wait_ == 0));
}

/// Simplified Newton from the last polynomial, with the matrices at hand where they serve; if it
/// fails with new ones, and from a straight line with those of the start.
bool Collocation::simplified(double h) {
  constexpr double longest_guess = 3.0; // steps of the last polynomial
  constexpr int most_wary = 15;         // steps
  bool extrapolate = done_ > 0.0 && h <= longest_guess * done_;
  bool renew = !fresh_ && !(factored_ > 0.0 && at_once()) && !serves(h);
  for (;;) {
    if (renew)
      jacobian(h, extrapolate);
    const bool serving = serves(h), old = serving && !at_once();
    if (serving || newton_->factorise(h)) {
      factored_ = h;
      start_values(h, extrapolate);
      if (newton_->simplified(t_, h, y_, w_, start_) == NewtonResult::converged) {
        last_contraction_ = newton_->contraction;
        if (old) {
          extra_ += std::max(0, newton_->iterations - iterations_);
          wary_ = 0;
        } else {
          wait_ = std::max(0, wait_ - 1);
          contraction_ = newton_->contraction;
          iterations_ = newton_->iterations;
        }
        was_full_ = false;
        return true;
      }
      if (old)
        wait_ = wary_ = std::min(2 * wary_ + 1, most_wary);
    }
    if (fresh_ && !extrapolate)
      break;
    extrapolate = extrapolate && !fresh_;
    renew = true;
  }
  fresh_ = false;
  factored_ = 0.0;
  return false;
}

bool Collocation::full(double h) {
  start_values(h, false);
  fresh_ = false; // the Jacobian at hand will be that of a stage
  factored_ = 0.0;
  was_full_ = newton_->full(t_, h, y_, w_, start_) == NewtonResult::converged;
  return was_full_;
}

/// Local error in units of the tolerance: (J + B / (gamma0 h))^-1 (B v + f(t0, y0)),
/// v = sum error_i Z_i / (gamma0 h); once more from y0 + error where it would reject.
double Collocation::error(double h, bool refine) {
  const RungeKutta& rk = newton_->rk();
  if (was_full_) { // start or end may be singular
    const int middle = rk.stages / 2;
    MatrixX rate;
    newton_->rates(h, start_, rate);
    e_.jacobian(t_ + rk.c[middle] * h, y_ + start_.col(middle), rate.col(middle));
    if (!newton_->factorise(h))
      return 0.0; // judged by the next steps
  }
  v_ = -start_ * rk.error / (rk.gamma0 * h);
  VectorX at = y_;
  double size = 0.0;
  for (int pass = 0; pass < (refine ? 2 : 1); ++pass) {
    if (!e_.residual(t_, at, v_, error_))
      return HUGE_VAL;
    // The start meets the constraints: what shows of them is left of Newton's iteration.
    if (s_.formulation != system::Formulation::index_1)
      error_.tail(s_.n - s_.lambda0).setZero();
    newton_->solve_real(error_);
    error_ = -error_;
    size = e_.norm(w_, error_);
    if (size < 1.0)
      break;
    at.head(s_.lambda0) = (y_ + error_).head(s_.lambda0);
  }
  return std::max(size, 1e-10);
}

/// The rows that drives move, and those that pass their motion on.
void Collocation::find_driven() {
  const auto group_of = [&](const system::JointData& j) {
    const system::BodyData* body = system::moving_body(s_, j);
    return body ? body->group : -1;
  };
  const bool stabilised = s_.formulation == system::Formulation::stabilised;
  std::vector<bool> driven(static_cast<std::size_t>(s_.n_groups));
  for (const system::CouplerData& c : s_.couplers) {
    if (const int g = group_of(system::joint_of(s_, c));
        s_.holds(c) && (c.velocity_level || c.drive.moves() || c.drive.rate != 0.0) && g >= 0) {
      driven[static_cast<std::size_t>(g)] = true;
      driven_.emplace_back(stabilised && !c.velocity_level ? s_.mu(c) : s_.lambda(c), g);
    }
  }
  for (const system::JointData& j : s_.joints)
    if (const int g = group_of(j); stabilised && g >= 0 && driven[static_cast<std::size_t>(g)])
      for (const system::RowData& row : j.rows)
        if (s_.holds(row) && s_.mu(row) >= 0)
          driven_.emplace_back(s_.mu(row), g);
}

/// What the polynomial of the step leaves of the driven constraints between its stages, in units of
/// the tolerance. At the stages they hold, whatever the step: the estimate above does not see them.
double Collocation::drive_error(double h) {
  const RungeKutta& rk = newton_->rk();
  double size = 0.0;
  const double last = rk.stages > 1 ? rk.c[rk.stages - 2] : 0.0;
  for (const double x : {0.5 * rk.c[0], 0.5 * (last + 1.0)}) {
    evaluate(s_, rk, y_, start_, x, guess_);
    v_.setZero();
    if (!e_.residual(t_ + x * h, guess_, v_, error_))
      return HUGE_VAL;
    for (const auto& [row, group] : driven_)
      size = std::max(size, std::abs(error_[row]) /
                                (e_.rtol * s_.motion_scale[group] * s_.row_scale[row]));
  }
  return size;
}

/// Where the interpolant is a line: velocities on a line between both ends of the step, positions
/// on the cubic that has their rates there, so that what falls does so on a parabola.
void Collocation::between_ends(double x, VectorX& y) const {
  const double v = 1.0 - x;
  y.head(s_.lambda0) = v * y0_.head(s_.lambda0) + x * y_.head(s_.lambda0);
  const VectorX change = (y_ - y0_).head(s_.n_q);
  y.head(s_.n_q) += x * v * (v * (done_ * slope0_ - change) - x * (done_ * slope_ - change));
}

void Collocation::accept(double h) {
  const RungeKutta& rk = newton_->rk();
  Z_ = start_;
  newton_->rates(h, Z_, rates_);
  y0_ = y_;
  t0_ = t_;
  done_ = h;
  t_ = end_ - t_ <= h ? end_ : t_ + h;
  if (rk.stiffly_accurate()) {
    y_ += Z_.col(rk.stages - 1);
    yp_ = rates_.col(rk.stages - 1);
  } else {
    VectorX at_end(s_.n);
    evaluate(1.0, at_end);
    y_.head(s_.lambda0) += (Z_ * rk.end).head(s_.lambda0);
    y_.tail(s_.n - s_.lambda0) = at_end.tail(s_.n - s_.lambda0);
    evaluate_rates(1.0, yp_);
    if (project_ && (!saddle_->accelerations(t_, y_, yp_) || !saddle_->project(t_, y_) ||
                     !saddle_->accelerations(t_, y_, yp_)))
      fail(Reason::drift, "the constraints cannot be met at the end of the step");
  }
  e_.accept(t_, y_, yp_);
  if (nodes_.size() <= 2) {
    slope0_ = position_rates(s_, y0_);
    slope_ = position_rates(s_, y_);
  }
  fresh_ = false;
  ++e_.statistics.steps;
  e_.statistics.last_step = h;
  e_.statistics.last_order = rk.order;
}

/// More stages where Newton contracts at once (Hairer and Wanner 1999), fewer where for long Newton
/// limits the step and the error, here of the last step, does not: two stages change it about 300
/// times. A step that was cut, by waves or an end, needs no more stages, and fewer where the error
/// leaves room.
void Collocation::choose_order(double error, bool cut) {
  constexpr double up = 0.02, down = 0.1, little = 1e-3;
  if (!chooses_order_ || was_full_)
    return;
  ++since_change_;
  slack_ = (contraction_ >= down || cut) && error <= little ? slack_ + 1 : 0;
  const int stages = newton_->rk().stages;
  if (contraction_ <= up && stages < most_stages && since_change_ >= 10 && !cut)
    use(stages + 2);
  else if (slack_ >= 20 && stages > fewest) // passing a singular pose takes fewer steps
    use(stages - 2);
}

double Collocation::step(double end, double bound) {
  constexpr double safety = 0.9, most_growth = 5.0, most_cut = 0.125;
  constexpr double newton_cut = 0.4, aim = 0.25; // of the step; of Newton's contraction
  end_ = end;
  bool rejected = done_ == 0.0;
  double hopeless = HUGE_VAL; // step from which on simplified Newton fails
  for (;;) {
    const double left = end_ - t_, bounded = fixed_ ? HUGE_VAL : bound - t_, wanted = h_;
    auto fitted = [&](double h) { return std::min(left - h < 0.01 * h ? left : h, bounded); };
    double h = fitted(h_);
    if (h < 1e-13 * std::max(std::abs(t_), e_.time_scale()) && h < left)
      fail(Reason::step,
           "Newton's iteration does not converge, or the local error stays too large, however "
           "short the step");
    e_.weights(y_, w_);
    // Shorter steps help simplified Newton. Near a singular pose they would shrink without end:
    // full Newton takes the step that the error allows, at the cost of about 2 s of the short ones.
    const double allowed = std::min({reach_, end_, fixed_ ? end_ : bound}) - t_;
    const double shortest = fixed_ ? 0.0 : allowed / (2.0 * newton_->rk().stages);
    bool solved = h >= shortest && h < hopeless && simplified(h);
    if (!solved && !fixed_ && newton_cut * h >= shortest) {
      hopeless = std::min(hopeless, h);
      h_ = newton_cut * h;
      rejected = true;
      continue;
    }
    if (!solved) {
      h = fixed_ ? h : fitted(std::max(h, allowed));
      solved = full(h);
    }
    if (!solved) {
      ++e_.statistics.convergence_failures;
      if (fixed_)
        fail(Reason::step,
             "Newton's iteration does not converge at the fixed step, simplified or full");
      h_ = std::min(h_, 0.7 * h);
      reach_ = t_ + 0.7 * h;
      rejected = true;
      continue;
    }
    if (fixed_) {
      accept(h);
      return t_;
    }
    double err = error(h, rejected);
    if (!driven_.empty())
      err = std::max(err, drive_error(h));
    const double power = 1.0 / (newton_->rk().stages + 1);
    double grow = std::clamp(safety * std::pow(err, -power), most_cut, most_growth);
    if (!(err < 1.0)) {
      ++e_.statistics.error_test_failures;
      h_ = h * (std::isfinite(err) ? std::min(grow, 0.9) : most_cut);
      reach_ = t_ + h_;
      rejected = true;
      continue;
    }
    const double next_reach = t_ + h + std::min(max_step_, h * grow);
    if (last_h_ > 0.0) // predictive control of Gustafsson
      grow = std::min(grow,
                      std::clamp(h / last_h_ * std::pow(err * err / last_error_, -power) * safety,
                                 most_cut, most_growth));
    if (rejected)
      grow = std::min(grow, 1.0);
    if (!was_full_) // the contraction goes with the square of the step
      grow = std::min(grow, std::max(std::sqrt(aim / contraction_), 0.3));
    last_h_ = h;
    last_error_ = std::max(err, 1e-2);
    accept(h);
    reach_ = std::max(reach_, next_reach);
    if (!(grow >= 1.0 && grow <= 1.2 && contraction_ <= 1e-3)) // else the matrices serve again
      h_ = std::min(max_step_, h * grow);
    else
      h_ = h;
    if (h == left) // a step that was cut says nothing against longer ones
      h_ = std::max(h_, wanted);
    choose_order(err, h < wanted);
    guard_.after_step(t_, [&] { return e_.diagnosis(t_, y_, yp_); });
    return t_;
  }
}

/// The number of stages stays; more are tried where there is time between two restarts.
bool Collocation::restart(double t, const VectorX& y, const VectorX& yp) {
  t_ = t0_ = t;
  y_ = y0_ = y;
  yp_ = yp;
  done_ = last_h_ = 0.0;
  last_error_ = 1.0;
  since_change_ = slack_ = 0;
  fresh_ = false;
  reach_ = t + h_;
  e_.accept(t_, y_, yp_);
  return true;
}

void Collocation::interpolate(double t, VectorX& y, VectorX& yp) {
  if (done_ == 0.0) {
    y = y_;
    yp = yp_;
    return;
  }
  const double x = (t - t0_) / done_;
  if (t >= t_) {
    y = y_;
    yp = yp_;
    return;
  }
  evaluate(x, y);
  evaluate_rates(x, yp);
  if (nodes_.size() <= 2)
    between_ends(x, y);
}

/// Without the matrices: they are made again.
void Collocation::remember(Archive& a) {
  int stages = newton_->rk().stages;
  a(stages, Z_);
  if (!a.saves()) {
    if (Z_.cols() > 0)
      use(static_cast<int>(Z_.cols())); // the last step may have been one of another order
    use(stages);
  }
  a(rates_, y0_, t0_, done_, slope0_, slope_, h_, reach_, last_h_, last_error_, contraction_,
    last_contraction_, wary_, wait_, was_full_, since_change_, slack_, e_.statistics.last_step,
    e_.statistics.last_order, guard_);
}

} // namespace

std::unique_ptr<Integrator> make_radau(const system::Regime& system, const system::Pattern& pattern,
                                       const model::SolverOptions& options, double t0,
                                       const VectorX& y, const VectorX& yp) {
  return std::make_unique<Collocation>(Family::radau_iia, system, pattern, options, t0, y, yp);
}

std::unique_ptr<Integrator> make_gauss(const system::Regime& system, const system::Pattern& pattern,
                                       const model::SolverOptions& options, double t0,
                                       const VectorX& y, const VectorX& yp) {
  return std::make_unique<Collocation>(Family::gauss, system, pattern, options, t0, y, yp);
}

std::unique_ptr<Integrator> make_lobatto_iiic(const system::Regime& system,
                                              const system::Pattern& pattern,
                                              const model::SolverOptions& options, double t0,
                                              const VectorX& y, const VectorX& yp) {
  return std::make_unique<Collocation>(Family::lobatto_iiic, system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::integrate
