#include "hydrodae/build/row_ranks.h"

#include <algorithm>
#include <cmath>

namespace hydrodae::build {

namespace {

/// Scales rows and bodies so that neither size nor mass of a body matters. Rotations count by the
/// arm of the body; the largest entry of each row, and of the columns of each body together, is
/// about one. (A factor for each column would hide motions that a body can hardly make.)
SparseMatrix balanced(const system::System& s, SparseMatrix G) {
  for (const system::BodyData& b : s.bodies)
    for (int k = 0; k < b.n_active; ++k)
      if (b.active[k] >= 3)
        G.col(b.u0 - s.u0 + k) *= b.lever / b.arm;
  std::vector<std::size_t> owner(static_cast<std::size_t>(s.n_u));
  for (std::size_t b = 0; b < s.bodies.size(); ++b)
    for (int k = 0; k < s.bodies[b].n_active; ++k)
      owner[static_cast<std::size_t>(s.bodies[b].u0 - s.u0 + k)] = b;
  const auto each = [&](auto&& visit) {
    for (Index c = 0; c < G.cols(); ++c)
      for (SparseMatrix::InnerIterator it(G, c); it; ++it)
        visit(it.row(), owner[static_cast<std::size_t>(c)], it.valueRef());
  };
  for (int pass = 0; pass < 3; ++pass) {
    VectorX body = VectorX::Zero(static_cast<Index>(s.bodies.size())),
            row = VectorX::Zero(G.rows());
    each([&](Index, std::size_t b, double& value) {
      double& size = body[static_cast<Index>(b)];
      size = std::max(size, std::abs(value));
    });
    each([&](Index, std::size_t b, double& value) {
      if (body[static_cast<Index>(b)] > 0.0)
        value /= body[static_cast<Index>(b)];
    });
    each([&](Index i, std::size_t, double& value) { row[i] = std::max(row[i], std::abs(value)); });
    each([&](Index i, std::size_t, double& value) {
      if (row[i] > 0.0)
        value /= row[i];
    });
  }
  return G;
}

} // namespace

std::size_t Ranking::rank(double limit) const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [&](const RankedRow& row) { return row.pivot > limit; }));
}

std::vector<Ranking> rank_at(const system::System& s, Constraints& constraints, const Mask& mask,
                             const VectorX& y) {
  VectorX gaps, rates;
  constraints.evaluate(y, gaps, rates);
  const auto n = static_cast<Index>(mask.size());
  const auto wanted = [&](Index i) { return i < n && mask[static_cast<std::size_t>(i)]; };
  std::vector<Ranking> out(static_cast<std::size_t>(constraints.n_mechanisms()));
  const auto add = [&](const RankedRow& row) {
    out[static_cast<std::size_t>(constraints.mechanism(row.row))].rows.push_back(row);
  };
  std::vector<RankedRow> rows =
      ranked_rows(balanced(s, constraints.gradient(wanted)), constraints.tree());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const RankedRow& a, const RankedRow& b) { return a.pivot > b.pivot; });
  Mask missing = mask;
  for (const RankedRow& row : rows) {
    missing[static_cast<std::size_t>(row.row)] = false;
    add(row);
  }
  for (Index i = 0; i < n; ++i)
    if (missing[static_cast<std::size_t>(i)])
      add({i, 0.0});
  return out;
}

VectorX least_pivots(const system::Regime& s, const VectorX& y, const std::vector<int>& part,
                     int parts) {
  Constraints constraints(s);
  const Mask all(static_cast<std::size_t>(s.n_lambda), true);
  VectorX out = VectorX::Ones(parts);
  for (const Ranking& mechanism : rank_at(s, constraints, all, y))
    for (const RankedRow& row : mechanism.rows) {
      double& least = out[part[static_cast<std::size_t>(row.row)]];
      least = std::min(least, row.pivot);
    }
  return out;
}

} // namespace hydrodae::build
