/// Static steps where nothing holds some directions: dense and sparse factors agree.

#include "hydrodae/statics/static_step.h"

#include <doctest/doctest.h>

#include <Eigen/QR>
#include <cmath>

#include "hydrodae/math/dense.h"

namespace {

using namespace hydrodae;

/// A row of n carts on springs to each other, not to the ground; each tenth is tied to the next.
MatrixX carts(Index n, Index ties) {
  MatrixX A = MatrixX::Zero(n + ties, n + ties);
  for (Index i = 0; i + 1 < n; ++i) {
    const double k = 1.0 + 0.5 * std::sin(static_cast<double>(i));
    A(i, i) += k;
    A(i + 1, i + 1) += k;
    A(i, i + 1) -= k;
    A(i + 1, i) -= k;
  }
  for (Index t = 0; t < ties; ++t) {
    const Index row = n + t, i = 10 * t;
    A(row, i) = 1.0;
    A(row, i + 1) = -1.0;
    A.col(row).head(n) = -A.row(row).head(n).transpose();
  }
  return A;
}

TEST_CASE("large static steps are the smallest ones too") {
  const Index n = 280, ties = 20;
  const MatrixX A = carts(n, ties);
  VectorX b(n + ties);
  for (Index i = 0; i < b.size(); ++i)
    b[i] = std::sin(0.3 * static_cast<double>(i * i));
  b.head(n).array() -= b.head(n).mean(); // nothing holds the whole row
  const VectorX sparse = statics::smallest_solution(A, b, n);
  const VectorX dense = Eigen::CompleteOrthogonalDecomposition<MatrixX>(A).solve(b);
  CHECK((A * sparse - b).norm() < 1e-9 * b.norm());
  CHECK((sparse - dense).norm() < 1e-6 * dense.norm());
}

TEST_CASE("the null space of constraints with a row too many") {
  MatrixX G(3, 5);
  G << 1, 0, -1, 0, 0, 0, 1, 0, -1, 0, 1, 1, -1, -1, 0;
  const MatrixX N = null_space(G);
  CHECK(N.cols() == 3);
  CHECK((G * N).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((N.transpose() * N - MatrixX::Identity(3, 3)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(null_space(MatrixX::Zero(0, 4)).cols() == 4);
}

} // namespace
