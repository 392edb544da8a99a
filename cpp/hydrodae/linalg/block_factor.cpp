#include "hydrodae/linalg/block_factor.h"

#include <algorithm>

#include "hydrodae/math/sets.h"

namespace hydrodae::linalg {

namespace {

constexpr double least_pivot = 1e-15; ///< a pivot below this part of its diagonal entry is rounding
/// Smallest pivot of S without eD, as part of its entry. Above it ten of sixteen digits are exact,
/// and one refinement restores the rest. Below it rows may be redundant, and eD must separate them.
constexpr double regular = 1e-6;

} // namespace

BlockFactor::BlockFactor(const std::vector<Index>& column_start, const std::vector<Index>& row,
                         Index n_u, const std::vector<Index>& together,
                         const dense::Kernels& kernels)
    : kernels_(kernels), n_u_(n_u), n_(std::ssize(column_start) - 1),
      set_of_(static_cast<std::size_t>(n_)), local_(static_cast<std::size_t>(n_)) {
  Sets sets(n_u);
  std::vector<Index> first(static_cast<std::size_t>(n_u), -1); // unknown of each number
  for (Index c = 0; c < n_u; ++c) {
    Index& before = first[static_cast<std::size_t>(together[static_cast<std::size_t>(c)])];
    if (before >= 0)
      sets.join(before, c);
    before = c;
    for (Index k = column_start[static_cast<std::size_t>(c)];
         k < column_start[static_cast<std::size_t>(c) + 1]; ++k)
      if (const Index r = row[static_cast<std::size_t>(k)]; r < n_u)
        sets.join(r, c);
  }
  for (Index c = 0; c < n_u; ++c) {
    const auto i = static_cast<std::size_t>(c), root = static_cast<std::size_t>(sets.root(c));
    if (root == i) {
      set_of_[i] = bodies_.size();
      bodies_.emplace_back();
    }
    set_of_[i] = set_of_[root];
    Bodies& b = bodies_[set_of_[i]];
    local_[i] = std::ssize(b.unknown);
    b.unknown.push_back(c);
  }
  find_rows(column_start, row);
}

/// Rows that act on a common set of bodies form one set.
void BlockFactor::find_rows(const std::vector<Index>& column_start, const std::vector<Index>& row) {
  const auto n_sets = std::ssize(bodies_);
  Sets sets(n_sets + n_ - n_u_); // sets of bodies, then of rows
  std::vector<std::vector<Index>> touched(bodies_.size());
  for (Index c = 0; c < n_u_; ++c) {
    const std::size_t b = set_of_[static_cast<std::size_t>(c)];
    for (Index k = column_start[static_cast<std::size_t>(c)];
         k < column_start[static_cast<std::size_t>(c) + 1]; ++k)
      if (const Index r = row[static_cast<std::size_t>(k)]; r >= n_u_) {
        sets.join(static_cast<Index>(b), n_sets + r - n_u_);
        touched[b].push_back(r);
      }
  }
  std::vector<std::size_t> number(static_cast<std::size_t>(n_sets + n_ - n_u_), SIZE_MAX);
  for (Index r = n_u_; r < n_; ++r) {
    std::size_t& of = number[static_cast<std::size_t>(sets.root(n_sets + r - n_u_))];
    if (of == SIZE_MAX) {
      of = rows_.size();
      rows_.emplace_back();
    }
    set_of_[static_cast<std::size_t>(r)] = of;
    local_[static_cast<std::size_t>(r)] = std::ssize(rows_[of].unknown);
    rows_[of].unknown.push_back(r);
  }
  for (Rows& r : rows_)
    r.m = dense::padded(std::ssize(r.unknown));
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    Bodies& b = bodies_[k];
    std::vector<Index>& all = touched[k];
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const Index r : all) {
      b.rows = set_of_[static_cast<std::size_t>(r)];
      b.local.push_back(local_[static_cast<std::size_t>(r)]);
    }
    b.n = dense::padded(std::ssize(b.unknown));
    b.m = dense::padded(std::ssize(b.local));
    b.whole = !all.empty() && b.local.size() == rows_[b.rows].unknown.size();
  }
  find_places(column_start, row);
}

void BlockFactor::find_places(const std::vector<Index>& column_start,
                              const std::vector<Index>& row) {
  for (Index c = 0; c < n_u_; ++c) {
    Bodies& b = bodies_[set_of_[static_cast<std::size_t>(c)]];
    const Index own = local_[static_cast<std::size_t>(c)];
    for (auto k = static_cast<std::size_t>(column_start[static_cast<std::size_t>(c)]);
         k < static_cast<std::size_t>(column_start[static_cast<std::size_t>(c) + 1]); ++k) {
      const Index of_row = local_[static_cast<std::size_t>(row[k])];
      if (row[k] >= n_u_) {
        const auto at = std::lower_bound(b.local.begin(), b.local.end(), of_row);
        b.gradient.push_back({k, own * b.m + (at - b.local.begin())});
      } else if (of_row >= own) { // lower triangle by columns: the upper one by rows
        const Index offset = own * b.n + of_row;
        if (Run* last = b.mass.empty() ? nullptr : &b.mass.back();
            last && last->value + static_cast<std::size_t>(last->count) == k &&
            last->offset + last->count == offset)
          ++last->count;
        else
          b.mass.push_back({k, offset, 1});
        ++b.n_mass;
      }
    }
  }
}

