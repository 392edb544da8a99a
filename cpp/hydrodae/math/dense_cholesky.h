#pragma once
/// Dense kernels for symmetric positive definite blocks: M = U^T U, and what a Schur complement
/// needs of it. Each is compiled for the plain processor, for AVX2 and for AVX-512, and the widest
/// that the machine has is taken at run time.
///
/// All matrices are row-major, and their rows have a stride that is a multiple of `lanes`, so that
/// no kernel has a remainder. The columns beyond the matrix are zero; U has ones on the diagonal
/// there.

#include <span>

#include "hydrodae/core/types.h"

namespace hydrodae::dense {

constexpr Index lanes = 8; ///< numbers in the longest register

/// The next multiple of `lanes`.
constexpr Index padded(Index n) { return (n + lanes - 1) / lanes * lanes; }

/// The kernels of one instruction set. n and m are multiples of `lanes`.
struct Kernels {
  const char* name;

  /// U (n, n) in the upper triangle of `a`, which holds that of M. Each block on the diagonal then
  /// holds its inverse, with zeros below.
  /// @param least a pivot at most this part of its entry of M counts as zero
  /// @return false when M is not positive definite
  bool (*factorise)(Index n, double* a, double least);

  /// W := U^-T W for W (n, m).
  void (*solve_left)(Index n, const double* u, Index m, double* w);

  /// S += W^T W for W (n, m): the upper triangle of S (m, m), with whole blocks on the diagonal.
  void (*add_gram)(Index n, Index m, const double* w, double* s);

  /// C += P^T Q for P (k, n), Q (k, m), C (n, m), with any k.
  void (*add_product)(Index k, Index n, const double* p, Index m, const double* q, double* c);

  /// x := U^-T x and x := U^-1 x for x (n,).
  void (*solve_forward)(Index n, const double* u, double* x);
  void (*solve_backward)(Index n, const double* u, double* x);

  /// y += W^T x and x -= W y for W (n, m), x (n,), y (m,).
  void (*add_transposed)(Index n, Index m, const double* w, const double* x, double* y);
  void (*subtract_product)(Index n, Index m, const double* w, const double* y, double* x);
};

/// Kernels that this machine can run, the widest last.
std::span<const Kernels> all_kernels();

inline const Kernels& kernels() { return all_kernels().back(); }

} // namespace hydrodae::dense
