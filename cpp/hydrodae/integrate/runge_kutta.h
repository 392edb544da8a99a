#pragma once
/// Coefficients of implicit Runge-Kutta methods of any number of stages, computed at run time.

#include <complex>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae::integrate {

enum class Family { radau_iia, gauss, lobatto_iiic };

/// Method in the form that Newton's iteration needs.
struct RungeKutta {
  Family family = Family::radau_iia;
  int stages = 0, order = 0;
  VectorX c, b; ///< (s,) nodes and weights
  MatrixX a;    ///< (s, s)
  MatrixX a_inverse;
  /// Transformation a^-1 = T diag(real, pairs) T^-1. A pair (alpha, beta) is the block [[alpha,
  /// -beta], [beta, alpha]].
  MatrixX T, T_inverse;
  std::vector<double> real;
  std::vector<std::complex<double>> pairs;
  /// Weights of the end: y_end = y_start + sum_i end_i Z_i with the stage increments Z.
  VectorX end;
  /// Weights of the error estimate h gamma0 f(start) + sum_i error_i Z_i, of order s (Hairer and
  /// Wanner, Solving ODEs II (1996), section IV.8).
  VectorX error;
  double gamma0 = 0.0;
  bool stiffly_accurate() const { return family != Family::gauss; }
};

/// Methods Radau IIA (order 2 s - 1), Gauss (2 s) or Lobatto IIIC (2 s - 2).
RungeKutta make_runge_kutta(Family family, int stages);

} // namespace hydrodae::integrate
