#include "hydrodae/build/closing.h"
#include "hydrodae/system/retract.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::build {

namespace {

constexpr double closed = 1e-12;     ///< gaps, in units of their scale, that count as none
constexpr double row_damping = 1e-4; ///< of singular values of rows of length one, squared
constexpr double longest_way = 3.0;  ///< scales, 0.3 levers: a step that keeps to the branch
constexpr double parallel = 0.03; ///< part of a gap that motions close, where it cannot be closed
constexpr double nearby = 0.3;    ///< way, in scales, that closes a gap without leaving the pose

} // namespace

double close_positions(const system::System& s, Constraints& constraints, VectorX& y,
                       double* moved) {
  VectorX gaps, rates;
  double size = 0.0, before = INFINITY, way = 0.0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    constraints.evaluate(y, gaps, rates);
    size = gaps.size() > 0 ? gaps.cwiseAbs().maxCoeff() : 0.0;
    if (!std::isfinite(size) || size < closed || (size < 1e-9 && size > 0.5 * before))
      break;
    before = size;
    VectorX step = smallest_solution(
        constraints.gradient([&](Index i) { return constraints.holds_position(i); }), -gaps);
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest > longest_way)
      step *= longest_way / largest;
    way += std::min(largest, longest_way);
    if (moved && way > *moved)
      break;
    retract(s, step.cwiseProduct(constraints.scale()), y);
  }
  if (moved)
    *moved = way;
  return size;
}

void approach(const system::System& s, Constraints& constraints, VectorX& y, double* moved) {
  VectorX gaps, rates;
  double gone = 0.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    constraints.evaluate(y, gaps, rates);
    const double size = gaps.size() > 0 ? gaps.cwiseAbs().maxCoeff() : 0.0;
    if (!std::isfinite(size) || size < closed)
      break;
    VectorX step = damped_solution(
        constraints.gradient([&](Index i) { return constraints.holds_position(i); }), -gaps,
        row_damping);
    const double largest = step.cwiseAbs().maxCoeff();
    if (!(largest > 1e-6 * size))
      break; // nothing moves any more
    if (largest > longest_way)
      step *= longest_way / largest;
    gone += std::min(largest, longest_way);
    retract(s, step.cwiseProduct(constraints.scale()), y);
  }
  if (moved)
    *moved = gone;
  VectorX refined = y;
  double way = nearby;
  if (close_positions(s, constraints, refined, &way) < nearly_closed)
    y = refined;
}

bool is_closed(Constraints& constraints, const VectorX& y) {
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  const double size = gaps.size() > 0 ? gaps.cwiseAbs().maxCoeff() : 0.0;
  if (size < nearly_closed)
    return true;
  const SparseMatrix G =
      constraints.gradient([&](Index i) { return constraints.holds_position(i); });
  VectorX length = VectorX::Zero(G.rows()); // rows of length one, as in `approach`
  for (Index c = 0; c < G.cols(); ++c)
    for (SparseMatrix::InnerIterator it(G, c); it; ++it)
      length[it.row()] += it.value() * it.value();
  length = length.cwiseMax(1e-300);
  const double pull = (G.transpose() * gaps.cwiseQuotient(length)).norm();
  return size < 0.3 && pull < parallel * gaps.cwiseQuotient(length.cwiseSqrt()).norm();
}

bool find_pose(const system::System& s, Constraints& constraints, VectorX& y) {
  VectorX direct = y;
  double damped_way = 0.0, way = INFINITY;
  approach(s, constraints, y, &damped_way);
  // Without damping a little misalignment would drive the bodies back to where it vanishes.
  const bool reached = close_positions(s, constraints, direct, &way) < nearly_closed;
  if (reached && way <= 1.5 * damped_way + nearby) {
    y = direct;
    return true;
  }
  if (is_closed(constraints, y))
    return true;
  if (reached)
    y = direct;
  return reached;
}

} // namespace hydrodae::build
