#include "hydrodae/integrate/runge_kutta.h"

#include <Eigen/Dense>
#include <cmath>

namespace hydrodae::integrate {

namespace {

using Real = long double;
using VectorL = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using MatrixL = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Legendre polynomials P_n(x) and P_{n-1}(x), x in [-1, 1].
std::pair<Real, Real> legendre(int n, Real x) {
  Real p = 1, before = 0;
  for (int k = 1; k <= n; ++k) {
    const Real next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
    before = p;
    p = next;
  }
  return {p, before};
}

/// Derivative P_n' = n (x P_n - P_{n-1}) / (x^2 - 1), |x| < 1.
Real legendre_slope(int n, Real x) {
  const auto [p, before] = legendre(n, x);
  return n * (x * p - before) / (x * x - 1);
}

/// Function with roots at the inner nodes: P_s (Gauss), P_s - P_{s-1} (Radau, without the node 1),
/// P_{s-1}' (Lobatto, without the ends).
Real node_function(Family family, int s, Real x) {
  switch (family) {
  case Family::gauss:
    return legendre(s, x).first;
  case Family::radau_iia: {
    const auto [p, before] = legendre(s, x);
    return p - before;
  }
  case Family::lobatto_iiic:
    break;
  }
  return legendre_slope(s - 1, x);
}

/// Nodes on [0, 1]: simple roots, found by sign changes on a grid finer than their distance (near
/// the ends that of Chebyshev points), then by bisection.
VectorL nodes(Family family, int s) {
  std::vector<Real> x;
  if (family == Family::lobatto_iiic)
    x.push_back(-1);
  const int cells = 400;
  const Real pi_l = std::acos(Real(-1));
  auto at = [&](int i) { return -std::cos(pi_l * (i + Real(0.5)) / (cells + 1)); };
  for (int i = 0; i < cells; ++i) {
    Real low = at(i), high = at(i + 1);
    const Real f_low = node_function(family, s, low);
    if (f_low * node_function(family, s, high) > 0)
      continue;
    for (int k = 0; k < 200 && high - low > 0; ++k) {
      const Real middle = (low + high) / 2;
      if (middle == low || middle == high)
        break;
      (f_low * node_function(family, s, middle) > 0 ? low : high) = middle;
    }
    x.push_back((low + high) / 2);
  }
  if (family != Family::gauss)
    x.push_back(1);
  VectorL c(s);
  for (int i = 0; i < s; ++i)
    c[i] = (x.at(static_cast<std::size_t>(i)) + 1) / 2;
  return c;
}

/// Integral int_0^x P_k(2 t - 1) dt.
Real legendre_integral(int k, Real x) {
  const Real z = 2 * x - 1;
  if (k == 0)
    return x;
  return (legendre(k + 1, z).first - legendre(k - 1, z).first) / (2 * (2 * k + 1));
}

/// Weights w with sum_j w_j P_k(c_j) = m_k, k = 0 .. s - 1.
VectorL weights(const VectorL& c, const VectorL& m) {
  const auto s = c.size();
  MatrixL P(s, s);
  for (Eigen::Index k = 0; k < s; ++k)
    for (Eigen::Index j = 0; j < s; ++j)
      P(k, j) = legendre(static_cast<int>(k), 2 * c[j] - 1).first;
  return P.fullPivLu().solve(m);
}

VectorL moments(int s, Real x) {
  VectorL m(s);
  for (int k = 0; k < s; ++k)
    m[k] = legendre_integral(k, x);
  return m;
}

/// Matrix A from the collocation conditions; Lobatto IIIC has a_i1 = b_1 in place of the highest
/// one.
MatrixL stage_matrix(Family family, const VectorL& c, const VectorL& b) {
  const int s = static_cast<int>(c.size());
  MatrixL A(s, s);
  for (int i = 0; i < s; ++i) {
    if (family != Family::lobatto_iiic) {
      A.row(i) = weights(c, moments(s, c[i])).transpose();
      continue;
    }
    MatrixL P(s, s);
    VectorL m = moments(s, c[i]);
    for (int k = 0; k < s - 1; ++k)
      for (int j = 0; j < s; ++j)
        P(k, j) = legendre(k, 2 * c[j] - 1).first;
    P.row(s - 1).setZero();
    P(s - 1, 0) = 1;
    m[s - 1] = b[0];
    A.row(i) = P.fullPivLu().solve(m).transpose();
  }
  return A;
}

/// Transforms a^-1 = T L T^-1 with the real eigenvalue first (odd s), then 2 x 2 blocks.
void transform(const MatrixL& inverse, RungeKutta& rk) {
  const auto s = inverse.rows();
  const Eigen::EigenSolver<MatrixL> eigen(inverse);
  MatrixL T(s, s);
  Eigen::Index column = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (Eigen::Index k = 0; k < s; ++k) {
      const std::complex<Real> value = eigen.eigenvalues()[k];
      const bool is_real = std::abs(value.imag()) < Real(1e-12) * std::abs(value);
      if (pass == 0 && is_real) {
        rk.real.push_back(static_cast<double>(value.real()));
        T.col(column++) = eigen.eigenvectors().col(k).real();
      } else if (pass == 1 && !is_real && value.imag() > 0) {
        // Block of a pair: A (x + i y) = (alpha + i beta) (x + i y) becomes A [x, -y] = [x, -y]
        // [[alpha, -beta], [beta, alpha]].
        rk.pairs.emplace_back(static_cast<double>(value.real()), static_cast<double>(value.imag()));
        T.col(column++) = eigen.eigenvectors().col(k).real();
        T.col(column++) = -eigen.eigenvectors().col(k).imag();
      }
    }
  rk.T = T.cast<double>();
  rk.T_inverse = T.inverse().cast<double>();
}

} // namespace

RungeKutta make_runge_kutta(Family family, int stages) {
  RungeKutta rk;
  rk.family = family;
  rk.stages = stages;
  rk.order =
      family == Family::gauss ? 2 * stages : 2 * stages - (family == Family::radau_iia ? 1 : 2);
  const VectorL c = nodes(family, stages);
  const VectorL b = weights(c, moments(stages, 1));
  const MatrixL A = stage_matrix(family, c, b);
  const MatrixL inverse = A.inverse();
  transform(inverse, rk);
  rk.c = c.cast<double>();
  rk.b = b.cast<double>();
  rk.a = A.cast<double>();
  rk.a_inverse = inverse.cast<double>();
  rk.end = (inverse.transpose() * b).cast<double>();
  if (rk.stiffly_accurate()) {
    rk.end.setZero();
    rk.end[stages - 1] = 1.0;
  }
  // Embedded weights b^ with b^_0 = gamma0 at the start of the step and order s: sum b^_i P_k(c_i)
  // = m_k - gamma0 P_k(-1).
  const Real gamma0 =
      1 / static_cast<Real>(rk.real.empty() ? std::abs(rk.pairs.front()) : rk.real.front());
  VectorL m = moments(stages, 1);
  for (int k = 0; k < stages; ++k)
    m[k] -= gamma0 * (k % 2 == 0 ? 1 : -1);
  rk.error = (inverse.transpose() * (weights(c, m) - b)).cast<double>();
  rk.gamma0 = static_cast<double>(gamma0);
  return rk;
}

} // namespace hydrodae::integrate
