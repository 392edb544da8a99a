#pragma once
/// Constant matrix stored as dense blocks, so that a product costs only the nonzero blocks.

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
      if constexpr (std::is_same_v<S, double>)
        if (b.columns > 8) { // takes several columns at once
          Eigen::Map<VectorX>(to, b.rows).noalias() +=
              factor * (Eigen::Map<const MatrixX>(from, b.rows, b.columns) *
                        Eigen::Map<const VectorX>(x + b.column, b.columns));
          continue;
        }
      // Two columns at once read and write y half as often, and add in the same order.
      const S* by = x + b.column;
      Index left = b.columns;
      for (; left >= 2; left -= 2, by += 2, from += 2 * b.rows) {
        const S first = S(factor) * by[0], second = S(factor) * by[1];
        for (Index r = 0; r < b.rows; ++r)
          to[r] = (to[r] + from[r] * first) + from[b.rows + r] * second;
      }
      if (left > 0) {
        const S last = S(factor) * *by;
        for (Index r = 0; r < b.rows; ++r)
          to[r] += from[r] * last;
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
    Index first = 0; ///< offset in `values_`, column by column
    Index end() const { return row + rows; }
  };
  template <class Entries> void make(const Entries& entries);
  bool widen(const std::vector<Block>& next, std::size_t first);
  std::vector<Block> blocks_; ///< sorted by columns, those of the same columns by rows
  std::vector<double> values_;
};

} // namespace hydrodae
