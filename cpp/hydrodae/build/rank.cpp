#include "hydrodae/build/rank.h"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "hydrodae/math/dense.h"
#include "hydrodae/math/sets.h"

namespace hydrodae::build {

namespace {

using Iterator = SparseMatrix::InnerIterator;

/// Least pivot of an independent row, as part of the largest pivot
constexpr double rank_tolerance = 1e-9;
constexpr double damping = 1e-12; ///< damping of the normal equations, whose diagonal is one
/// Pivot of the normal equations above which a row is independent
constexpr double certain = 1e-3;
/// Higher limit for the case that too many rows would be in doubt
constexpr double surely_certain = 1e-8;
constexpr std::size_t most_doubtful_rows = 200;

/// Rows and columns of one component. `place` has one entry per row of `matrix`: scratch.
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

/// Columns of A by decreasing pivots, those of `first` before the others, whose pivots are their
/// remainders after the first ones. Pivots are in units of the largest.
std::vector<RankedRow> ranked_columns(const MatrixX& A, const std::vector<bool>& first) {
  std::vector<Index> own[2];
  for (Index k = 0; k < A.cols(); ++k)
    own[first[static_cast<std::size_t>(k)] ? 0 : 1].push_back(k);
  std::vector<RankedRow> rows;
  MatrixX span(A.rows(), 0);
  double largest = 0.0;
  for (const std::vector<Index>& some : own) {
    if (some.empty())
      continue;
    MatrixX left = A(Eigen::all, some);
    for (int pass = 0; pass < 2 && span.cols() > 0; ++pass) // twice suffices against rounding
      left -= span * (span.transpose() * left);
    const auto [order, pivots] = pivoted_columns(left);
    largest = std::max(largest, pivots[0]);
    Index rank = 0;
    for (Index k = 0; k < left.cols(); ++k) {
      rows.push_back(
          {some[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])], pivots[k]});
      if (pivots[k] > rank_tolerance * largest)
        ++rank;
    }
    if (own[1].empty())
      break;
    const std::vector<Index> independent{order.begin(), order.begin() + rank};
    span = Eigen::HouseholderQR<MatrixX>(left(Eigen::all, independent)).householderQ() *
           MatrixX::Identity(A.rows(), rank);
  }
  for (RankedRow& row : rows)
    row.pivot /= largest > 0.0 ? largest : 1.0;
  return rows;
}

/// Scales the rows to length one; returns their lengths.
VectorX normalise_rows(SparseMatrix& part) {
  VectorX size = VectorX::Zero(part.rows());
  for (Index c = 0; c < part.cols(); ++c)
    for (Iterator it(part, c); it; ++it)
      size[it.row()] += it.value() * it.value();
  size = size.cwiseSqrt();
  for (Index c = 0; c < part.cols(); ++c)
    for (SparseMatrix::InnerIterator it(part, c); it; ++it)
      if (size[it.row()] > 0.0)
        it.valueRef() /= size[it.row()];
  return size;
}

/// Damped normal equations G G^T + damping I, factorised as L D L^T.
class NormalEquations {
public:
  explicit NormalEquations(const SparseMatrix& G) : G_(G), transposed_(G.transpose()) {
    SparseMatrix normal = G * transposed_;
    for (Index i = 0; i < normal.rows(); ++i)
      normal.coeffRef(i, i) += damping;
    ldlt_.compute(normal);
  }

  // Iterates x = G^T l with (G G^T + damping I) dl = b - G x: each pass leaves damping / (s^2 +
  // damping) of the gap along a singular value s. The unreachable part grows in l but never enters
  // G^T l.
  VectorX smallest_solution(const VectorX& b) const {
    VectorX x = VectorX::Zero(G_.cols());
    for (int pass = 0; pass < passes; ++pass)
      x += transposed_ * VectorX(ldlt_.solve(b - G_ * x));
    return x;
  }

  /// Remainder of v outside the rows: v - G^T l with the smallest |v - G^T l|.
  VectorX remainder(VectorX v) const {
    for (int pass = 0; pass < passes; ++pass)
      v -= transposed_ * VectorX(ldlt_.solve(G_ * v));
    return v;
  }

