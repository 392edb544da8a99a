#include "hydrodae/math/definite.h"

#include <algorithm>

#include "hydrodae/math/dense_cholesky.h"

namespace hydrodae {

namespace {

using Neighbours = std::vector<std::vector<Index>>;

/// Appends to `order` the unknowns that `start` reaches, by distance, and sets their `level`,
/// which `start` has already.
/// @returns the first place of the last level in `order`
std::size_t walk(const Neighbours& next, Index start, std::vector<Index>& level,
                 std::vector<Index>& order) {
  std::size_t last = order.size();
  order.push_back(start);
  for (std::size_t at = last; at < order.size(); ++at) {
    const Index u = order[at], own = level[static_cast<std::size_t>(u)];
    if (own > level[static_cast<std::size_t>(order[last])])
      last = at;
    for (const Index v : next[static_cast<std::size_t>(u)])
      if (Index& other = level[static_cast<std::size_t>(v)]; other < 0) {
        other = own + 1;
        order.push_back(v);
      }
  }
  return last;
}

/// An unknown far from most others that `start` reaches (George and Liu, ACM TOMS 5 (1979) 284).
Index far_end(const Neighbours& next, Index start, std::vector<Index>& level) {
  Index depth = -1;
  for (;;) {
    std::vector<Index> order;
    level[static_cast<std::size_t>(start)] = 0;
    const std::size_t last = walk(next, start, level, order);
    const Index reached = level[static_cast<std::size_t>(order[last])];
    for (const Index u : order)
      level[static_cast<std::size_t>(u)] = -1;
    if (reached <= depth)
      return start;
    depth = reached;
    start = *std::min_element(order.begin() + static_cast<std::ptrdiff_t>(last), order.end(),
                              [&](Index a, Index b) {
                                return next[static_cast<std::size_t>(a)].size() <
                                       next[static_cast<std::size_t>(b)].size();
                              });
  }
}

} // namespace

Definite::Definite(Index n, std::vector<Place> places)
    : places_(std::move(places)), local_(static_cast<std::size_t>(n)),
      level_(static_cast<std::size_t>(n)) {
  Neighbours next(static_cast<std::size_t>(n));
  for (const Place& p : places_)
    if (p.row != p.column) {
      next[static_cast<std::size_t>(p.row)].push_back(p.column);
      next[static_cast<std::size_t>(p.column)].push_back(p.row);
    }
  std::vector<Index> level(static_cast<std::size_t>(n), -1);
  for (Index u = 0; u < n; ++u) {
    if (level[static_cast<std::size_t>(u)] >= 0)
      continue;
    std::vector<Index> order;
    const Index start = far_end(next, u, level);
    level[static_cast<std::size_t>(start)] = std::ssize(levels_);
    walk(next, start, level, order);
    for (const Index v : order) {
      const auto i = static_cast<std::size_t>(v);
      level_[i] = static_cast<std::size_t>(level[i]);
      levels_.resize(level_[i] + 1);
      local_[i] = levels_[level_[i]].n++;
    }
  }
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const std::size_t a = level_[static_cast<std::size_t>(places_[k].row)],
                      b = level_[static_cast<std::size_t>(places_[k].column)];
    (a == b ? levels_[a].own : levels_[std::max(a, b)].before).push_back(k);
  }
}

Index Definite::Values::padded(Index n) const { return dense::padded(imaginary ? 2 * n : n); }

Definite::RowMajor Definite::own_block(const Level& level, const Values& values,
                                       double shift) const {
  const Index n = level.n, size = values.padded(n);
  RowMajor S = RowMajor::Zero(size, size); // the upper triangle is read
  for (const std::size_t k : level.own) {
    Index u = local_[static_cast<std::size_t>(places_[k].column)],
          v = local_[static_cast<std::size_t>(places_[k].row)];
    // imaginary part of (u, v), with its sign
    double turned = values.imaginary ? -values.imaginary[k] : 0.0;
    if (u > v) {
      std::swap(u, v);
      turned = -turned;
    }
    S(u, v) = values.real[k];
    if (!values.imaginary)
      continue;
    S(n + u, n + v) = values.real[k];
    if (u != v) { // -I above the diagonal, and I = -I^T
      S(u, n + v) = -turned;
      S(v, n + u) = turned;
    }
  }
  const Index own = values.imaginary ? 2 * n : n;
  S.diagonal().head(own).array() += shift;
  S.diagonal().tail(size - own).setOnes();
  return S;
}

/// Rows of the level before, columns of this level.
Definite::RowMajor Definite::block_before(const Level& level, Index n_before,
                                          const Values& values) const {
  const Index n = level.n;
  RowMajor A = RowMajor::Zero(values.padded(n_before), values.padded(n));
  for (const std::size_t k : level.before) {
    const auto row = static_cast<std::size_t>(places_[k].row),
               column = static_cast<std::size_t>(places_[k].column);
    const bool as_it_is = level_[row] < level_[column]; // else the transpose
    const Index u = local_[as_it_is ? row : column], v = local_[as_it_is ? column : row];
    A(u, v) = values.real[k];
    if (!values.imaginary)
      continue;
    const double part = as_it_is ? values.imaginary[k] : -values.imaginary[k];
    A(n_before + u, n + v) = values.real[k];
    A(u, n + v) = -part;
    A(n_before + u, v) = part;
  }
  return A;
}

bool Definite::test(const double* real, const double* imaginary, double shift) const {
  const Values values{real, imaginary};
  const dense::Kernels& kernels = dense::kernels();
  RowMajor U; // of the level before
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const Level& level = levels_[k];
    RowMajor S = own_block(level, values, shift);
    if (!level.before.empty()) {
      RowMajor W = block_before(level, levels_[k - 1].n, values);
      kernels.solve_left(U.rows(), U.data(), W.cols(), W.data());
      S = -S;
      kernels.add_gram(W.rows(), W.cols(), W.data(), S.data());
      S = -S;
    }
    if (!kernels.factorise(S.rows(), S.data(), 0.0))
      return false;
    U = std::move(S);
  }
  return true;
}

} // namespace hydrodae
