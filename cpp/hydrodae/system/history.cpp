#include "hydrodae/system/history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hydrodae/math/bspline.h"
#include "hydrodae/math/chebyshev.h"
#include "hydrodae/system/hydrodynamics.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::system {

namespace {

constexpr std::array<double, 3> gauss_node{0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> gauss_weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
/// Longest piece of the quadrature, in steps of the kernel's grid
constexpr double longest_piece = 2.0;
/// Times remembered: stages of a step and nodes of its energy balance
constexpr std::size_t memory_of_times = 24;
constexpr std::size_t few = 1024; ///< number of expired points that may stay in memory

/// Cubic Hermite polynomials at x in [0, 1] of a step h: factors of the value and rate at both
/// ends.
std::array<double, 4> hermite(double x, double h) {
  const double v = 1.0 - x;
  return {v * v * (1.0 + 2.0 * x), h * x * v * v, x * x * (3.0 - 2.0 * x), -h * x * x * v};
}

/// Visits the quadrature points of [a, b]: visit(t, weight, x) with x = (t - a) / (b - a).
template <class Visitor> void for_each_point(double a, double b, double longest, Visitor&& visit) {
  const double h = b - a;
  const int pieces = std::max(1, static_cast<int>(std::ceil(h / longest)));
  for (int k = 0; k < pieces; ++k)
    for (std::size_t g = 0; g < gauss_node.size(); ++g) {
      const double x = (k + gauss_node[g]) / pieces;
      visit(a + x * h, gauss_weight[g] * h / pieces, x);
    }
}

/// Kinks of the delays of a system, with the time scale of the fastest body under a delayed law.
Kinks find_kinks(const Regime& s, const SolverOptions& options) {
  std::vector<double> delays;
  double time = INFINITY;
  for (const DelayData& d : s.delays) {
    delays.push_back(d.time);
    if (const BodyData* body = moving_body(s, joint_of(s, d.motion)))
      time = std::min(time, body->time_scale);
  }
  return {std::move(delays), time, options.step > 0.0 ? options.step : options.max_step,
          options.rtol};
}

/// Rounding error of t [s]: times that differ by less are equal.
double rounding(double t) { return 256.0 * std::numeric_limits<double>::epsilon() * std::abs(t); }

} // namespace

History::History(const Regime& system, const SolverOptions& options)
    : s_(system), kernels_(system.hydro.as<water::Convolution>()), rtol_(options.rtol), ws_(system),
      kinks_(find_kinks(system, options)) {
  const water::Convolution& c = kernels_;
  n_U_ = c.empty() ? 0 : s_.hydro.n_moving;
  for (const DelayData& d : s_.delays)
    keep_ = std::max(keep_, d.time);
  state_.point_value.resize(static_cast<std::size_t>(n_U_));
  grid_ = MatrixX::Zero(c.splines.rows(), n_U_);
  piece_grid_ = MatrixX::Zero(c.splines.rows(), 2);
  state_.largest = strength_ = VectorX::Zero(n_U_);
  for (int p = 0; p < c.n_moving_pairs; ++p) {
    const auto [row, column] = c.pairs[static_cast<std::size_t>(p)];
    if (const double mass = s_.hydro.added_mass.moving(row, row); row == column && mass > 0.0)
      strength_[row] = c.splines.col(p).cwiseAbs().maxCoeff() / mass;
  }
  const Eigen::Index n = n_U_, m = static_cast<Eigen::Index>(c.locked.size());
  Past empty;
  empty.memory = VectorX::Zero(n);
  empty.by_U = empty.by_U_dot = MatrixX::Zero(n, n);
  empty.memory_locked = VectorX::Zero(m);
  empty.locked_by_U = empty.locked_by_U_dot = MatrixX::Zero(m, n);
  empty.delayed.resize(s_.delays.size());
  memo_.assign(memory_of_times, empty);
}

/// Signals of a node: U and U'; for each delayed motion s, s' = W u and s'' = W u' + u . T u.
void History::signals(double t, const VectorX& y, const VectorX& yp, Node& node) {
  const auto n_delays = static_cast<Eigen::Index>(s_.delays.size());
  node.value.resize(n_U_ + 2 * n_delays);
  node.rate.resize(node.value.size());
  accept_turns(s_, t, y.data(), yp.data(), ws_);
  if (n_U_ > 0) {
    hydro_motion<double>(s_, ws_);
    node.value.head(n_U_) = ws_.U;
    node.rate.head(n_U_) = ws_.U_dot;
  }
  for (Eigen::Index d = 0; d < n_delays; ++d) {
    const int motion = s_.delays[static_cast<std::size_t>(d)].motion;
    const MotionData& m = s_.motions[static_cast<std::size_t>(motion)];
    const JointData& j = s_.joints[static_cast<std::size_t>(m.joint)];
    const joint::Row<double> w = motion_row<double>(s_, ws_, motion);
    const joint::Vector12 u = joint_velocity<double>(j, ws_.bodies),
                          u_dot = joint_acceleration<double>(j, ws_.bodies);
    const joint::Matrix12 turning =
        joint::motion_curvature(m.motion, j.A, j.B, joint_geometry<double>(j, ws_.bodies));
    const Eigen::Index k = n_U_ + 2 * d;
    node.value[k] = w.value;
    node.rate[k] = node.value[k + 1] = w.gradient.dot(u);
    node.rate[k + 1] = w.gradient.dot(u_dot) + u.dot(turning * u);
  }
}

/// Signals at the Chebyshev points of a step (n_signals, n), and at its end. They have one point
/// more than the step's polynomial, because joint coordinates are not linear in the positions.
MatrixX History::follow(const Node& from, Node& to, const VectorX& y, const VectorX& yp,
                        const Inside& inside, int degree) {
  const bool known = inside && degree >= 3;
  const VectorX x = chebyshev_points(known ? degree + 2 : 4);
  const Eigen::Index last = x.size() - 1;
  const double h = to.t - from.t;
  MatrixX value(from.value.size(), x.size());
  y_ = y;
  yp_ = yp;
  Node node;
  for (Eigen::Index k = 1; known && k < last; ++k) {
    node.t = from.t + x[k] * h;
    inside(node.t, y_, yp_);
    signals(node.t, y_, yp_, node);
    value.col(k) = node.value;
  }
  signals(to.t, y, yp, to); // the angles continue from here
  value.col(0) = from.value;
  value.col(last) = to.value;
  for (Eigen::Index k = 1; !known && k < last; ++k)
    value.col(k) = between(from, to, x[k]);
  return value;
}

/// Cubic Hermite polynomial through the nodes at both ends.
VectorX History::between(const Node& from, const Node& to, double x) {
  const std::array<double, 4> f = hermite(x, to.t - from.t);
  return f[0] * from.value + f[1] * from.rate + f[2] * to.value + f[3] * to.rate;
}

void History::add_points(const Node& from, const Node& to, const MatrixX& value) {
  if (n_U_ == 0)
    return;
  const VectorX points = chebyshev_points(value.cols());
  VectorX U;
  for_each_point(from.t, to.t, longest_piece * kernels_.step,
                 [&](double t, double weight, double x) {
                   chebyshev_weights(points, x, weights_);
                   U.noalias() = value.topRows(n_U_) * weights_;
                   state_.point_time.push_back(t);
                   for (int u = 0; u < n_U_; ++u)
                     state_.point_value[static_cast<std::size_t>(u)].push_back(weight * U[u]);
                 });
}

/// Limits the next step by the error of the cubic from a step's start to its trial end, e(x) = E 16
/// x^2 (1 - x)^2 of U. The load is then wrong by |K| h 8 E / 15, the velocity by h / A_inf times
/// that: order h^6. The limit keeps it below the tolerance of the largest velocity so far.
void History::judge(const Node& from, const Node& to, const MatrixX& value) {
  if (n_U_ == 0)
    return;
  const VectorX x = chebyshev_points(value.cols());
  const double h = to.t - from.t;
  VectorX missed = VectorX::Zero(n_U_);
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    missed = missed.cwiseMax((value.col(k) - between(from, to, x[k])).head(n_U_).cwiseAbs());
    state_.largest = state_.largest.cwiseMax(value.col(k).head(n_U_).cwiseAbs());
  }
  double most = 0.0;
  for (int u = 0; u < n_U_; ++u)
    if (state_.largest[u] > 0.0)
      most = std::max(most,
                      strength_[u] * h * h * 8.0 / 15.0 * missed[u] / (rtol_ * state_.largest[u]));
  state_.longest = 0.9 * h * std::pow(most, -1.0 / 6.0);
}

