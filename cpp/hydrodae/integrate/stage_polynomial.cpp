#include "hydrodae/integrate/stage_polynomial.h"
#include "hydrodae/system/regime.h"

namespace hydrodae::integrate {

namespace {

/// Rates q' = E(q) u of the bodies (n_q,): quaternions turn by half the angular velocity.
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

/// Lagrange weight of stage i at x, through the stages.
double stage_weight(const RungeKutta& rk, int i, double x) {
  double weight = 1.0;
  for (int j = 0; j < rk.stages; ++j)
    if (j != i)
      weight *= (x - rk.c[j]) / (rk.c[i] - rk.c[j]);
  return weight;
}

} // namespace

void evaluate_stages(const system::Regime& s, const RungeKutta& rk, const VectorX& start,
                     const MatrixX& Z, double x, VectorX& y) {
  const bool with_start = rk.family != Family::lobatto_iiic;
  y = start;
  for (int i = 0; i < rk.stages; ++i) {
    const double stages_only = stage_weight(rk, i, x);
    const double weight = with_start ? stages_only * x / rk.c[i] : stages_only;
    const Index n = s.lambda0, m = s.n - n;
    if (with_start || i > 0) // the first stage of Lobatto IIIC misses the start by h^s
      y.head(n) += weight * Z.col(i).head(n);
    y.tail(m) += (rk.family == Family::gauss ? stages_only : weight) * Z.col(i).tail(m);
  }
}

void StagePolynomial::accept(double t0, double h, const VectorX& y0, const MatrixX& Z,
                             const MatrixX& rates) {
  state_.t0 = t0;
  state_.h = h;
  state_.y0 = y0;
  state_.Z = Z;
  state_.rates = rates;
}

void StagePolynomial::end_at(const VectorX& y) {
  state_.slope0 = position_rates(s_, state_.y0);
  state_.slope = position_rates(s_, y);
}

void StagePolynomial::evaluate_rates(double x, VectorX& yp) const {
  yp.setZero(s_.n);
  for (int i = 0; i < rk_->stages; ++i)
    yp += stage_weight(*rk_, i, x) * state_.rates.col(i);
}

void StagePolynomial::between_ends(double x, const VectorX& end, VectorX& y) const {
  const double v = 1.0 - x;
  y.head(s_.lambda0) = v * state_.y0.head(s_.lambda0) + x * end.head(s_.lambda0);
  const VectorX change = (end - state_.y0).head(s_.n_q);
  y.head(s_.n_q) +=
      x * v * (v * (state_.h * state_.slope0 - change) - x * (state_.h * state_.slope - change));
}

} // namespace hydrodae::integrate
