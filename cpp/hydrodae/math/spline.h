#pragma once
/// Natural cubic spline through (x_i, y_i).

#include <algorithm>
#include <array>
#include <vector>

namespace hydrodae {

class CubicSpline {
public:
  CubicSpline() = default;

  /// `x` ascending, at least two points.
  CubicSpline(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
    // Second derivatives m: tridiagonal system by Thomas' algorithm, m = 0 at both ends.
    const std::size_t n = x_.size();
    m_.assign(n, 0.0);
    std::vector<double> upper(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double h0 = x_[i] - x_[i - 1], h1 = x_[i + 1] - x_[i];
      const double slope = (y_[i + 1] - y_[i]) / h1 - (y_[i] - y_[i - 1]) / h0;
      const double pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
      upper[i] = h1 / pivot;
      m_[i] = (6.0 * slope - h0 * m_[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 1;)
      m_[i] -= upper[i] * m_[i + 1];
  }

  /// Value, first and second derivative at `x` (the end pieces go on outside).
  std::array<double, 3> operator()(double x) const {
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
    const auto i = static_cast<std::size_t>(above - x_.begin());
    const double h = x_[i] - x_[i - 1], a = (x_[i] - x) / h, b = (x - x_[i - 1]) / h;
    return {a * y_[i - 1] + b * y_[i] +
                h * h / 6.0 * ((a * a * a - a) * m_[i - 1] + (b * b * b - b) * m_[i]),
            (y_[i] - y_[i - 1]) / h +
                h / 6.0 * ((1.0 - 3.0 * a * a) * m_[i - 1] + (3.0 * b * b - 1.0) * m_[i]),
            a * m_[i - 1] + b * m_[i]};
  }

  bool empty() const { return x_.empty(); }
  double front() const { return x_.front(); }
  double back() const { return x_.back(); }

private:
  std::vector<double> x_, y_, m_;
};

} // namespace hydrodae
