#include "hydrodae/math/block_matrix.h"

#include <algorithm>

namespace hydrodae {

namespace {

constexpr Index most_zeros = 8; ///< a block of its own costs about as much

} // namespace

/// Widens the blocks of the columns before, one by one, to hold these of the next column.
/// @returns false, with nothing done, where they would take in too many zeros
bool BlockMatrix::widen(const std::vector<Block>& next, std::size_t first) {
  if (next.empty() || blocks_.size() - first != next.size() ||
      blocks_.back().column + blocks_.back().columns != next.front().column)
    return false;
  std::vector<Block> wide;
  for (std::size_t k = 0; k < next.size(); ++k) {
    const Block &a = blocks_[first + k], &b = next[k];
    const Index row = std::min(a.row, b.row), rows = std::max(a.end(), b.end()) - row;
    if (rows * (a.columns + 1) - a.rows * a.columns - b.rows > most_zeros)
      return false;
    wide.push_back({row, rows, a.column, a.columns + 1});
  }
  for (std::size_t k = 1; k < wide.size(); ++k)
    if (wide[k].row < wide[k - 1].end())
      return false;
  std::copy(wide.begin(), wide.end(), blocks_.begin() + static_cast<std::ptrdiff_t>(first));
  return true;
}

template <class Entries> void BlockMatrix::make(const Entries& entries) {
  std::vector<Block> runs; // blocks of one column
  std::size_t first = 0;   // index of the first block of the column before
  const auto close = [&] {
    if (!widen(runs, first)) {
      first = blocks_.size();
      blocks_.insert(blocks_.end(), runs.begin(), runs.end());
    }
    runs.clear();
  };
  entries([&](Index row, Index column, double) {
    if (!runs.empty() && runs.back().column != column)
      close();
    if (runs.empty() || row - runs.back().end() > most_zeros)
      runs.push_back({row, 0, column, 1});
    runs.back().rows = row + 1 - runs.back().row;
  });
  close();
  Index size = 0;
  for (Block& b : blocks_) {
    b.first = size;
    size += b.rows * b.columns;
  }
  values_.assign(static_cast<std::size_t>(size), 0.0);
  std::size_t at = 0;
  Index last = -1;
  first = 0;
  entries([&](Index row, Index column, double value) {
    if (column != last)
      at = first;
    last = column;
    while (blocks_[at].column + blocks_[at].columns <= column || blocks_[at].end() <= row)
      if (blocks_[++at].column != blocks_[first].column)
        first = at;
    const Block& b = blocks_[at];
    values_[static_cast<std::size_t>(b.first + (column - b.column) * b.rows + row - b.row)] = value;
  });
}

BlockMatrix::BlockMatrix(const MatrixX& matrix) {
  make([&](const auto& visit) {
    for (Index c = 0; c < matrix.cols(); ++c)
      for (Index r = 0; r < matrix.rows(); ++r)
        if (matrix(r, c) != 0.0)
          visit(r, c, matrix(r, c));
  });
}

BlockMatrix::BlockMatrix(const std::vector<Entry>& sorted) {
  make([&](const auto& visit) {
    for (const Entry& e : sorted)
      visit(e.row, e.column, e.value);
  });
}

} // namespace hydrodae
