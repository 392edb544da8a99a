#pragma once
/// A constant matrix as the dense blocks outside which it is zero, so that a product costs what is
/// there.

#include <algorithm>
#include <type_traits>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

class BlockMatrix {
public:
  struct Entry {
    Index row = 0, column = 0;
    double value = 0.0;
  };

  BlockMatrix() = default;
  explicit BlockMatrix(const MatrixX& matrix);
  /// Entries sorted by columns, then by rows.
  explicit BlockMatrix(const std::vector<Entry>& entries);

  /// y += factor M x
  template <class S> void add_product(const S* x, S* y, double factor = 1.0) const {
    for (const Block& b : blocks_) {
      const double* from = values_.data() + b.first;
      S* const to = y + b.row;
      if constexpr (std::is_same_v<S, double>) {
        if (b.columns > 8) { // takes several columns at once
          Eigen::Map<VectorX>(to, b.rows).noalias() +=
              factor * (Eigen::Map<const MatrixX>(from, b.rows, b.columns) *
                        Eigen::Map<const VectorX>(x + b.column, b.columns));
          continue;
        }
        for (Index c = 0; c < b.columns; ++c, from += b.rows) {
          const double by = factor * x[b.column + c];
          for (Index r = 0; r < b.rows; ++r)
            to[r] += from[r] * by;
        }
      } else {
        for (Index r = 0; r < b.rows; r += rows_at_once)
          add_rows<S>(b, from + r, std::min(rows_at_once, b.rows - r), x + b.column, to + r,
                      factor);
      }
    }
  }

  /// Calls `visit` with row, column and value of each entry that is not zero, block by block.
  template <class Visit> void for_each(Visit&& visit) const {
    for (const Block& b : blocks_)
      for (Index c = 0; c < b.columns; ++c)
        for (Index r = 0; r < b.rows; ++r)
          if (const double value = values_[static_cast<std::size_t>(b.first + c * b.rows + r)];
              value != 0.0)
            visit(b.row + r, b.column + c, value);
  }

private:
  struct Block {
    Index row = 0, rows = 0, column = 0, columns = 0;
    Index first = 0; ///< in `values_`, column by column
    Index end() const { return row + rows; }
  };
  static constexpr Index rows_at_once = 4; ///< sums that are kept in registers

  /// y += factor M x of `count` rows of a block, whose columns begin at `from`.
  template <class S>
  static void add_rows(const Block& b, const double* from, Index count, const S* x, S* y,
                       double factor) {
    if (count < rows_at_once) {
      for (Index r = 0; r < count; ++r) {
        S sum(0);
        for (Index c = 0; c < b.columns; ++c)
          sum += from[c * b.rows + r] * x[c];
        y[r] += S(factor) * sum;
      }
      return;
    }
    S sum[rows_at_once] = {S(0), S(0), S(0), S(0)};
    for (Index c = 0; c < b.columns; ++c, from += b.rows)
      for (Index r = 0; r < rows_at_once; ++r)
        sum[r] += from[r] * x[c];
    for (Index r = 0; r < rows_at_once; ++r)
      y[r] += S(factor) * sum[r];
  }

  template <class Entries> void make(const Entries& entries);
  bool widen(const std::vector<Block>& next, std::size_t first);
  std::vector<Block> blocks_; ///< by columns, those of the same columns by rows
  std::vector<double> values_;
};

} // namespace hydrodae
