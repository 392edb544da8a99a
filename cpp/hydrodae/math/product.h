#pragma once
#include <type_traits>
#include <utility>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// A constant matrix that only multiplies vectors: whole, or by its nonzeros where they are few.
class Product {
public:
  Product() = default;
  explicit Product(const MatrixX& whole) : cols_(whole.cols()) {
    ends_.assign(static_cast<std::size_t>(whole.rows()), 0);
    const auto visit = [&](auto&& nonzero) { // as it is stored: column by column
      for (Index j = 0; j < whole.cols(); ++j)
        for (Index i = 0; i < whole.rows(); ++i)
          if (whole(i, j) != 0.0)
            nonzero(ends_[static_cast<std::size_t>(i)], j, whole(i, j));
    };
    std::size_t count = 0;
    visit([&](std::size_t& in_row, Index, double) {
      ++in_row;
      ++count;
    });
    if (!are_few(count)) {
      whole_ = whole;
      return;
    }
    columns_.resize(count);
    values_.resize(count);
    std::size_t before = 0; // of the rows above
    for (std::size_t& end : ends_)
      before += std::exchange(end, before);
    visit([&](std::size_t& next, Index column, double value) {
      columns_[next] = static_cast<int>(column);
      values_[next++] = value;
    });
  }

  /// To be filled row by row: `append` the entries of a row, `end_row`; at last `finish`.
  explicit Product(Index cols) : cols_(cols) {}
  void append(Index column, double value) {
    if (value == 0.0)
      return;
    columns_.push_back(static_cast<int>(column));
    values_.push_back(value);
  }
  void end_row() { ends_.push_back(values_.size()); }
  void finish() {
    if (are_few(values_.size()))
      return;
    whole_ = matrix();
    columns_ = {};
    values_ = {};
  }

  Index rows() const { return std::ssize(ends_); }
  Index cols() const { return cols_; }
  bool by_nonzeros() const { return whole_.size() == 0; }
  MatrixX matrix() const {
    if (!by_nonzeros())
      return whole_;
    MatrixX out = MatrixX::Zero(rows(), cols_);
    for_nonzeros([&](Index i, Index j, double value) { out(i, j) = value; });
    return out;
  }

  /// out = M x.
  template <class S> void times(const S* x, VecX<S>& out) const {
    if (!by_nonzeros()) {
      multiply(whole_, x, out);
      return;
    }
    std::size_t k = 0;
    for (Index i = 0; i < rows(); ++i) {
      S sum(0);
      for (; k < ends_[static_cast<std::size_t>(i)]; ++k)
        sum += S(values_[k]) * x[columns_[k]];
      out[i] = sum;
    }
  }

  /// out = m x without temporaries; a plain loop for scalars that Eigen does not vectorise.
  template <class S> static void multiply(const MatrixX& m, const S* x, VecX<S>& out) {
    if constexpr (std::is_same_v<S, double>) {
      out.noalias() = m * Eigen::Map<const VectorX>(x, m.cols());
    } else {
      for (Index i = 0; i < m.rows(); ++i) {
        S sum(0);
        for (Index j = 0; j < m.cols(); ++j)
          sum += S(m(i, j)) * x[j];
        out[i] = sum;
      }
    }
  }

private:
  /// A number that is looked up by its place costs as much as four of a row that is read through,
  /// of which a vector instruction takes four.
  bool are_few(std::size_t nonzeros) const {
    return 4 * nonzeros <= ends_.size() * static_cast<std::size_t>(cols_);
  }

  template <class Visit> void for_nonzeros(Visit&& visit) const {
    std::size_t k = 0;
    for (Index i = 0; i < rows(); ++i)
      for (; k < ends_[static_cast<std::size_t>(i)]; ++k)
        visit(i, Index{columns_[k]}, values_[k]);
  }

  Index cols_ = 0;
  MatrixX whole_;                 ///< (rows, cols), or empty
  std::vector<std::size_t> ends_; ///< of the rows, in the next two
  std::vector<int> columns_;
  std::vector<double> values_;
};

} // namespace hydrodae
