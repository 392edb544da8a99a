#include "hydrodae/integrate/generalized_alpha.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/linalg/equations.h"
#include "hydrodae/linalg/newton_matrix.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::integrate {

namespace {

/// Small tolerance of Newton: the step length alone determines the error
constexpr double newton_tolerance = 1e-8;

/// Method with x = (u, z), the algorithm's own accelerations a, and the step number n:
///
///   q_{n+1} = q_n o exp(h dq),  dq = u_n + h (1/2 - beta) a_n + h beta state_.a{n+1} + G^T mu
///   x_{n+1} = x_n + h (1 - gamma) a_n + h gamma state_.a{n+1}
///   (1 - alpha_m) state_.a{n+1} + alpha_m a_n = (1 - alpha_f) x'_{n+1} + alpha_f x'_n
///
/// and F = 0 with x'_{n+1} at n+1. The Newton matrix is the Jacobian with d x' = d x c_x and, as
/// exp is near the identity, d q' = d q c_q:  c_x = (1 - alpha_m) / ((1 - alpha_f) h gamma),
/// c_q = gamma / (beta h).
class GeneralizedAlpha : public Integrator {
public:
  GeneralizedAlpha(const system::Regime& system, const system::Pattern& pattern,
                   const SolverOptions& options, double t0, const VectorX& y, const VectorX& yp)
      : s_(system), pattern_(linalg::condensed(system, pattern)),
        e_(system, pattern_, newton_tolerance), newton_matrix_(system, pattern_), t_(t0),
        h_(options.step), n_x_(system.n_u + system.n_z), y_(y), yp_(yp), trial_(y), trial_yp_(yp),
        residual_(y), w_(y), a_new_(yp.segment(system.u0, n_x_)), state_{a_new_, y, yp, t0, {}},
        velocity_(VectorX::Zero(system.n_u)) {
    const double rho = options.spectral_radius;
    alpha_m_ = (2.0 * rho - 1.0) / (rho + 1.0);
    alpha_f_ = rho / (rho + 1.0);
    gamma_ = 0.5 - alpha_m_ + alpha_f_;
    beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
    e_.accept(t_, y_, yp_);
  }

  double step(double end, double bound) override;
  void interpolate(double t, VectorX& y, VectorX& yp) override;
  int degree() const override { return 3; }
  linalg::Statistics statistics() const override { return e_.statistics; }
  Memory state() const override {
    AlphaState out = state_;
    out.made = {e_.statistics.last_step, e_.statistics.last_order};
    return out;
  }
  void set(const Memory& state) override {
    state_ = memory_of<AlphaState>(state);
    e_.statistics.last_step = state_.made.length;
    e_.statistics.last_order = state_.made.order;
  }

private:
  template <class Visit> void each_tangent(const VectorX& rows, Visit&& visit) const;
  void update(double h);
  bool refresh(double t, double h);
  bool newton(double t, double h, bool full);
  [[noreturn]] void fail(Reason reason, const std::string& what);

