#include "hydrodae/build/closing.h"
#include "hydrodae/system/retract.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::build {

namespace {

constexpr double closed = 1e-12; ///< gap that counts as zero, in units of its scale
/// Damping relative to squared singular values of rows of length one
constexpr double row_damping = 1e-4;
/// Longest step that keeps to the branch: in scales, 0.3 levers
constexpr double longest_way = 3.0;
/// Part of a gap that motions close, below which it cannot be closed
constexpr double parallel = 0.03;
/// Displacement that closes a gap without leaving the pose, in scales
constexpr double nearby = 0.3;

/// Marks the finished mechanisms, and sets their gaps to zero.
/// @returns whether any mechanism continues
bool drop_gaps(const Constraints& constraints, const std::vector<bool>& going, VectorX& gaps) {
  for (Index i = 0; i < gaps.size(); ++i)
    if (!going[static_cast<std::size_t>(constraints.mechanism(i))])
      gaps[i] = 0.0;
  return std::find(going.begin(), going.end(), true) != going.end();
}

SparseMatrix gradient_of(const Constraints& constraints, const std::vector<bool>& going) {
  return constraints.gradient([&](Index i) {
    return constraints.holds_position(i) &&
           going[static_cast<std::size_t>(constraints.mechanism(i))];
  });
}

/// Makes a step, at most `longest_way` in each mechanism; finished mechanisms stay.
void go(const system::System& s, const Constraints& constraints, const std::vector<bool>& going,
        const VectorX& largest, VectorX step, VectorX& y) {
  for (Index k = 0; k < step.size(); ++k) {
    const Index m = constraints.owner(k);
    if (!going[static_cast<std::size_t>(m)])
      step[k] = 0.0;
    else if (largest[m] > longest_way)
      step[k] *= longest_way / largest[m];
  }
  retract(s, step.cwiseProduct(constraints.scale()), y);
}

} // namespace

VectorX close_positions(const system::System& s, Constraints& constraints, VectorX& y,
                        VectorX* moved) {
  const Index n = constraints.n_mechanisms();
  VectorX gaps, rates, size = VectorX::Zero(n), before = VectorX::Constant(n, INFINITY),
                       way = VectorX::Zero(n);
  std::vector<bool> going(static_cast<std::size_t>(n), true);
  for (int iteration = 0; iteration < 200; ++iteration) {
    constraints.evaluate(y, gaps, rates);
    size = constraints.largest_row(gaps);
    for (Index m = 0; m < n; ++m)
      if (!std::isfinite(size[m]) || size[m] < closed ||
          (size[m] < 1e-9 && size[m] > 0.5 * before[m]))
        going[static_cast<std::size_t>(m)] = false;
    if (!drop_gaps(constraints, going, gaps))
      break;
    before = size;
    const VectorX step = smallest_solution(gradient_of(constraints, going), -gaps);
    const VectorX largest = constraints.largest_motion(step);
    way += largest.cwiseMin(longest_way);
    for (Index m = 0; moved && m < n; ++m)
      if (way[m] > (*moved)[m])
        going[static_cast<std::size_t>(m)] = false;
    go(s, constraints, going, largest, step, y);
  }
  if (moved)
    *moved = way;
  return size;
}

VectorX approach(const system::System& s, Constraints& constraints, VectorX& y) {
  const Index n = constraints.n_mechanisms();
  VectorX gaps, rates, gone = VectorX::Zero(n);
  std::vector<bool> going(static_cast<std::size_t>(n), true);
  for (int iteration = 0; iteration < 60; ++iteration) {
    constraints.evaluate(y, gaps, rates);
    const VectorX size = constraints.largest_row(gaps);
    for (Index m = 0; m < n; ++m)
      if (!std::isfinite(size[m]) || size[m] < closed)
        going[static_cast<std::size_t>(m)] = false;
    if (!drop_gaps(constraints, going, gaps))
      break;
    const VectorX step = damped_solution(gradient_of(constraints, going), -gaps, row_damping);
    const VectorX largest = constraints.largest_motion(step);
    for (Index m = 0; m < n; ++m)
      if (!(largest[m] > 1e-6 * size[m]))
        going[static_cast<std::size_t>(m)] = false; // no motion left
      else
        gone[m] += std::min(largest[m], longest_way);
    go(s, constraints, going, largest, step, y);
  }
  VectorX refined = y, way = VectorX::Constant(n, nearby);
  const VectorX left = close_positions(s, constraints, refined, &way);
  for (Index m = 0; m < n; ++m)
    if (left[m] < nearly_closed)
      constraints.copy_mechanism(m, refined, y);
  return gone;
}

std::vector<bool> closed_mechanisms(Constraints& constraints, const VectorX& y) {
  const Index n = constraints.n_mechanisms();
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  const VectorX size = constraints.largest_row(gaps);
  const SparseMatrix G =
      constraints.gradient([&](Index i) { return constraints.holds_position(i); });
  VectorX length = VectorX::Zero(G.rows()); // scaled to rows of length one, as in `approach`
  for (Index c = 0; c < G.cols(); ++c)
    for (SparseMatrix::InnerIterator it(G, c); it; ++it)
      length[it.row()] += it.value() * it.value();
  length = length.cwiseMax(1e-300);
  const VectorX pull = G.transpose() * gaps.cwiseQuotient(length);
  VectorX pulls = VectorX::Zero(n), opens = VectorX::Zero(n); // squares
  for (Index k = 0; k < pull.size(); ++k)
    pulls[constraints.owner(k)] += pull[k] * pull[k];
  for (Index i = 0; i < gaps.size(); ++i)
    opens[constraints.mechanism(i)] += gaps[i] * gaps[i] / length[i];
  std::vector<bool> out;
  for (Index m = 0; m < n; ++m)
    out.push_back(size[m] < nearly_closed ||
                  (size[m] < 0.3 && std::sqrt(pulls[m]) < parallel * std::sqrt(opens[m])));
  return out;
}

bool find_pose(const system::System& s, Constraints& constraints, VectorX& y) {
  VectorX direct = y, way = VectorX::Constant(constraints.n_mechanisms(), INFINITY);
  const VectorX damped_way = approach(s, constraints, y);
  // Without damping, bodies would return to where a small misalignment vanishes.
  const VectorX left = close_positions(s, constraints, direct, &way);
  const std::vector<bool> closes = closed_mechanisms(constraints, y);
  bool found = true;
  for (Index m = 0; m < left.size(); ++m) {
    const bool reached = left[m] < nearly_closed;
    if (reached && (way[m] <= 1.5 * damped_way[m] + nearby || !closes[static_cast<std::size_t>(m)]))
      constraints.copy_mechanism(m, direct, y);
    found = found && (reached || closes[static_cast<std::size_t>(m)]);
  }
  return found;
}

} // namespace hydrodae::build
