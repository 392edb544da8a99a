#include "hydrodae/math/takagi.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace hydrodae {
namespace {

/// Products by falling |s|; column `order[r]` of `vectors` belongs to `values[order[r]]`.
Products ordered(const VectorX& values, const Eigen::MatrixXcd& vectors, bool positive) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), Index{0});
  if (positive)
    std::erase_if(order, [&](Index r) { return !(values[r] > 0.0); });
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(values[a]) > std::abs(values[b]); });
  Products out;
  out.s.resize(std::ssize(order));
  out.v.resize(std::ssize(order), vectors.rows());
  for (std::size_t r = 0; r < order.size(); ++r) {
    out.s[static_cast<Index>(r)] = values[order[r]];
    out.v.row(static_cast<Index>(r)) = vectors.col(order[r]).transpose();
  }
  return out;
}

} // namespace

Products hermitian_products(const Eigen::MatrixXcd& M) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(M);
  return ordered(solver.eigenvalues(), solver.eigenvectors(), false);
}

Products symmetric_products(const Eigen::MatrixXcd& M) {
  const Index n = M.rows();
  MatrixX K(2 * n, 2 * n);
  K << M.real(), M.imag(), M.imag(), -M.real();
  const Eigen::SelfAdjointEigenSolver<MatrixX> solver(K);
  Eigen::MatrixXcd vectors(n, 2 * n);
  vectors.real() = solver.eigenvectors().topRows(n);
  vectors.imag() = solver.eigenvectors().bottomRows(n);
  return ordered(solver.eigenvalues(), vectors, true);
}

void truncate(Products& products, double squares) {
  Index kept = products.s.size();
  for (double left_out = 0.0; kept > 0; --kept) {
    left_out += products.s[kept - 1] * products.s[kept - 1];
    if (left_out > squares)
      break;
  }
  products.s.conservativeResize(kept);
  products.v.conservativeResize(kept, products.v.cols());
}

} // namespace hydrodae