/// Returns whether a delayed rate jumps at the last node by more than the tolerance.
bool History::rates_jump(const VectorX& value) const {
  for (Eigen::Index k = n_U_ + 1; k < value.size(); k += 2) {
    const double before = state_.nodes.empty() ? 0.0 : state_.nodes.back().value[k];
    if (std::abs(value[k] - before) > rtol_ * std::max(std::abs(value[k]), std::abs(before)))
      return true;
  }
  return false;
}

void History::append(double t, const VectorX& y, const VectorX& yp, const Inside& inside,
                     int degree) {
  Node node;
  node.t = t;
  state_.jumps = false;
  if (state_.nodes.empty() || t <= last_time()) {
    signals(t, y, yp, node);
    if (state_.nodes.empty()) {
      state_.first = node.value;
      state_.start = t;
    }
    kinks_.add(t, rates_jump(node.value) ? 1 : 2);
  } else {
    const Node& from = state_.nodes.back();
    const MatrixX value = follow(from, node, y, yp, inside, degree);
    add_points(from, node, value);
    judge(from, node, value);
    if (!s_.delays.empty())
      state_.pieces.push_back({from.t, t, value.bottomRows(value.rows() - n_U_)});
    state_.jumps = kinks_.pass(t) <= 2;
  }
  node.points = state_.dropped + state_.point_time.size();
  state_.nodes.push_back(std::move(node));
  forget();
  for (Past& past : memo_)
    past.known = false;
}

