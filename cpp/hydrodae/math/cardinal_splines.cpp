#include "hydrodae/math/cardinal_splines.h"

#include <Eigen/LU>
#include <utility>

namespace hydrodae {

// h_i M_i-1 + 2 (h_i + h_i+1) M_i + h_i+1 M_i+1 = 6 (slope right - slope left) at inner places,
// with M = w''; at the ends the third derivative goes through the second and the last but one
// place, of three places M is the same everywhere.
CardinalSplines::CardinalSplines(std::vector<double> places) : x_(std::move(places)) {
  const auto n = static_cast<Eigen::Index>(x_.size());
  const auto h = [&](Eigen::Index i) {
    return x_[static_cast<std::size_t>(i + 1)] - x_[static_cast<std::size_t>(i)];
  };
  MatrixX by_curvature = MatrixX::Zero(n, n), by_value = MatrixX::Zero(n, n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    by_curvature.row(i).segment<3>(i - 1) << h(i - 1), 2.0 * (h(i - 1) + h(i)), h(i);
    by_value.row(i).segment<3>(i - 1) << 6.0 / h(i - 1), -6.0 / h(i - 1) - 6.0 / h(i), 6.0 / h(i);
  }
  const auto end = [&](Eigen::Index row, Eigen::Index first) {
    if (n == 2)
      by_curvature(row, row) = 1.0;
    else if (n == 3)
      by_curvature.row(row).segment<2>(row == 0 ? 0 : 1) << 1.0, -1.0;
    else
      by_curvature.row(row).segment<3>(first) << h(first + 1), -h(first) - h(first + 1), h(first);
  };
  end(0, 0);
  end(n - 1, n - 3);
  curvatures_ = by_curvature.partialPivLu().solve(by_value);
}

void CardinalSplines::curvatures(double x, double* out) const {
  std::fill_n(out, size(), 0.0);
  if (x < front() || x > back())
    return;
  const std::size_t i = piece(x);
  const double b = (x - x_[i]) / (x_[i + 1] - x_[i]);
  for (std::size_t m = 0; m < size(); ++m)
    out[m] = (1.0 - b) * curvature(i, m) + b * curvature(i + 1, m);
}

} // namespace hydrodae
