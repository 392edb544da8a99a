#pragma once
/// Cardinal cubic splines on given places: functions of one number that blend tables.
///
///   w_m(x_n) = 1 if m = n, else 0;   sum_m w_m = 1;   sum_m x_m w_m = x
///
/// Two continuous derivatives; ends not-a-knot, so that a blend is exact for cubics (of two places
/// linear, of three a parabola). Beyond the ends they go on along their tangents.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/dual.h"

namespace hydrodae {

class CardinalSplines {
public:
  CardinalSplines() = default;

  /// @param places  ascending, two or more
  explicit CardinalSplines(std::vector<double> places);

  std::size_t size() const { return x_.size(); }
  double front() const { return x_.front(); }
  double back() const { return x_.back(); }

  /// Values of the functions at x, and their first derivatives, (size,) each.
  template <class S> void values(const S& x, S* w, S* slope) const {
    const S inside = x < S(front()) ? S(front()) : x > S(back()) ? S(back()) : x;
    const S beyond = x - inside;
    const std::size_t i = piece(inside);
    const double h = x_[i + 1] - x_[i];
    const S b = (inside - S(x_[i])) / S(h), a = S(1) - b;
    const S left = S(h * h / 6.0) * (a * a * a - a), right = S(h * h / 6.0) * (b * b * b - b),
            d_left = S(h / 6.0) * (S(1) - S(3) * a * a),
            d_right = S(h / 6.0) * (S(3) * b * b - S(1));
    for (std::size_t m = 0; m < size(); ++m) {
      w[m] = left * S(curvature(i, m)) + right * S(curvature(i + 1, m));
      slope[m] = d_left * S(curvature(i, m)) + d_right * S(curvature(i + 1, m));
    }
    w[i] += a;
    w[i + 1] += b;
    slope[i] -= S(1.0 / h);
    slope[i + 1] += S(1.0 / h);
    for (std::size_t m = 0; m < size(); ++m)
      w[m] += beyond * slope[m];
  }

  /// Second derivatives at x (size,); zero beyond the ends.
  void curvatures(double x, double* out) const;

private:
  double curvature(std::size_t place, std::size_t m) const {
    return curvatures_(static_cast<Eigen::Index>(place), static_cast<Eigen::Index>(m));
  }
  template <class S> std::size_t piece(const S& x) const {
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x,
                                        [](const S& u, double v) { return u < S(v); });
    return static_cast<std::size_t>(above - x_.begin()) - 1;
  }

  std::vector<double> x_;
  MatrixX curvatures_; ///< (place, m): w_m'' at the places
};

} // namespace hydrodae