  /// Squared distance of each row from the rows eliminated before it, by row; for a redundant row,
  /// the damping times one plus the square of its coefficients.
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

/// Squared distances of the rows from those eliminated before them, as in
/// `NormalEquations::pivots`. If few rows are not among the first, theirs are 0: their remainders
/// are then computed.
VectorX squared_pivots(const SparseMatrix& part, const std::vector<bool>& first) {
  std::vector<Index> own;
  for (Index i = 0; i < part.rows(); ++i)
    if (first[static_cast<std::size_t>(i)])
      own.push_back(i);
  const std::size_t others = first.size() - own.size();
  if (others == 0 || others > most_doubtful_rows)
    return NormalEquations(part).pivots();
  const SparseMatrix some = some_rows(part, own);
  const VectorX found = NormalEquations(some).pivots();
  VectorX out = VectorX::Zero(part.rows());
  for (std::size_t k = 0; k < own.size(); ++k)
    out[own[k]] = found[static_cast<Index>(k)];
  return out;
}

/// Ranks rows. Those well away from the span of earlier rows are certain. Pivots of the normal
/// equations are squares and can decide no more. For the few doubtful rows the remainder after the
/// certain ones is computed, and judged by the tolerance of the dense pivots.
std::vector<RankedRow> sparse_rows(SparseMatrix part, const std::vector<bool>& first) {
  normalise_rows(part);
  const VectorX pivots = squared_pivots(part, first);
  std::vector<RankedRow> rows;
  std::vector<Index> known, doubtful;
  double limit = certain;
  if (static_cast<std::size_t>((pivots.array() <= limit).count()) > most_doubtful_rows)
    limit = surely_certain;
  for (Index i = 0; i < part.rows(); ++i) {
    (pivots[i] > limit ? known : doubtful).push_back(i);
    if (pivots[i] > limit)
      rows.push_back({i, std::sqrt(pivots[i])});
  }
  if (doubtful.empty())
    return rows;
  const SparseMatrix certainly = some_rows(part, known),
                     asked = some_rows(part, doubtful).transpose();
  const NormalEquations equations(certainly);
  MatrixX left(part.cols(), asked.cols());
  for (Index k = 0; k < asked.cols(); ++k)
    left.col(k) = equations.remainder(VectorX(asked.col(k)));
  const auto [order, sizes] = pivoted_columns(left);
  for (Index k = 0; k < left.cols(); ++k)
    rows.push_back(
        {doubtful[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])], sizes[k]});
  return rows;
}

VectorX dense_solution(const SparseMatrix& part, const VectorX& b) {
  return minimum_norm(MatrixX(part), b, rank_tolerance);
}

VectorX sparse_solution(SparseMatrix part, const VectorX& b) {
  const VectorX size = normalise_rows(part);
  return NormalEquations(part).smallest_solution(b.cwiseQuotient(size));
}

} // namespace

std::vector<Component> components(const SparseMatrix& matrix) {
  // Rows with common columns are joined: a forest over the rows.
  Sets sets(matrix.rows());
  std::vector<Index> first(matrix.cols(), -1);
  for (Index c = 0; c < matrix.cols(); ++c)
    for (Iterator it(matrix, c); it; ++it) {
      if (it.value() == 0.0)
        continue;
      if (first[c] < 0)
        first[c] = it.row();
      sets.join(it.row(), first[c]);
    }
  std::vector<Component> out;
  std::vector<Index> number(matrix.rows(), -1);
  for (Index c = 0; c < matrix.cols(); ++c) {
    if (first[c] < 0)
      continue;
    Index& part = number[sets.root(first[c])];
    if (part < 0) {
      part = static_cast<Index>(out.size());
      out.emplace_back();
    }
    out[part].columns.push_back(c);
  }
  for (Index i = 0; i < matrix.rows(); ++i)
    if (number[sets.root(i)] >= 0)
      out[number[sets.root(i)]].rows.push_back(i);
  return out;
}

std::vector<RankedRow> ranked_rows(const SparseMatrix& matrix, const std::vector<bool>& first,
                                   Index dense_limit) {
  std::vector<RankedRow> rows;
  std::vector<Index> place(matrix.rows());
  for (const Component& c : components(matrix)) {
    const SparseMatrix part = block(matrix, c, place);
    std::vector<bool> own(c.rows.size(), true);
    for (std::size_t i = 0; i < own.size() && !first.empty(); ++i)
      own[i] = first[static_cast<std::size_t>(c.rows[i])];
    for (const RankedRow& row : is_small(part, dense_limit)
                                    ? ranked_columns(MatrixX(part).transpose(), own)
                                    : sparse_rows(part, own))
      rows.push_back({c.rows[static_cast<std::size_t>(row.row)], row.pivot});
  }
  return rows;
}

std::vector<Index> independent_rows(const SparseMatrix& matrix, Index dense_limit) {
  std::vector<Index> rows;
  for (const RankedRow& row : ranked_rows(matrix, {}, dense_limit))
    if (row.pivot > rank_tolerance)
      rows.push_back(row.row);
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

VectorX damped_solution(const SparseMatrix& matrix, const VectorX& b, double damped) {
  SparseMatrix G = matrix;
  VectorX right = b;
  const VectorX size = normalise_rows(G);
  for (Index i = 0; i < right.size(); ++i)
    right[i] = size[i] > 0.0 ? right[i] / size[i] : 0.0;
  const SparseMatrix transposed = G.transpose();
  SparseMatrix normal = G * transposed;
  for (Index i = 0; i < normal.rows(); ++i)
    normal.coeffRef(i, i) += damped;
  const Eigen::SimplicialLDLT<SparseMatrix> ldlt(normal);
  return transposed * VectorX(ldlt.solve(right));
}

} // namespace hydrodae::build
