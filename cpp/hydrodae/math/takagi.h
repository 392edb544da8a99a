#pragma once
/// Few products of vectors that stand for a Hermitian or a complex symmetric matrix.

#include <complex>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// M = sum_r s_r v_r v_r^H (Hermitian), or sum_r s_r v_r v_r^T (symmetric).
struct Products {
  VectorX s;          ///< (r,) by falling modulus
  Eigen::MatrixXcd v; ///< (r, n) unit vectors as rows
};

/// Eigenvalues and eigenvectors of a Hermitian matrix.
Products hermitian_products(const Eigen::MatrixXcd& M);

/// Takagi's factorisation of a complex symmetric matrix B + i C: s_r >= 0 and v_r = x + i y from
/// the eigenvectors [x; y] of the real matrix [B, C; C, -B] with positive eigenvalues. Its
/// negative ones belong to i v_r (Horn and Johnson, Matrix Analysis, 2nd ed., section 4.4).
Products symmetric_products(const Eigen::MatrixXcd& M);

/// Leaves out the last products as long as sum s_r^2 of those left out is at most `squares`.
void truncate(Products& products, double squares);

} // namespace hydrodae