  const system::Regime& s_;
  const system::Pattern pattern_;
  linalg::Equations e_;
  linalg::NewtonMatrix<double> newton_matrix_;
  double alpha_m_ = 0, alpha_f_ = 0, beta_ = 0, gamma_ = 0;
  double t_ = 0.0, h_;
  Index n_x_;
  VectorX y_, yp_, trial_, trial_yp_, residual_, w_, a_new_;
  AlphaState state_;      ///< state without the last step, which the statistics have
  VectorX velocity_;      ///< velocity G^T mu of the last residual, tangent
  double factored_ = 0.0; ///< step of the present matrix [s]; 0: none
};

/// Visits the tangent velocity v of each body in the rows of q, whose last part is E(q) v:
/// visit(place in (n_u,), v_k).
template <class Visit>
void GeneralizedAlpha::each_tangent(const VectorX& rows, Visit&& visit) const {
  for (const system::BodyData& b : s_.bodies) {
    const bool free = b.rotation == system::BodyData::Rotation::free;
    const Index u = b.u0 - s_.u0;
    for (int k = 0; k < (free ? b.n_translations : b.n_active); ++k)
      visit(u + k, rows[b.q0 + k]);
    if (!free)
      continue;
    const Index q = b.q0 + b.n_translations;
    const Vector3 turn = 2.0 *
                         quaternion_rate_matrix<double>(Vector4(trial_.segment<4>(q))).transpose() *
                         rows.segment<4>(q);
    for (int k = 0; k < 3; ++k)
      visit(u + b.n_translations + k, turn[k]);
  }
}

void GeneralizedAlpha::fail(Reason reason, const std::string& what) {
  throw SolverError(t_, {reason,
                         what + ", step " + number_text(h_) + " s",
                         "",
                         {{"step", h_}},
                         "",
                         e_.diagnosis(t_, y_, yp_)});
}

/// Updates trial_ and its rates from a_new_, mu and the last G^T mu.
void GeneralizedAlpha::update(double h) {
  trial_.segment(s_.u0, n_x_) =
      y_.segment(s_.u0, n_x_) + h * ((1.0 - gamma_) * state_.a + gamma_ * a_new_);
  trial_yp_.segment(s_.u0, n_x_) =
      ((1.0 - alpha_m_) * a_new_ + alpha_m_ * state_.a - alpha_f_ * yp_.segment(s_.u0, n_x_)) /
      (1.0 - alpha_f_);
  trial_.head(s_.n_q) = y_.head(s_.n_q);
  const Index n = s_.n_u;
  system::retract(s_,
                  h * (y_.segment(s_.u0, n) +
                       h * ((0.5 - beta_) * state_.a.head(n) + beta_ * a_new_.head(n)) + velocity_),
                  trial_);
}

bool GeneralizedAlpha::refresh(double t, double h) {
  e_.jacobian(t, trial_, trial_yp_);
  const double by_x = (1.0 - alpha_m_) / ((1.0 - alpha_f_) * h * gamma_),
               by_q = gamma_ / (beta_ * h);
  factored_ = h;
  return newton_matrix_.factorise(e_.parts, {by_x, by_q, by_x});
}

/// @param full  true: a new Jacobian in each iteration, because the first steps may diverge
bool GeneralizedAlpha::newton(double t, double h, bool full) {
  constexpr int stale = 4;
  const int most = full ? 30 : 12;
  constexpr double accuracy = 1e-4;
  double before = 0.0;
  for (int i = 0; i < most; ++i) {
    update(h);
    if ((full && i > 0 && !(trial_.allFinite() && refresh(t, h))) ||
        !e_.residual(t, trial_, trial_yp_, residual_))
      return false;
    // The rows of q are q' - E (u + G^T mu), and q' = 0 here.
    each_tangent(residual_, [&](Index k, double row) { velocity_[k] = -row - trial_[s_.u0 + k]; });
    residual_.head(s_.n_q).setZero();
    residual_.tail(s_.n - s_.sigma0).setZero();
    newton_matrix_.solve(residual_.data());
    ++e_.statistics.newton_iterations;
    a_new_ -= residual_.segment(s_.u0, n_x_) / (h * gamma_);
    // Contribution of the increment of mu to the velocity of q: c_q dq - du.
    const double by_q = gamma_ / (beta_ * h), share = beta_ / gamma_;
    each_tangent(residual_, [&](Index k, double row) {
      velocity_[k] -= share * (by_q * row - residual_[s_.u0 + k]);
    });
    trial_.segment(s_.lambda0, s_.n_lambda) -= residual_.segment(s_.lambda0, s_.n_lambda);
    trial_.segment(s_.mu0, s_.n_mu) -= beta_ / gamma_ * residual_.segment(s_.mu0, s_.n_mu);
    const double size = e_.norm(w_, residual_);
    if (!std::isfinite(size))
      return false;
    const double rate = i > 0 ? size / before : 1.0;
    if (size * std::min(1.0, rate / std::max(1.0 - rate, 0.1)) <= accuracy && i > 0) {
      update(h);
      if (i >= stale)
        factored_ = 0.0; // new Jacobian at the next step
      return true;
    }
    if (i > 1 && rate > 0.9 && !full)
      return false;
    before = size;
  }
  return false;
}

double GeneralizedAlpha::step(double end, double) {
  double h = h_;
  if (end - t_ < 1.0001 * h)
    h = end - t_;
  e_.weights(y_, w_);
  bool done = false;
  for (int attempt = 0; attempt < 2 && !done; ++attempt) {
    trial_ = y_;
    trial_yp_ = yp_;
    trial_yp_.head(s_.n_q).setZero();
    // from x'_{n+1} = x'_n
    a_new_ = (yp_.segment(s_.u0, n_x_) - alpha_m_ * state_.a) / (1.0 - alpha_m_);
    velocity_.setZero();
    trial_.segment(s_.mu0, s_.n_mu).setZero();
    update(h);
    if ((attempt > 0 || factored_ != h) && !refresh(t_ + h, h))
      fail(Reason::jacobian, "the Jacobian is singular");
    done = newton(t_ + h, h, false);
    if (!done)
      ++e_.statistics.convergence_failures;
  }
  // again with the Jacobian at the point reached
  if (!done && trial_.allFinite() && refresh(t_ + h, h)) {
    done = newton(t_ + h, h, true);
    factored_ = 0.0;
  }
  if (!done)
    fail(Reason::step, "Newton's iteration does not converge at the fixed step");
  state_.y0 = y_;
  state_.yp0 = yp_;
  state_.t0 = t_;
  t_ = h == end - t_ ? end : t_ + h;
  y_ = trial_;
  yp_ = trial_yp_;
  yp_.head(s_.n_q).setZero();
  e_.residual(t_, y_, yp_, residual_);        // rates of q, for the interpolant
  yp_.head(s_.n_q) -= residual_.head(s_.n_q); // the rows are q' - E(q) (u + G^T mu)
  state_.a = a_new_;
  e_.accept(t_, y_, yp_);
  ++e_.statistics.steps;
  e_.statistics.last_step = h;
  e_.statistics.last_order = 2;
  return t_;
}

/// Interpolates q, u, z by a cubic from values and rates at both ends, and reactions linearly.
void GeneralizedAlpha::interpolate(double t, VectorX& y, VectorX& yp) {
  y = y_;
  yp = yp_;
  if (t >= t_ || t_ == state_.t0)
    return;
  const double h = t_ - state_.t0, x = (t - state_.t0) / h, v = 1.0 - x;
  const Index n = s_.lambda0;
  const VectorX slope = (y_ - state_.y0) / h;
  y = v * state_.y0 + x * y_;
  y.head(n) += h * x * v * (v * (state_.yp0 - slope) - x * (yp_ - slope)).head(n);
  yp = v * state_.yp0 + x * yp_;
  system::normalise(s_, y);
}

} // namespace

std::unique_ptr<Integrator> make_generalized_alpha(const system::Regime& system,
                                                   const system::Pattern& pattern,
                                                   const SolverOptions& options, double t0,
                                                   const VectorX& y, const VectorX& yp) {
  return std::make_unique<GeneralizedAlpha>(system, pattern, options, t0, y, yp);
}

} // namespace hydrodae::integrate
