#include "hydrodae/math/smooth_table.h"

#include <utility>

namespace hydrodae {

namespace {

/// Slopes of the monotone cubic through f at x.
VectorX monotone_slopes(const std::vector<double>& x, const VectorX& f) {
  const Index n = f.size();
  const auto h = [&](Index i) {
    return x[static_cast<std::size_t>(i + 1)] - x[static_cast<std::size_t>(i)];
  };
  const auto secant = [&](Index i) { return (f[i + 1] - f[i]) / h(i); };
  VectorX out(n);
  out[0] = secant(0);
  out[n - 1] = secant(n - 2);
  for (Index i = 1; i + 1 < n; ++i) {
    const double a = secant(i - 1), b = secant(i), before = h(i) * 2.0 + h(i - 1),
                 behind = h(i) + 2.0 * h(i - 1);
    out[i] = a * b > 0.0 ? (before + behind) / (before / a + behind / b) : 0.0;
  }
  return out;
}

} // namespace

SmoothTable::SmoothTable(std::vector<double> x, std::vector<double> y, const MatrixX& f)
    : x_(std::move(x)), y_(std::move(y)), top_(f.maxCoeff()) {
  MatrixX f_x(f.rows(), f.cols()), f_y(f.rows(), f.cols());
  for (Index j = 0; j < f.cols(); ++j)
    f_x.col(j) = monotone_slopes(x_, f.col(j));
  for (Index i = 0; i < f.rows(); ++i)
    f_y.row(i) = monotone_slopes(y_, f.row(i).transpose()).transpose();
  // Coefficients of a cubic from its values and slopes at 0 and 1.
  Eigen::Matrix4d hermite;
  hermite << 1, 0, 0, 0, 0, 0, 1, 0, -3, 3, -2, -1, 2, -2, 1, 1;
  for (Index i = 0; i + 1 < f.rows(); ++i)
    for (Index j = 0; j + 1 < f.cols(); ++j) {
      const double a = x_[static_cast<std::size_t>(i + 1)] - x_[static_cast<std::size_t>(i)],
                   b = y_[static_cast<std::size_t>(j + 1)] - y_[static_cast<std::size_t>(j)];
      Eigen::Matrix4d g = Eigen::Matrix4d::Zero();
      g.topLeftCorner<2, 2>() = f.block<2, 2>(i, j);
      g.bottomLeftCorner<2, 2>() = a * f_x.block<2, 2>(i, j);
      g.topRightCorner<2, 2>() = b * f_y.block<2, 2>(i, j);
      cells_.push_back(hermite * g * hermite.transpose());
      // The control points of a polynomial are bounds of it.
      const Eigen::Matrix2d reach =
          f.block<2, 2>(i, j) +
          (g.bottomLeftCorner<2, 2>().cwiseAbs() + g.topRightCorner<2, 2>().cwiseAbs()) / 3.0;
      top_ = std::max(top_, reach.maxCoeff());
    }
}

} // namespace hydrodae
