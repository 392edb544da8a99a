#include "hydrodae/math/block_matrix.h"

#include <complex>
#include <random>

#include <doctest/doctest.h>

#include "hydrodae/math/dual.h"

using namespace hydrodae;

namespace {

/// Blocks, single entries, empty rows and columns, at random.
MatrixX patchy(Index rows, Index columns, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  MatrixX m = MatrixX::Zero(rows, columns);
  const auto below = [&](Index n) {
    return static_cast<Index>(random() % static_cast<unsigned>(n));
  };
  for (int patch = 0; patch < 12; ++patch) {
    const Index r = below(rows), c = below(columns), height = 1 + below(rows - r),
                width = 1 + below(std::min<Index>(columns - c, 6));
    for (Index k = c; k < c + width; ++k)
      for (Index i = r; i < r + (patch % 3 == 0 ? height : 1); ++i)
        m(i, k) = below(4) == 0 ? 0.0 : value(random);
  }
  return m;
}

template <class S> void check_product(const MatrixX& m, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  VecX<S> x(m.cols()), y = VecX<S>::Constant(m.rows(), S(0.25)), expected = y;
  for (Index k = 0; k < x.size(); ++k)
    x[k] = S(value(random), value(random));
  for (Index i = 0; i < m.rows(); ++i)
    for (Index k = 0; k < m.cols(); ++k)
      expected[i] += S(-2.0 * m(i, k)) * x[k];
  BlockMatrix(m).add_product(x.data(), y.data(), -2.0);
  for (Index i = 0; i < m.rows(); ++i)
    if constexpr (std::is_same_v<S, Dual>)
      CHECK(std::hypot(y[i].a - expected[i].a, y[i].b - expected[i].b) < 1e-14);
    else
      CHECK(std::abs(y[i] - expected[i]) < 1e-14);
}

} // namespace

TEST_CASE("the blocks of a matrix hold it and multiply like it") {
  std::mt19937 random(5);
  for (int k = 0; k < 50; ++k) {
    const MatrixX m = patchy(1 + k, 1 + (7 * k) % 31, random);
    MatrixX held = MatrixX::Zero(m.rows(), m.cols());
    BlockMatrix(m).for_each([&](Index r, Index c, double v) {
      CHECK(held(r, c) == 0.0);
      held(r, c) = v;
    });
    CHECK(held == m);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    const VectorX x = VectorX::NullaryExpr(m.cols(), [&] { return value(random); });
    VectorX y = VectorX::Ones(m.rows());
    const VectorX expected = y - 2.0 * (m * x);
    BlockMatrix(m).add_product(x.data(), y.data(), -2.0);
    CHECK((y - expected).cwiseAbs().maxCoeff() < 1e-14);
    check_product<std::complex<double>>(m, random);
    check_product<Dual>(m, random);
  }
}

TEST_CASE("zeros outside the blocks are not stored, so they may meet what is not finite") {
  MatrixX m = MatrixX::Zero(40, 40);
  m.topLeftCorner<6, 6>().setOnes();
  m.bottomRightCorner<6, 6>().setOnes();
  VectorX x = VectorX::Ones(40), y = VectorX::Zero(40);
  x[20] = NAN;
  BlockMatrix(m).add_product(x.data(), y.data());
  CHECK(y[0] == 6.0);
  CHECK(y[39] == 6.0);
  CHECK(y.allFinite());
}
