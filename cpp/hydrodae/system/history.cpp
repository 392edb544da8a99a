#include "hydrodae/system/history.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/math/bspline.h"
#include "hydrodae/system/hydrodynamics.h"

namespace hydrodae::system {

namespace {

constexpr std::array<double, 3> gauss_node{0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> gauss_weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
constexpr double longest_piece = 2.0;       ///< of the quadrature, in steps of the kernel's grid
constexpr std::size_t memory_of_times = 24; ///< stages of a step and nodes of its energy balance
constexpr std::size_t few = 1024;           ///< points too old that may stay

/// Cubic Hermite polynomials at x in [0, 1] of a step h: factors of value and rate at both ends.
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

} // namespace

History::History(const Regime& system) : s_(system), ws_(system) {
  const Convolution& c = s_.hydro.convolution;
  n_U_ = c.empty() ? 0 : s_.hydro.n_moving;
  for (const DelayData& d : s_.delays)
    keep_ = std::max(keep_, d.time);
  point_value_.resize(static_cast<std::size_t>(n_U_));
  grid_ = MatrixX::Zero(c.splines.rows(), n_U_);
  piece_grid_ = MatrixX::Zero(c.splines.rows(), 2);
  const Eigen::Index n = n_U_, m = static_cast<Eigen::Index>(c.locked.size());
  Past empty;
  empty.memory = VectorX::Zero(n);
  empty.by_U = empty.by_U_dot = MatrixX::Zero(n, n);
  empty.memory_locked = VectorX::Zero(m);
  empty.locked_by_U = empty.locked_by_U_dot = MatrixX::Zero(m, n);
  empty.delayed.resize(s_.delays.size());
  memo_.assign(memory_of_times, empty);
}

/// U and U'; of each delayed motion s, s' = W u and s'' = W u' + u . T u.
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

void History::add_points(const Node& from, const Node& to) {
  const double h = to.t - from.t;
  if (n_U_ == 0 || h <= 0.0)
    return;
  for_each_point(from.t, to.t, longest_piece * s_.hydro.convolution.step,
                 [&](double t, double weight, double x) {
                   const std::array<double, 4> f = hermite(x, h);
                   point_time_.push_back(t);
                   for (int u = 0; u < n_U_; ++u)
                     point_value_[static_cast<std::size_t>(u)].push_back(
                         weight * (f[0] * from.value[u] + f[1] * from.rate[u] + f[2] * to.value[u] +
                                   f[3] * to.rate[u]));
                 });
}

void History::append(double t, const VectorX& y, const VectorX& yp) {
  Node node;
  node.t = t;
  signals(t, y, yp, node);
  if (nodes_.empty()) {
    first_ = node.value;
    start_ = t;
  } else {
    add_points(nodes_.back(), node);
  }
  node.points = dropped_ + point_time_.size();
  nodes_.push_back(std::move(node));
  forget();
  for (Past& past : memo_)
    past.known = false;
}

void History::remember(Archive& a) {
  a(nodes_, first_, start_, point_time_, point_value_, dropped_, ws_.turns);
  for (Past& past : memo_)
    past.known = false;
}

/// Lets go what no time from the last accepted point but one on will ask for.
void History::forget() {
  if (nodes_.size() < 2)
    return;
  const double from = nodes_[nodes_.size() - 2].t;
  const auto old_points = static_cast<std::size_t>(
      std::lower_bound(point_time_.begin(), point_time_.end(), from - s_.hydro.convolution.length) -
      point_time_.begin());
  if (old_points > few && 2 * old_points > point_time_.size()) {
    point_time_.erase(point_time_.begin(),
                      point_time_.begin() + static_cast<std::ptrdiff_t>(old_points));
    for (std::vector<double>& values : point_value_)
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(old_points));
    dropped_ += old_points;
  }
  std::size_t old_nodes = 0;
  while (old_nodes + 3 < nodes_.size() && nodes_[old_nodes + 1].t <= from - keep_)
    ++old_nodes;
  if (old_nodes > few || 2 * old_nodes > nodes_.size())
    nodes_.erase(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(old_nodes));
}

/// The last node at or before t; the first where there is none.
std::size_t History::node_before(double t) const {
  std::size_t k = nodes_.size() - 1;
  while (k > 0 && nodes_[k].t > t)
    --k;
  return k;
}

/// Adds `weight` times the four weights of the spline at x (in steps of the grid) to a column.
void History::scatter(double x, double weight, double* column) const {
  const double cell = std::floor(x);
  const std::array<double, 4> b = bspline_weights(x - cell);
  double* c = column + static_cast<std::ptrdiff_t>(cell);
  for (std::size_t k = 0; k < 4; ++k)
    c[k] += weight * b[k];
}

/// Scatters the completed steps up to `node`; returns how many rows of the grid they reach.
Eigen::Index History::gather_steps(double t, std::size_t node) const {
  const Convolution& c = s_.hydro.convolution;
  const double cells = static_cast<double>(c.splines.rows() - 3); // the kernel ends there
  const double oldest = t - cells * c.step;
  const auto begin = point_time_.begin(),
             end = begin +
                   static_cast<std::ptrdiff_t>(std::max(nodes_[node].points, dropped_) - dropped_);
  const auto first = std::upper_bound(begin, end, oldest);
  const double per_step = 1.0 / c.step;
  const double span = first == end ? 0.0 : (t - *first) * per_step;
  const Eigen::Index rows =
      std::min<Eigen::Index>(static_cast<Eigen::Index>(span) + 4, c.splines.rows());
  grid_.topRows(rows).setZero();
  const auto from = static_cast<std::size_t>(first - begin),
             to = static_cast<std::size_t>(end - begin);
  const auto last_cell = static_cast<std::ptrdiff_t>(cells) - 1; // against rounding
  for (std::size_t p = from; p < to; ++p) {
    const double x = (t - point_time_[p]) * per_step; // > 0
    const std::ptrdiff_t cell = std::min(static_cast<std::ptrdiff_t>(x), last_cell);
    const std::array<double, 4> b = bspline_weights(x - static_cast<double>(cell));
    double* column = grid_.data() + cell;
    for (int u = 0; u < n_U_; ++u, column += grid_.rows()) {
      const double value = point_value_[static_cast<std::size_t>(u)][p];
      for (std::size_t k = 0; k < 4; ++k)
        column[k] += value * b[k];
    }
  }
  return rows;
}

/// Scatters the piece from the node to t: what is known of it into the grid, whose first `rows` are
/// in use, and the factors of U(t), U'(t) apart. Returns how many rows the piece reaches.
Eigen::Index History::gather_piece(double t, std::size_t node, Eigen::Index rows) const {
  const Convolution& c = s_.hydro.convolution;
  const Node& from = nodes_[node];
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

/// From the grid to loads, pair by pair.
void History::sum_pairs(bool locked, Eigen::Index rows, Eigen::Index piece_rows, Past& out) const {
  const Convolution& c = s_.hydro.convolution;
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

/// s and s' at t - tau; before the start s(0), at rest.
std::array<double, 2> History::delayed(int delay, double t) const {
  const double then = t - s_.delays[static_cast<std::size_t>(delay)].time;
  const Eigen::Index k = n_U_ + 2 * delay;
  if (then < start_)
    return {first_[k], 0.0};
  if (nodes_.size() == 1)
    return {nodes_[0].value[k], nodes_[0].value[k + 1]};
  // The last node at or before `then` that has one after it.
  auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, then,
                                [](double time, const Node& node) { return time < node.t; });
  while (above != nodes_.end() - 1 && above->t == (above - 1)->t)
    ++above;
  const Node &a = *(above - 1), &b = *above;
  const double h = b.t - a.t;
  if (h <= 0.0)
    return {b.value[k], b.value[k + 1]};
  const std::array<double, 4> f = hermite((then - a.t) / h, h);
  std::array<double, 2> out{};
  for (Eigen::Index m = 0; m < 2; ++m)
    out[static_cast<std::size_t>(m)] =
        f[0] * a.value[k + m] + f[1] * a.rate[k + m] + f[2] * b.value[k + m] + f[3] * b.rate[k + m];
  return out;
}

void History::evaluate(double t, bool locked, Past& out) const {
  out.t = t;
  out.known = true;
  out.locked = locked;
  for (std::size_t d = 0; d < s_.delays.size(); ++d)
    out.delayed[d] = delayed(static_cast<int>(d), t);
  if (n_U_ == 0)
    return;
  if (nodes_.size() > 1) // patterns and poses are looked at whatever the time
    t = std::max(t, nodes_[nodes_.size() - 2].t);
  const std::size_t node = node_before(t);
  const Eigen::Index rows = gather_steps(t, node), piece = gather_piece(t, node, rows);
  sum_pairs(locked, std::max(rows, piece), piece, out);
}

const Past& History::at(double t, bool locked) const {
  locked = locked && !s_.hydro.convolution.locked.empty();
  for (const Past& past : memo_)
    if (past.known && past.t == t && (past.locked || !locked))
      return past;
  Past& out = memo_[next_];
  next_ = (next_ + 1) % memo_.size();
  evaluate(t, locked, out);
  return out;
}

} // namespace hydrodae::system
