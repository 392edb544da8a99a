#include "hydrodae/ensemble/step_polynomial.h"

#include "hydrodae/integrate/dormand_prince_8.h"

namespace hydrodae::ensemble {

namespace {

/// The interpolant is C(x) = C_0 + sum_i F_i v_i(x), v_0 = x, v_i = v_{i-1} (1 - x) for odd i and
/// v_{i-1} x for even i, with
///
///   F_0 = dC,  F_1 = h c_0 - dC,  F_2 = 2 dC - h (c_end + c_0),  F_i = h sum_j d_ij c_j,
///
/// and dC = h sum_j b_j c_j. The length h of the step cancels in c = C' / h.
StepPolynomial make() {
  using namespace integrate::tableaux;
  constexpr std::size_t n = polynomial_size, end = stages;
  std::array<std::array<double, polynomial_stages>, n> f{};
  for (std::size_t j = 0; j < end; ++j) {
    f[0][j] = rk8_b[j];
    f[1][j] = -rk8_b[j];
    f[2][j] = 2.0 * rk8_b[j];
  }
  f[1][0] += 1.0;
  f[2][0] -= 1.0;
  f[2][end] -= 1.0;
  for (std::size_t i = 3; i < n; ++i)
    for (std::size_t j = 0; j < polynomial_stages; ++j)
      f[i][j] = rk8_d[polynomial_stages * (i - 3) + j];
  StepPolynomial out{};
  std::array<double, n + 1> v{0.0, 1.0}; // coefficients of v_i
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      std::array<double, n + 1> next{};
      for (std::size_t m = 0; m < n; ++m) {
        next[m + 1] += i % 2 == 0 ? v[m] : -v[m];
        if (i % 2 == 1)
          next[m] += v[m];
      }
      v = next;
    }
    for (std::size_t m = 0; m < n; ++m)
      for (std::size_t j = 0; j < polynomial_stages; ++j)
        out[m][j] += static_cast<double>(m + 1) * v[m + 1] * f[i][j];
  }
  return out;
}

} // namespace

const StepPolynomial& step_polynomial() {
  static const StepPolynomial weights = make();
  return weights;
}

} // namespace hydrodae::ensemble