double BlockFactor::work() const {
  double sum = 0.0;
  for (const Bodies& b : bodies_) {
    const auto n = static_cast<double>(b.n), m = static_cast<double>(b.m);
    sum += n * n * n / 6.0 + n * n * m / 2.0 + n * m * m / 2.0;
  }
  for (const Rows& r : rows_)
    sum += static_cast<double>(r.m) * static_cast<double>(r.m) * static_cast<double>(r.m) / 6.0;
  return sum;
}

double BlockFactor::least_work() const {
  double sum = 0.0;
  for (const Bodies& b : bodies_)
    if (const Index n = std::ssize(b.unknown); b.n_mass == n * (n + 1) / 2)
      sum += static_cast<double>(n * n * n) / 3.0; // unsymmetric block: by LU
  return sum;
}

void BlockFactor::allocate() {
  for (Bodies& b : bodies_) {
    b.u.resize(b.n, b.n);
    b.w.resize(b.n, b.m);
    if (!b.whole) {
      b.gram.resize(b.m, b.m);
      b.sum.setZero(b.m);
    }
    b.x.setZero(b.n);
  }
  for (Rows& r : rows_) {
    r.s.resize(r.m, r.m);
    r.x.setZero(r.m);
  }
  allocated_ = true;
}

bool BlockFactor::factorise(const std::vector<double>& values, const VectorX& damping) {
  if (!allocated_)
    allocate();
  for (Bodies& b : bodies_) {
    b.u.setZero();
    b.u.diagonal().tail(b.n - std::ssize(b.unknown)).setOnes();
    for (const Run& run : b.mass)
      std::copy_n(values.data() + run.value, run.count, b.u.data() + run.offset);
    if (!kernels_.factorise(b.n, b.u.data(), least_pivot))
      return false;
    if (b.local.empty())
      continue;
    b.w.setZero();
    for (const Place& p : b.gradient)
      b.w.data()[p.offset] = values[p.value];
    kernels_.solve_left(b.n, b.u.data(), b.m, b.w.data());
  }
  return factorise_rows(nullptr) || factorise_rows(&damping);
}

/// Factorises S, with eD if it is given.
bool BlockFactor::factorise_rows(const VectorX* damping) {
  for (Rows& r : rows_) {
    r.s.setZero();
    r.s.diagonal().tail(r.m - std::ssize(r.unknown)).setOnes();
    for (std::size_t i = 0; damping && i < r.unknown.size(); ++i)
      r.s(static_cast<Index>(i), static_cast<Index>(i)) = (*damping)[r.unknown[i] - n_u_];
  }
  for (Bodies& b : bodies_) {
    if (b.local.empty())
      continue;
    RowMajor& s = rows_[b.rows].s;
    if (b.whole) {
      kernels_.add_gram(b.n, b.m, b.w.data(), s.data());
      continue;
    }
    b.gram.setZero();
    kernels_.add_gram(b.n, b.m, b.w.data(), b.gram.data());
    for (std::size_t i = 0; i < b.local.size(); ++i)
      for (std::size_t k = i; k < b.local.size(); ++k)
        s(b.local[i], b.local[k]) += b.gram(static_cast<Index>(i), static_cast<Index>(k));
  }
  for (Rows& r : rows_)
    if (!kernels_.factorise(r.m, r.s.data(), damping ? least_pivot : regular))
      return false;
  return true;
}

/// Solves M a + G^T x = f, G a - eD x = g: with h = U^-T f, S x = W^T h - g, a = U^-1 (h - W x).
void BlockFactor::solve(double* v) {
  for (Rows& r : rows_)
    for (std::size_t i = 0; i < r.unknown.size(); ++i)
      r.x[static_cast<Index>(i)] = -v[r.unknown[i]];
  for (Bodies& b : bodies_) {
    for (std::size_t i = 0; i < b.unknown.size(); ++i)
      b.x[static_cast<Index>(i)] = v[b.unknown[i]];
    kernels_.solve_forward(b.n, b.u.data(), b.x.data());
    if (b.local.empty())
      continue;
    VectorX& x = rows_[b.rows].x;
    VectorX& sum = b.whole ? x : b.sum;
    if (!b.whole)
      sum.setZero();
    kernels_.add_transposed(b.n, b.m, b.w.data(), b.x.data(), sum.data());
    for (std::size_t k = 0; !b.whole && k < b.local.size(); ++k)
      x[b.local[k]] += sum[static_cast<Index>(k)];
  }
  for (Rows& r : rows_) {
    kernels_.solve_forward(r.m, r.s.data(), r.x.data());
    kernels_.solve_backward(r.m, r.s.data(), r.x.data());
    for (std::size_t i = 0; i < r.unknown.size(); ++i)
      v[r.unknown[i]] = r.x[static_cast<Index>(i)];
  }
  for (Bodies& b : bodies_) {
    if (!b.local.empty()) {
      const VectorX& x = rows_[b.rows].x;
      for (std::size_t k = 0; !b.whole && k < b.local.size(); ++k)
        b.sum[static_cast<Index>(k)] = x[b.local[k]];
      kernels_.subtract_product(b.n, b.m, b.w.data(), b.whole ? x.data() : b.sum.data(),
                                b.x.data());
    }
    kernels_.solve_backward(b.n, b.u.data(), b.x.data());
    for (std::size_t i = 0; i < b.unknown.size(); ++i)
      v[b.unknown[i]] = b.x[static_cast<Index>(i)];
  }
}

} // namespace hydrodae::linalg
