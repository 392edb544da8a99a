#include "hydrodae/element/elements.h"

#include <algorithm>

#include "hydrodae/math/dense.h"

namespace hydrodae::element {

std::string unit_along(std::string_view unit, bool angle) {
  const std::size_t either = unit.find(" or ");
  if (either == std::string_view::npos)
    return std::string(unit);
  return std::string(angle ? unit.substr(either + 4) : unit.substr(0, either));
}

void Elements::report(double, const double*, const double* out, double* loads) const {
  for (std::size_t k = 0; k < size(); ++k)
    std::copy_n(out + k * static_cast<std::size_t>(shape.n_out()), 6, loads + 6 * k);
}

std::vector<AtRest> at_rest(const Elements& list, const VectorX& x) {
  if (const auto still = list.statics())
    return at_rest(*still, x);
  const auto n = list.size(), states = static_cast<std::size_t>(list.shape.n_states);
  const Index in_size = list.shape.n_in(), out_size = list.shape.n_out(), w = list.shape.width;
  if (list.shape.in_water())
    return std::vector<AtRest>(n, {VectorX::Zero(w), MatrixX::Zero(w, w), MatrixX::Zero(w, w)});
  VectorX in = VectorX::Zero(in_size * static_cast<Index>(n)),
          out = VectorX::Zero(out_size * static_cast<Index>(n));
  for (std::size_t k = 0; k < n; ++k) {
    const auto law = static_cast<Index>(k);
    for (std::size_t z = 0; z < states; ++z)
      in[(law + 1) * in_size - static_cast<Index>(states - z)] =
          list.unknowns[k * states + z].start;
    if (x.size() > 0)
      in.segment(law * in_size, w) = x.segment(law * w, w);
  }
  std::vector<double> all(n * static_cast<std::size_t>(in_size * out_size), 0.0);
  list.evaluate(0.0, in.data(), list.signals.data(), out.data());
  list.jacobian(0.0, in.data(), list.signals.data(), all.data());
  std::vector<AtRest> rests;
  for (Index k = 0; k < static_cast<Index>(n); ++k) {
    const Eigen::Map<const MatrixX> J(all.data() + k * in_size * out_size, out_size, in_size);
    AtRest& rest = rests.emplace_back(
        AtRest{out.segment(k * out_size, w), -J.topLeftCorner(w, w), -J.block(0, w, w, w)});
    if (const Index a = list.shape.n_algebraic; a > 0) { // algebraic unknowns follow x and v
      const MatrixX by_z = J.bottomRightCorner(a, a), f_z = J.topRightCorner(w, a);
      const MatrixX follow = solve_square(by_z, J.bottomLeftCorner(a, 2 * w));
      rest.stiffness += f_z * follow.leftCols(w);
      rest.damping += f_z * follow.rightCols(w);
    }
  }
  return rests;
}

} // namespace hydrodae::element
