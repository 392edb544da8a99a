#include "hydrodae/solve/step_error.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::solve {

namespace {

/// Legendre polynomials of degree 0 to n on [0, 1] at x.
VectorX legendre(int n, double x) {
  VectorX p(n + 1);
  p[0] = 1.0;
  const double y = 2.0 * x - 1.0;
  for (int k = 1; k <= n; ++k)
    p[k] = k == 1 ? y : ((2 * k - 1) * y * p[k - 1] - (k - 1) * p[k - 2]) / k;
  return p;
}

} // namespace

VectorX body_sizes(const system::Regime& s, const VectorX& dq) {
  VectorX sizes(static_cast<Index>(s.bodies.size()));
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    const auto own = dq.segment(b.q0, b.n_position);
    const auto turn = own.tail(b.n_position - b.n_translations);
    // A quaternion moves by half the angle.
    const double half = b.rotation == system::BodyData::Rotation::free ? 2.0 : 1.0;
    sizes[static_cast<Index>(i)] =
        std::max(own.head(b.n_translations).norm() / b.lever, half * turn.norm());
  }
  return sizes;
}

VectorX to_positions(const system::Regime& s, const VectorX& y, const VectorX& tangent) {
  VectorX dq = VectorX::Zero(s.n_q);
  for (const system::BodyData& b : s.bodies) {
    const bool free = b.rotation == system::BodyData::Rotation::free;
    const Index u = b.u0 - s.u0, q = b.q0 + b.n_translations;
    for (int k = 0; k < (free ? b.n_translations : b.n_active); ++k)
      dq[b.q0 + k] = tangent[u + k];
    if (free)
      dq.segment<4>(q) = 0.5 * quaternion_rate_matrix<double>(Vector4(y.segment<4>(q))) *
                         tangent.segment<3>(u + b.n_translations);
  }
  return dq;
}

/// Body by body the error along v, of the size `errors` in the positions.
void StageError::take_pattern(const system::Regime& s, const VectorX& v, const VectorX& errors) {
  const VectorX sizes = body_sizes(s, v);
  pattern_ = v;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    const double size = sizes[static_cast<Index>(i)],
                 part = size > 0.0 ? errors[static_cast<Index>(i)] / size : 0.0;
    pattern_.segment(b.q0, b.n_position) *= part;
    pattern_.segment(b.u0, b.n_active) *= part;
  }
}

StageError::StageError(const RungeKutta& rk)
    : order_(rk.order), with_start_(rk.family != Family::lobatto_iiic) {
  const int nodes = rk.stages + (with_start_ ? 1 : 0);
  degree_ = nodes - 1;
  MatrixX values(nodes, nodes); // of the polynomials at the nodes
  for (int i = 0; i < nodes; ++i) {
    const double x = with_start_ ? (i == 0 ? 0.0 : rk.c[i - 1]) : rk.c[i];
    values.row(i) = legendre(degree_, x).transpose();
  }
  last_ = values.inverse().bottomRows(2);
}

VectorX StageError::operator()(const system::Regime& s, double h, const VectorX& start,
                               const MatrixX& stages, double time_scale) {
  const auto moving = stages.topRows(s.z0);
  const Index n = stages.cols();
  auto coefficient = [&](int row) {
    VectorX v = moving * last_.row(row).tail(n).transpose();
    if (with_start_)
      v += last_(row, 0) * start.head(s.z0);
    return v;
  };
  const VectorX v = coefficient(1);
  // h^3 q''' / 12 (Lobatto IIIC: / 6) from the change of q'' = 2 v_1 / h.
  if (degree_ == 1 && order_ == 2) {
    const VectorX change = before_.size() == v.size() ? VectorX(v - before_) : VectorX::Zero(s.z0);
    before_ = v;
    VectorX sizes = body_sizes(s, h / (with_start_ ? 6.0 : 3.0) * change);
    take_pattern(s, change, sizes);
    return sizes;
  }
  const VectorX top = body_sizes(s, v), next = body_sizes(s, coefficient(0));
  const double fade = std::exp(-h / time_scale);
  if (highest_.size() != top.size()) {
    highest_ = VectorX::Zero(top.size());
    below_ = highest_;
  }
  highest_ = fade * highest_ + top;
  below_ = fade * below_ + next;
  VectorX errors(top.size());
  for (Index i = 0; i < errors.size(); ++i) {
    const double ratio = highest_[i] < below_[i] ? highest_[i] / below_[i] : 1.0;
    const double turn = 2.0 * (2 * degree_ - 1) * ratio; // w h
    double missed = top[i], amplitude = 2.0 * top[i] / turn;
    for (int k = degree_ + 1; k <= order_; ++k)
      missed *= turn / (2.0 * (2 * k - 1));
    for (int k = 1; k <= degree_; ++k)
      amplitude *= 2.0 * (2 * k - 1) / turn;
    errors[i] = h * std::min(std::max(order_ - 0.5, 1.0) * missed,
                             std::max(amplitude, top[i]) * h / (summed_time_scales * time_scale));
  }
  take_pattern(s, v, errors);
  return errors;
}

} // namespace hydrodae::solve
