#pragma once
/// A function given by points, as measured: between them monotone where they are (Fritsch, Butland,
/// SIAM J. Sci. Stat. Comput. 5 (1984) 300-304), with one tangent everywhere, and straight beyond
/// both ends.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace hydrodae {

class Curve {
public:
  Curve() = default;

  /// @param x ascending, at least two points
  /// @param y as many
  Curve(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
    const std::size_t n = x_.size();
    slope_.assign(n, 0.0);
    std::vector<double> chord(n - 1);
    for (std::size_t i = 0; i + 1 < n; ++i)
      chord[i] = (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
    slope_.front() = chord.front();
    slope_.back() = chord.back();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double a = chord[i - 1], b = chord[i], left = x_[i] - x_[i - 1],
                   right = x_[i + 1] - x_[i], part = (left + 2.0 * right) / (3.0 * (left + right));
      slope_[i] = a * b > 0.0 ? a * b / (part * b + (1.0 - part) * a) : 0.0;
    }
    area_.assign(n, 0.0);
    for (std::size_t i = 0; i + 1 < n; ++i)
      area_[i + 1] = area_[i] + piece_area(i, 1.0);
  }

  bool empty() const { return x_.empty(); }

  /// Fault in such points; empty: none.
  static std::string_view fault(const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() != y.size())
      return "has not as many numbers as";
    if (x.size() == 1)
      return "needs two points or more, as does";
    for (std::size_t i = 1; i < x.size(); ++i)
      if (!(x[i] > x[i - 1]))
        return "must ascend, as the places of";
    return {};
  }

  template <class S> S operator()(const S& x) const {
    if (x < S(x_.front()))
      return S(y_.front()) + S(slope_.front()) * (x - S(x_.front()));
    if (x > S(x_.back()))
      return S(y_.back()) + S(slope_.back()) * (x - S(x_.back()));
    const std::size_t i = find([&](double knot) { return x < S(knot); });
    const double h = x_[i + 1] - x_[i];
    const S a = (x - S(x_[i])) / S(h), b = S(1) - a;
    return b * b * ((S(1) + S(2) * a) * S(y_[i]) + a * S(h * slope_[i])) +
           a * a * ((S(1) + S(2) * b) * S(y_[i + 1]) - b * S(h * slope_[i + 1]));
  }

  /// Derivative at x.
  template <class S> S slope(const S& x) const {
    if (x < S(x_.front()) || x > S(x_.back()))
      return S(x < S(x_.front()) ? slope_.front() : slope_.back());
    const std::size_t i = find([&](double knot) { return x < S(knot); });
    const double h = x_[i + 1] - x_[i];
    const S a = (x - S(x_[i])) / S(h), b = S(1) - a;
    return a * b * S(6.0 * (y_[i + 1] - y_[i]) / h) + b * (S(1) - S(3) * a) * S(slope_[i]) +
           a * (S(1) - S(3) * b) * S(slope_[i + 1]);
  }

  /// Integral from x_0 [units of x y].
  double area(double x) const {
    if (x < x_.front() || x > x_.back()) {
      const bool before = x < x_.front();
      const double y = before ? y_.front() : y_.back(),
                   slope = before ? slope_.front() : slope_.back(),
                   d = x - (before ? x_.front() : x_.back());
      return (before ? 0.0 : area_.back()) + d * (y + 0.5 * d * slope);
    }
    const std::size_t i = find([&](double knot) { return x < knot; });
    return area_[i] + piece_area(i, (x - x_[i]) / (x_[i + 1] - x_[i]));
  }

private:
  /// The piece that holds x; `below(knot)`: x < knot.
  template <class Below> std::size_t find(Below&& below) const {
    std::size_t low = 0, high = x_.size() - 1;
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (below(x_[middle]) ? high : low) = middle;
    }
    return low;
  }

  double piece_area(std::size_t i, double a) const {
    const double h = x_[i + 1] - x_[i], a2 = a * a, a3 = a2 * a, a4 = a3 * a;
    return h *
           (y_[i] * (a - a3 + 0.5 * a4) + h * slope_[i] * (0.5 * a2 - 2.0 / 3.0 * a3 + 0.25 * a4) +
            y_[i + 1] * (a3 - 0.5 * a4) + h * slope_[i + 1] * (0.25 * a4 - a3 / 3.0));
  }

  std::vector<double> x_, y_, slope_, area_;
};

} // namespace hydrodae
