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

double size_of(const system::BodyData& b, const VectorX& change) {
  const auto own = change.segment(b.q0, b.n_position);
  const auto turn = own.tail(b.n_position - b.n_translations);
  // A quaternion moves by half the angle.
  const double half = b.rotation == system::BodyData::Rotation::free ? 2.0 : 1.0;
  return std::max(own.head(b.n_translations).norm() / b.lever, half * turn.norm());
}

double size_of(const system::Regime& s, const system::StateBlock& states, bool points,
               const VectorX& change) {
  double size = 0.0;
  const auto n = static_cast<Index>(states.unknowns.size());
  if (!points)
    return change.segment(states.first, n)
        .cwiseQuotient(s.scale.segment(states.first, n))
        .cwiseAbs()
        .maxCoeff();
  system::for_each_point(states, [&](Index place, Index, double length) {
    size = std::max(size, change.segment<3>(place).norm() / length);
  });
  return size;
}

} // namespace

VectorX block_sizes(const system::Regime& s, const VectorX& change) {
  VectorX sizes(static_cast<Index>(s.blocks.size()));
  Index i = 0;
  for (const system::Block& block : s.blocks)
    sizes[i++] = block.body >= 0 ? size_of(s.bodies[static_cast<std::size_t>(block.body)], change)
                                 : size_of(s, s.states[static_cast<std::size_t>(block.states)],
                                           block.moves, change);
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

/// Visits where the unknowns of a block stand: visit(first, how many).
template <class Visitor>
void for_each_segment(const system::Regime& s, const system::Block& block, Visitor&& visit) {
  if (block.body >= 0) {
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(block.body)];
    visit(b.q0, static_cast<Index>(b.n_position));
    visit(b.u0, static_cast<Index>(b.n_active));
  } else {
    const system::StateBlock& states = s.states[static_cast<std::size_t>(block.states)];
    visit(states.first, static_cast<Index>(states.unknowns.size()));
  }
}

/// Block by block the error along v, of the size `errors`.
void StageError::take_pattern(const system::Regime& s, const VectorX& v, const VectorX& errors) {
  const VectorX sizes = block_sizes(s, v);
  pattern_ = v;
  for (std::size_t i = 0; i < s.blocks.size(); ++i) {
    const double size = sizes[static_cast<Index>(i)],
                 part = size > 0.0 ? errors[static_cast<Index>(i)] / size : 0.0;
    for_each_segment(s, s.blocks[i],
                     [&](Index first, Index n) { pattern_.segment(first, n) *= part; });
  }
  pattern_.tail(s.lambda0 - s.memory0).setZero(); // linear, and slower than what drives it
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
  if (with_start_)
    return;
  // Stage i misses (c_i^s / s - sum_j a_ij c_j^(s-1)) h^s q^(s) / (s - 1)!, q' = v_d P_d(x) + ...
  const int s = rk.stages, d = degree_;
  const VectorX powers = rk.c.array().pow(d);
  const VectorX missed = rk.c.array().pow(s) / s - (rk.a * powers).array();
  of_stages_ = missed.tail(s - 1).cwiseAbs().maxCoeff();
  for (int k = 1; k <= d; ++k)
    of_stages_ *= static_cast<double>(d + k) / k; // (2 d)! / (d!)^2 in all
}

/// A unit quaternion that turns by w h swings by w h / 2, and what is seen in axes that turn, by
/// w h. Its rate tells so, where v_d tells too little, as stages that are normalised may have
/// hardly any (Lobatto IIIC): v_p of a block from v_(d-1), along which is the error in `along`.
double StageError::of_turn(const system::Regime& s, const system::Block& block, const VectorX& next,
                           const MatrixX& rates, double h, VectorX& along) const {
  if (block.body < 0)
    return 0.0;
  const system::BodyData& b = s.bodies[static_cast<std::size_t>(block.body)];
  if (b.rotation != system::BodyData::Rotation::free)
    return 0.0;
  const Index p = b.q0 + b.n_translations, w = b.u0 + b.n_translations;
  const double half = h * rates.block(p, 0, 4, rates.cols()).colwise().norm().maxCoeff();
  double missed = 2.0 * next.segment<4>(p).norm();
  for (int k = degree_; k <= order_; ++k)
    missed *= half / (2.0 * (2 * k - 1));
  along.segment<4>(p) = next.segment<4>(p);
  along.segment<3>(w) = std::pow(2.0, order_ - degree_ + 1) * next.segment<3>(w);
  return missed;
}