History::State History::state() const {
  State out = state_;
  out.kinks = kinks_.state();
  out.turns = ws_.turns;
  return out;
}

void History::set(State state) {
  state_ = std::move(state);
  kinks_.set(state_.kinks);
  ws_.turns = state_.turns;
  for (Past& past : memo_)
    past.known = false;
}

/// Forgets the points that no time after the last accepted point but one depends on.
void History::forget() {
  if (state_.nodes.size() < 2)
    return;
  const double from = state_.nodes[state_.nodes.size() - 2].t;
  const auto old_points = static_cast<std::size_t>(
      std::lower_bound(state_.point_time.begin(), state_.point_time.end(), from - kernels_.length) -
      state_.point_time.begin());
  if (old_points > few && 2 * old_points > state_.point_time.size()) {
    state_.point_time.erase(state_.point_time.begin(),
                            state_.point_time.begin() + static_cast<std::ptrdiff_t>(old_points));
    for (std::vector<double>& values : state_.point_value)
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(old_points));
    state_.dropped += old_points;
  }
  const auto old_pieces =
      std::lower_bound(state_.pieces.begin(), state_.pieces.end(), from - keep_ - rounding(from),
                       [](const Piece& piece, double time) { return piece.to < time; }) -
      state_.pieces.begin();
  if (static_cast<std::size_t>(old_pieces) > few || 2 * old_pieces > std::ssize(state_.pieces))
    state_.pieces.erase(state_.pieces.begin(), state_.pieces.begin() + old_pieces);
  if (state_.nodes.size() > 3)
    state_.nodes.erase(state_.nodes.begin());
}

