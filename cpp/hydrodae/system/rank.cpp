#include "hydrodae/system/rank.h"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace hydrodae::system {

namespace {

using Iterator = SparseMatrix::InnerIterator;

constexpr double rank_tolerance = 1e-9; ///< of the largest pivot
constexpr double damping = 1e-12;       ///< of the normal equations, whose diagonal is one
constexpr double certain = 1e-8;        ///< pivot of those above which a row is independent

/// The rows and columns of one component. `place` has one entry per row of `matrix`: scratch.
SparseMatrix block(const SparseMatrix& matrix, const Component& part, std::vector<Index>& place) {
  for (std::size_t i = 0; i < part.rows.size(); ++i)
    place[part.rows[i]] = static_cast<Index>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < part.columns.size(); ++c)
    for (Iterator it(matrix, part.columns[c]); it; ++it)
      if (it.value() != 0.0)
        entries.emplace_back(place[it.row()], static_cast<Index>(c), it.value());
  SparseMatrix out(static_cast<Index>(part.rows.size()), static_cast<Index>(part.columns.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

bool is_small(const SparseMatrix& part, Index dense_limit) {
  return std::max(part.rows(), part.cols()) <= dense_limit;
}

std::vector<Index> dense_rows(const SparseMatrix& part) {
  Eigen::ColPivHouseholderQR<MatrixX> qr(MatrixX(part).transpose());
  qr.setThreshold(rank_tolerance);
  const auto& order = qr.colsPermutation().indices();
  return {order.data(), order.data() + qr.rank()};
}

/// Scales the rows to length one; returns their lengths.
VectorX normalise_rows(SparseMatrix& part) {
  VectorX size = VectorX::Zero(part.rows());
  for (Index c = 0; c < part.cols(); ++c)
    for (Iterator it(part, c); it; ++it)
      size[it.row()] += it.value() * it.value();
  size = size.cwiseSqrt();
  part = size.cwiseInverse().asDiagonal() * part;
  return size;
}

/// The damped normal equations G G^T + damping I, factorised as L D L^T.
class NormalEquations {
public:
  explicit NormalEquations(const SparseMatrix& G) : G_(G), transposed_(G.transpose()) {
    SparseMatrix normal = G * transposed_;
    for (Index i = 0; i < normal.rows(); ++i)
      normal.coeffRef(i, i) += damping;
    ldlt_.compute(normal);
  }

  // x = G^T l with (G G^T + damping I) dl = b - G x: each pass leaves damping / (s^2 + damping) of
  // the gap along a singular value s; what no x can reach grows in l but never enters G^T l.
  VectorX smallest_solution(const VectorX& b) const {
    VectorX x = VectorX::Zero(G_.cols());
    for (int pass = 0; pass < passes; ++pass)
      x += transposed_ * VectorX(ldlt_.solve(b - G_ * x));
    return x;
  }

  /// What the rows leave of v: v - G^T l with the smallest |v - G^T l|.
  VectorX remainder(VectorX v) const {
    for (int pass = 0; pass < passes; ++pass)
      v -= transposed_ * VectorX(ldlt_.solve(G_ * v));
    return v;
  }

  /// Squared distance of each row from the rows eliminated before it, by row; a row that follows
  /// from them has the damping times one plus the square of its coefficients.
  VectorX pivots() const { return ldlt_.permutationPinv() * VectorX(ldlt_.vectorD()); }

private:
  static constexpr int passes = 5;
  const SparseMatrix& G_;
  SparseMatrix transposed_;
  Eigen::SimplicialLDLT<SparseMatrix> ldlt_;
};

SparseMatrix some_rows(const SparseMatrix& part, const std::vector<Index>& rows) {
  std::vector<Index> place(part.rows(), -1);
  for (std::size_t k = 0; k < rows.size(); ++k)
    place[rows[k]] = static_cast<Index>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index c = 0; c < part.cols(); ++c)
    for (Iterator it(part, c); it; ++it)
      if (place[it.row()] >= 0)
        entries.emplace_back(place[it.row()], c, it.value());
  SparseMatrix out(static_cast<Index>(rows.size()), part.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

/// Rows well away from the span of those before them are certain. Pivots of the normal equations
/// are squares and say no more than that; of the few doubtful rows, what the certain ones leave of
/// them is computed itself, and judged by the same tolerance as the dense pivots.
std::vector<Index> sparse_rows(SparseMatrix part) {
  normalise_rows(part);
  const VectorX pivots = NormalEquations(part).pivots();
  std::vector<Index> rows, doubtful, left;
  for (Index i = 0; i < part.rows(); ++i)
    (pivots[i] > certain ? rows : doubtful).push_back(i);
  if (doubtful.empty())
    return rows;
  const SparseMatrix known = some_rows(part, rows), asked = some_rows(part, doubtful).transpose();
  const NormalEquations equations(known);
  std::vector<VectorX> remainders;
  for (std::size_t k = 0; k < doubtful.size(); ++k) {
    VectorX v = equations.remainder(VectorX(asked.col(static_cast<Index>(k))));
    if (v.norm() <= rank_tolerance)
      continue;
    left.push_back(doubtful[k]);
    remainders.push_back(std::move(v));
  }
  if (left.empty())
    return rows;
  MatrixX all(part.cols(), static_cast<Index>(left.size()));
  for (std::size_t k = 0; k < left.size(); ++k)
    all.col(static_cast<Index>(k)) = remainders[k];
  Eigen::ColPivHouseholderQR<MatrixX> qr(all);
  qr.setThreshold(std::min(1.0, rank_tolerance / qr.maxPivot()));
  for (Index k = 0; k < qr.rank(); ++k)
    rows.push_back(left[qr.colsPermutation().indices()[k]]);
  return rows;
}

VectorX dense_solution(const SparseMatrix& part, const VectorX& b) {
  Eigen::CompleteOrthogonalDecomposition<MatrixX> cod;
  cod.setThreshold(rank_tolerance);
  cod.compute(MatrixX(part));
  return cod.solve(b);
}

VectorX sparse_solution(SparseMatrix part, const VectorX& b) {
  const VectorX size = normalise_rows(part);
  return NormalEquations(part).smallest_solution(b.cwiseQuotient(size));
}

} // namespace

std::vector<Component> components(const SparseMatrix& matrix) {
  // Rows are joined by the columns that they share: a forest over the rows.
  std::vector<Index> parent(matrix.rows());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<Index> first(matrix.cols(), -1);
  for (Index c = 0; c < matrix.cols(); ++c)
    for (Iterator it(matrix, c); it; ++it) {
      if (it.value() == 0.0)
        continue;
      if (first[c] < 0)
        first[c] = it.row();
      parent[root(it.row())] = root(first[c]);
    }
  std::vector<Component> out;
  std::vector<Index> number(matrix.rows(), -1);
  for (Index c = 0; c < matrix.cols(); ++c) {
    if (first[c] < 0)
      continue;
    Index& part = number[root(first[c])];
    if (part < 0) {
      part = static_cast<Index>(out.size());
      out.emplace_back();
    }
    out[part].columns.push_back(c);
  }
  for (Index i = 0; i < matrix.rows(); ++i)
    if (number[root(i)] >= 0)
      out[number[root(i)]].rows.push_back(i);
  return out;
}

std::vector<Index> independent_rows(const SparseMatrix& matrix, Index dense_limit) {
  std::vector<Index> rows, place(matrix.rows());
  for (const Component& c : components(matrix)) {
    const SparseMatrix part = block(matrix, c, place);
    for (Index i : is_small(part, dense_limit) ? dense_rows(part) : sparse_rows(part))
      rows.push_back(c.rows[i]);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

VectorX smallest_solution(const SparseMatrix& matrix, const VectorX& b, Index dense_limit) {
  VectorX x = VectorX::Zero(matrix.cols());
  std::vector<Index> place(matrix.rows());
  for (const Component& c : components(matrix)) {
    const SparseMatrix part = block(matrix, c, place);
    VectorX right(part.rows());
    for (std::size_t i = 0; i < c.rows.size(); ++i)
      right[static_cast<Index>(i)] = b[c.rows[i]];
    const VectorX piece =
        is_small(part, dense_limit) ? dense_solution(part, right) : sparse_solution(part, right);
    for (std::size_t k = 0; k < c.columns.size(); ++k)
      x[c.columns[k]] = piece[static_cast<Index>(k)];
  }
  return x;
}

} // namespace hydrodae::system
