#include "hydrodae/system/algebraic.h"

#include "hydrodae/math/dense.h"
#include "hydrodae/system/elements.h"

namespace hydrodae::system {

namespace {

constexpr int most_steps = 50;
/// Largest last change at the solution, relative to the size of the unknown plus its scale
constexpr double solved = 1e-11;

/// Newton step for all laws of a list; returns the largest relative change.
double newton_step(const Regime& s, const ElementList& list, JacobianWorkspace& ws, double t,
                   VectorX& y) {
  const element::Elements& laws = *list.laws;
  const element::Shape& shape = laws.shape;
  const Index n = shape.n_algebraic, rates = shape.n_states - n;
  ElementScratch<double>& scratch = ws.state.elements[index_of(s, list)];
  gather<double>(s, list, ws.state, y.data(), scratch);
  const double* held = s.held(list, t, scratch.held);
  laws.evaluate(t, scratch.in.data(), held, scratch.out.data());
  laws.jacobian(t, scratch.in.data(), held, ws.element_jacobian.data());
  double largest = 0.0;
  for (std::size_t law = 0; law < laws.size(); ++law) {
    const auto k = static_cast<Index>(law);
    const Eigen::Map<const MatrixX> J(ws.element_jacobian.data() +
                                          k * shape.n_out() * shape.n_columns(),
                                      shape.n_out(), shape.n_columns());
    const Eigen::Map<const VectorX> out(scratch.out.data() + k * shape.n_out(), shape.n_out());
    const MatrixX by_z = J.bottomRightCorner(n, n);
    const VectorX change = solve_square(by_z, -out.tail(n));
    for (Index i = 0; i < n; ++i) {
      const Index z = k * shape.n_states + rates + i;
      double& value = y[list.z0 + z];
      value += change[i];
      const double size = std::abs(value) + laws.unknowns[static_cast<std::size_t>(z)].scale;
      largest = std::isfinite(change[i]) ? std::max(largest, std::abs(change[i]) / size) : INFINITY;
    }
  }
  return largest;
}

} // namespace

bool solve_algebraic(const Regime& s, JacobianWorkspace& ws, double t, VectorX& y) {
  bool known = false;
  for (const ElementList& list : s.elements) {
    if (list.laws->shape.n_algebraic == 0)
      continue;
    if (!known) { // laws with unknowns of their own read no accelerations
      unpack<double>(s, y.data(), y.data(), ws.state.bodies);
      ws.state.time = t;
      ws.state.past = past_at(s, t);
      known = true;
    }
    double change = INFINITY;
    for (int step = 0; step < most_steps && change > solved; ++step) {
      change = newton_step(s, list, ws, t, y);
      if (std::isinf(change))
        return false;
    }
    if (change > solved)
      return false;
  }
  return true;
}

} // namespace hydrodae::system