/// Last node at or before t, or the first node if missing.
std::size_t History::node_before(double t) const {
  std::size_t k = state_.nodes.size() - 1;
  while (k > 0 && state_.nodes[k].t > t)
    --k;
  return k;
}

/// Adds `weight` times the four spline weights at x (in steps of the grid) to a column.
void History::scatter(double x, double weight, double* column) const {
  const double cell = std::floor(x);
  const std::array<double, 4> b = bspline_weights(x - cell);
  double* c = column + static_cast<std::ptrdiff_t>(cell);
  for (std::size_t k = 0; k < 4; ++k)
    c[k] += weight * b[k];
}

/// Scatters the completed steps up to `node`; returns the number of grid rows they reach.
Eigen::Index History::gather_steps(double t, std::size_t node) const {
  const water::Convolution& c = kernels_;
  // end of the kernel, in grid cells
  const double cells = static_cast<double>(c.splines.rows() - 3);
  const double oldest = t - cells * c.step;
  const auto begin = state_.point_time.begin(),
             end =
                 begin + static_cast<std::ptrdiff_t>(
                             std::max(state_.nodes[node].points, state_.dropped) - state_.dropped);
  const auto first = std::upper_bound(begin, end, oldest);
  const double per_step = 1.0 / c.step;
  const double span = first == end ? 0.0 : (t - *first) * per_step;
  const Eigen::Index rows =
      std::min<Eigen::Index>(static_cast<Eigen::Index>(span) + 4, c.splines.rows());
  grid_.topRows(rows).setZero();
  const auto from = static_cast<std::size_t>(first - begin),
             to = static_cast<std::size_t>(end - begin);
  // last cell, as a bound against rounding
  const auto last_cell = static_cast<std::ptrdiff_t>(cells) - 1;
  for (std::size_t p = from; p < to; ++p) {
    const double x = (t - state_.point_time[p]) * per_step; // > 0
    const std::ptrdiff_t cell = std::min(static_cast<std::ptrdiff_t>(x), last_cell);
    const std::array<double, 4> b = bspline_weights(x - static_cast<double>(cell));
    double* column = grid_.data() + cell;
    for (int u = 0; u < n_U_; ++u, column += grid_.rows()) {
      const double value = state_.point_value[static_cast<std::size_t>(u)][p];
      for (std::size_t k = 0; k < 4; ++k)
        column[k] += value * b[k];
    }
  }
  return rows;
}

/// Scatters the piece from the node to t: its known part into the grid, whose first `rows` are in
/// use, and the factors of U(t), U'(t) apart. Returns the number of rows that the piece reaches.
Eigen::Index History::gather_piece(double t, std::size_t node, Eigen::Index rows) const {
  const water::Convolution& c = kernels_;
  const Node& from = state_.nodes[node];
  const double h = t - from.t;
  const double cells = static_cast<double>(c.splines.rows() - 3);
  const Eigen::Index reach = std::min<Eigen::Index>(
      static_cast<Eigen::Index>(std::max(h, 0.0) / c.step) + 4, c.splines.rows());
  piece_grid_.topRows(reach).setZero();
  if (reach > rows)
    grid_.middleRows(rows, reach - rows).setZero();
  if (h <= 0.0)
    return reach;
  for_each_point(from.t, t, longest_piece * c.step, [&](double time, double weight, double x) {
    const double at = (t - time) / c.step;
    if (at >= cells)
      return;
    const std::array<double, 4> f = hermite(x, h);
    for (int u = 0; u < n_U_; ++u)
      scatter(at, weight * (f[0] * from.value[u] + f[1] * from.rate[u]), &grid_(0, u));
    scatter(at, weight * f[2], &piece_grid_(0, 0));
    scatter(at, weight * f[3], &piece_grid_(0, 1));
  });
  return reach;
}