/// v_(d+1) of blocks whose v_d changed much more than it did in the steps before, else 0.
VectorX StageError::find_kinks(const system::Regime& s, const VectorX& v) {
  constexpr double memory = 0.8, much = 5.0;
  const auto n = static_cast<Index>(s.blocks.size());
  change_ = before_.size() == v.size() ? VectorX(v - before_) : VectorX::Zero(v.size());
  const bool first = before_.size() != v.size();
  before_ = v;
  if (first)
    return VectorX::Zero(n);
  const VectorX change = block_sizes(s, change_);
  if (usual_.size() != n)
    usual_ = change;
  const VectorX kinks = (change.array() > much * usual_.array())
                            .select(change / (2.0 * (2 * degree_ + 1)), VectorX::Zero(n));
  usual_ = memory * usual_ + (1.0 - memory) * change;
  return kinks;
}

VectorX StageError::operator()(const system::Regime& s, double h, const VectorX& start,
                               const MatrixX& stages, double time_scale) {
  const auto moving = stages.topRows(s.lambda0);
  const Index n = stages.cols();
  auto coefficient = [&](int row) {
    VectorX v = moving * last_.row(row).tail(n).transpose();
    if (with_start_)
      v += last_(row, 0) * start.head(s.lambda0);
    return v;
  };
  const VectorX v = coefficient(1);
  at_stages_ = of_stages_ * h * block_sizes(s, v);
  // h^3 q''' / 12 (Lobatto IIIC: / 6) from the change of q'' = 2 v_1 / h.
  if (degree_ == 1 && order_ == 2) {
    const VectorX change =
        before_.size() == v.size() ? VectorX(v - before_) : VectorX::Zero(s.lambda0);
    before_ = v;
    VectorX sizes = block_sizes(s, h / (with_start_ ? 6.0 : 3.0) * change);
    take_pattern(s, change, sizes);
    return sizes;
  }
  const VectorX below = coefficient(0), top = block_sizes(s, v), next = block_sizes(s, below);
  const VectorX kinks = find_kinks(s, v);
  const double fade = std::exp(-h / time_scale);
  if (highest_.size() != top.size()) {
    highest_ = VectorX::Zero(top.size());
    below_ = highest_;
  }
  highest_ = fade * highest_ + top;
  below_ = fade * below_ + next;
  VectorX errors(top.size()), along = v, turning = v;
  for (Index i = 0; i < errors.size(); ++i) {
    const double ratio = highest_[i] < below_[i] ? highest_[i] / below_[i] : 1.0;
    const double turn = 2.0 * (2 * degree_ - 1) * ratio; // w h
    double missed = top[i], amplitude = 2.0 * top[i] / turn;
    for (int k = degree_ + 1; k <= order_; ++k)
      missed *= turn / (2.0 * (2 * k - 1));
    const system::Block& block = s.blocks[static_cast<std::size_t>(i)];
    if (const double turned = of_turn(s, block, below, moving, h, turning); turned > missed) {
      missed = turned;
      amplitude = HUGE_VAL;
      for_each_segment(s, block, [&](Index first, Index length) {
        along.segment(first, length) = turning.segment(first, length);
      });
    }
    if (kinks[i] > missed) { // along the change: v_d itself may be gone with the load
      missed = kinks[i];
      for_each_segment(s, block, [&](Index first, Index length) {
        along.segment(first, length) = change_.segment(first, length);
      });
    }
    for (int k = 1; k <= degree_; ++k)
      amplitude *= 2.0 * (2 * k - 1) / turn;
    errors[i] = h * std::min(std::max(order_ - 0.5, 1.0) * missed,
                             std::max(amplitude, top[i]) * h / (summed_time_scales * time_scale));
  }
  take_pattern(s, along, errors);
  return errors;
}

} // namespace hydrodae::solve
