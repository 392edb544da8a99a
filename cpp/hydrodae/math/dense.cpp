#include "hydrodae/math/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <complex>

namespace hydrodae {

MatrixX solve_square(const MatrixX& A, const MatrixX& B) {
  return Eigen::PartialPivLU<MatrixX>(A).solve(B);
}

Eigen::MatrixXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
  return Eigen::PartialPivLU<Eigen::MatrixXcd>(A).solve(B);
}

Eigen::MatrixXcd product(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) { return A * B; }

Eigen::MatrixXcd congruence(const MatrixX& T, const Eigen::MatrixXcd& A) {
  const Eigen::MatrixXcd wide = T.cast<std::complex<double>>();
  const Eigen::MatrixXcd right = product(A, wide);
  return product(wide.transpose(), right);
}

MatrixX least_squares(const MatrixX& A, const MatrixX& B) {
  return Eigen::ColPivHouseholderQR<MatrixX>(A).solve(B);
}

VectorX minimum_norm(const MatrixX& A, const VectorX& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixX> cod;
  if (threshold >= 0.0)
    cod.setThreshold(threshold);
  cod.compute(A);
  return cod.solve(b);
}

MatrixX null_space(const MatrixX& G, double threshold) {
  if (G.rows() == 0)
    return MatrixX::Identity(G.cols(), G.cols());
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  if (threshold >= 0.0)
    qr.setThreshold(threshold);
  qr.compute(G.transpose());
  const MatrixX Q = qr.householderQ();
  return Q.rightCols(G.cols() - qr.rank());
}

PivotedColumns pivoted_columns(const MatrixX& A) {
  const Eigen::ColPivHouseholderQR<MatrixX> qr(A);
  PivotedColumns out{{}, VectorX::Zero(A.cols())};
  for (Index k = 0; k < A.cols(); ++k) {
    out.order.push_back(qr.colsPermutation().indices()[k]);
    if (k < A.rows())
      out.pivots[k] = std::abs(qr.matrixQR()(k, k));
  }
  return out;
}

std::pair<double, Eigen::VectorXcd> lowest_eigenpair(const Eigen::MatrixXcd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(A);
  return {solver.eigenvalues()[0], solver.eigenvectors().col(0)};
}

VectorX symmetric_eigenvalues(const MatrixX& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixX>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorX real_parts_of_eigenvalues(const MatrixX& A) {
  return Eigen::EigenSolver<MatrixX>(A, false).eigenvalues().real();
}

} // namespace hydrodae