/// Loads from the grid, pair by pair.
void History::sum_pairs(bool locked, Eigen::Index rows, Eigen::Index piece_rows, Past& out) const {
  const water::Convolution& c = kernels_;
  out.memory.setZero();
  out.by_U.setZero();
  out.by_U_dot.setZero();
  out.memory_locked.setZero();
  out.locked_by_U.setZero();
  out.locked_by_U_dot.setZero();
  const auto n_pairs = locked ? c.pairs.size() : static_cast<std::size_t>(c.n_moving_pairs);
  for (std::size_t p = 0; p < n_pairs; ++p) {
    const auto kernel = c.splines.col(static_cast<Eigen::Index>(p));
    const int column = c.pairs[p].column;
    const bool moves = static_cast<int>(p) < c.n_moving_pairs;
    const int row = moves ? c.pairs[p].row : c.pairs[p].row - n_U_;
    (moves ? out.memory : out.memory_locked)[row] +=
        kernel.head(rows).dot(grid_.col(column).head(rows));
    (moves ? out.by_U : out.locked_by_U)(row, column) =
        kernel.head(piece_rows).dot(piece_grid_.col(0).head(piece_rows));
    (moves ? out.by_U_dot : out.locked_by_U_dot)(row, column) =
        kernel.head(piece_rows).dot(piece_grid_.col(1).head(piece_rows));
  }
}

/// Delayed s and s', at t - tau; before the start s(0), at rest. At a jump of the past, a step that
/// ends there takes the values before it, and the next step those after it.
std::array<double, 2> History::delayed(int delay, double t) const {
  const double tau = s_.delays[static_cast<std::size_t>(delay)].time, then = t - tau,
               same = rounding(std::max(std::abs(t), tau));
  const bool ahead =
      std::any_of(state_.nodes.rbegin(),
                  state_.nodes.rbegin() + std::min<std::ptrdiff_t>(2, std::ssize(state_.nodes)),
                  [t](const Node& node) { return node.t == t; });
  // time shifted into the piece on the right side of the jump
  const double from = ahead ? then + same : then - same;
  const Eigen::Index k = 2 * delay;
  if (from <= state_.start)
    return {state_.first[n_U_ + k], 0.0};
  const auto piece = std::lower_bound(state_.pieces.begin(), state_.pieces.end(), from,
                                      [](const Piece& one, double time) { return one.to < time; });
  if (piece == state_.pieces.end()) // patterns and poses need the values at any time
    return {state_.nodes.back().value[n_U_ + k], state_.nodes.back().value[n_U_ + k + 1]};
  const double x = (then - piece->from) / (piece->to - piece->from);
  chebyshev_weights(chebyshev_points(piece->value.cols()), x, weights_);
  return {piece->value.row(k).dot(weights_), piece->value.row(k + 1).dot(weights_)};
}

void History::evaluate(double t, bool locked, Past& out) const {
  out.t = t;
  out.known = true;
  out.locked = locked;
  for (std::size_t d = 0; d < s_.delays.size(); ++d)
    out.delayed[d] = delayed(static_cast<int>(d), t);
  if (n_U_ == 0)
    return;
  if (state_.nodes.size() > 1) // patterns and poses need the values at any time
    t = std::max(t, state_.nodes[state_.nodes.size() - 2].t);
  const std::size_t node = node_before(t);
  const Eigen::Index rows = gather_steps(t, node), piece = gather_piece(t, node, rows);
  sum_pairs(locked, std::max(rows, piece), piece, out);
}

const Past& History::at(double t, bool locked) const {
  locked = locked && !kernels_.locked.empty();
  for (const Past& past : memo_)
    if (past.known && past.t == t && (past.locked || !locked))
      return past;
  Past& out = memo_[next_];
  next_ = (next_ + 1) % memo_.size();
  evaluate(t, locked, out);
  return out;
}

} // namespace hydrodae::system
