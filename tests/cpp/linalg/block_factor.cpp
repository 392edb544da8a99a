/// The factors by dense blocks solve what the sparse matrix says, by each instruction set.

#include "hydrodae/linalg/block_factor.h"

#include <doctest/doctest.h>

#include <random>

using namespace hydrodae;
using linalg::BlockFactor;

namespace {

/// K = [M G^T; G -D] by columns. Bodies of `sizes` unknowns, the first two coupled by the water;
/// each row is on two neighbours, the last rows on all bodies but the last where `wide`.
struct Saddle {
  std::vector<Index> start{0}, row, together;
  std::vector<double> values; ///< with D = 0
  MatrixX K;                  ///< likewise
  VectorX damping;
  Index n_u = 0;

  Saddle(const std::vector<Index>& sizes, Index n_rows, bool wide) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<Index> body;
    for (std::size_t b = 0; b < sizes.size(); ++b)
      body.insert(body.end(), static_cast<std::size_t>(sizes[b]), static_cast<Index>(b));
    together = body;
    n_u = std::ssize(body);
    const Index n = n_u + n_rows, last = std::ssize(sizes) - 1;
    MatrixX factor = MatrixX::Zero(n_u, n_u), there = MatrixX::Zero(n, n);
    for (Index i = 0; i < n_u; ++i)
      for (Index k = 0; k < n_u; ++k) {
        const Index a = body[static_cast<std::size_t>(i)], b = body[static_cast<std::size_t>(k)];
        if (a == b || (a < 2 && b < 2)) {
          there(i, k) = 1.0;
          factor(i, k) = any(generator);
        }
      }
    K = MatrixX::Zero(n, n);
    K.topLeftCorner(n_u, n_u) = factor * factor.transpose() + MatrixX::Identity(n_u, n_u);
    for (Index r = 0; r < n_rows; ++r)
      for (Index i = 0; i < n_u; ++i) {
        const Index b = body[static_cast<std::size_t>(i)], first = r % std::max<Index>(last, 1);
        if (wide ? b < last : (b == first || b == first + 1)) {
          K(n_u + r, i) = K(i, n_u + r) = any(generator);
          there(n_u + r, i) = there(i, n_u + r) = 1.0;
        }
      }
    damping = VectorX::Constant(n_rows, 1e-8);
    for (Index c = 0; c < n; ++c) {
      for (Index r = 0; r < n; ++r)
        if (there(r, c) != 0.0 || (r == c && c >= n_u)) {
          row.push_back(r);
          values.push_back(K(r, c));
        }
      start.push_back(std::ssize(row));
    }
  }
};

} // namespace

TEST_CASE("blocks solve the saddle-point matrix by every instruction set") {
  const std::vector<std::vector<Index>> bodies{
      {6, 6, 3, 1, 6}, {3}, {6, 6}, {54, 30, 6, 6}, {1, 1, 1}};
  for (const auto& kernels : dense::all_kernels())
    for (const std::vector<Index>& sizes : bodies)
      for (const bool wide : {false, true})
        for (const Index rows : {0, 2, 9}) {
          INFO(std::string(kernels.name), " ", sizes.size(), " ", rows);
          const Saddle saddle(sizes, rows, wide);
          if (2 * rows > saddle.n_u) // S would be nearly singular
            continue;
          BlockFactor blocks(saddle.start, saddle.row, saddle.n_u, saddle.together, kernels);
          for (int again = 0; again < 2; ++again) {
            REQUIRE(blocks.factorise(saddle.values, saddle.damping));
            const VectorX wanted = VectorX::LinSpaced(saddle.n_u + rows, -1.0, 2.0);
            VectorX x = saddle.K * wanted;
            blocks.solve(x.data());
            CHECK((saddle.K * (x - wanted)).norm() < 1e-9 * wanted.norm());
          }
        }
}

TEST_CASE("rows that follow from each other are kept apart by the damping") {
  Saddle saddle({6, 6}, 2, true);
  const Index n = saddle.n_u + 2;
  for (Index c = 0; c < n; ++c) // the second row like the first
    for (Index k = saddle.start[static_cast<std::size_t>(c)];
         k < saddle.start[static_cast<std::size_t>(c) + 1]; ++k) {
      const Index r = saddle.row[static_cast<std::size_t>(k)];
      const Index from_row = r == n - 1 ? n - 2 : r, from_column = c == n - 1 ? n - 2 : c;
      if (r < saddle.n_u || c < saddle.n_u)
        saddle.values[static_cast<std::size_t>(k)] = saddle.K(r, c) =
            saddle.K(from_row, from_column);
    }
  BlockFactor blocks(saddle.start, saddle.row, saddle.n_u, saddle.together);
  REQUIRE(blocks.factorise(saddle.values, saddle.damping));
  saddle.K.bottomRightCorner(2, 2).diagonal() = -saddle.damping;
  VectorX x = VectorX::LinSpaced(n, -1.0, 2.0);
  x[n - 1] = x[n - 2];
  const VectorX right = x;
  blocks.solve(x.data());
  CHECK((saddle.K * x - right).norm() < 1e-6 * right.norm());
  CHECK(x[n - 1] == doctest::Approx(x[n - 2]));
}

TEST_CASE("blocks count work, and refuse masses that are not positive") {
  Saddle saddle({6, 6}, 2, false);
  BlockFactor blocks(saddle.start, saddle.row, saddle.n_u, saddle.together);
  CHECK(blocks.least_work() == doctest::Approx(12.0 * 12.0 * 12.0 / 3.0));
  CHECK(blocks.work() > blocks.least_work());
  saddle.values[0] = 0.0; // M_00
  CHECK_FALSE(blocks.factorise(saddle.values, saddle.damping));
  saddle.values[0] = NAN;
  CHECK_FALSE(blocks.factorise(saddle.values, saddle.damping));
}

TEST_CASE("a product of padded matrices by each instruction set") {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Rows P = Rows::Random(13, 16), Q = Rows::Random(13, 24), before = Rows::Random(16, 24);
  for (const dense::Kernels& kernels : dense::all_kernels()) {
    CAPTURE(kernels.name);
    Rows C = before;
    kernels.add_product(13, 16, P.data(), 24, Q.data(), C.data());
    CHECK((C - before - P.transpose() * Q).cwiseAbs().maxCoeff() < 1e-14);
  }
}
