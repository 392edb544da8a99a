#pragma once
/// Surface through values on a grid: bicubic Hermite polynomials with one continuous derivative.
/// Their slopes along x and y at the points are those of monotone cubics (Fritsch and Butland, SIAM
/// J. Sci. Stat. Comput. 5 (1984) 300), so that no hill or hollow appears between two points; the
/// twist there is zero. A plane is exact. Beyond the grid the surface goes on level from its edge.

#include <algorithm>
#include <vector>

#include "hydrodae/core/types.h"

namespace hydrodae {

/// Value of a surface with its derivatives.
template <class S> struct SurfacePoint {
  S value, x, y, xx, xy, yy;
};

class SmoothTable {
public:
  /// @param x, y   ascending, at least two each
  /// @param value  (n_x, n_y)
  SmoothTable(std::vector<double> x, std::vector<double> y, const MatrixX& value);

  template <class S> SurfacePoint<S> at(const S& x, const S& y) const {
    const Place<S> u = place(x_, x), v = place(y_, y);
    const Eigen::Matrix4d& c = cells_[u.cell * (y_.size() - 1) + v.cell];
    S p[4], by_u[4], by_uu[4]; // polynomials in v
    for (int k = 0; k < 4; ++k) {
      p[k] = S(c(0, k)) + u.s * (S(c(1, k)) + u.s * (S(c(2, k)) + u.s * S(c(3, k))));
      by_u[k] = S(c(1, k)) + u.s * (S(2.0 * c(2, k)) + u.s * S(3.0 * c(3, k)));
      by_uu[k] = S(2.0 * c(2, k)) + u.s * S(6.0 * c(3, k));
    }
    const auto sum = [&](const S* q) { return q[0] + v.s * (q[1] + v.s * (q[2] + v.s * q[3])); };
    const auto slope = [&](const S* q) {
      return q[1] + v.s * (S(2.0) * q[2] + v.s * (S(3.0) * q[3]));
    };
    const S a(u.per_length), b(v.per_length);
    return {sum(p),
            a * sum(by_u),
            b * slope(p),
            a * a * sum(by_uu),
            a * b * slope(by_u),
            b * b * (S(2.0) * p[2] + v.s * (S(6.0) * p[3]))};
  }

  /// Upper bound of the surface.
  double top() const { return top_; }

private:
  /// Cell of a coordinate, part of it, and the derivative of that part: 0 beyond the grid.
  template <class S> struct Place {
    std::size_t cell;
    S s;
    double per_length;
  };
  template <class S> static Place<S> place(const std::vector<double>& x, const S& at) {
    if (!(at > S(x.front())))
      return {0, S(0.0), 0.0};
    if (!(at < S(x.back())))
      return {x.size() - 2, S(1.0), 0.0};
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at,
                                        [](const S& a, double e) { return a < S(e); });
    const auto cell = static_cast<std::size_t>(above - x.begin()) - 1;
    const double per_length = 1.0 / (x[cell + 1] - x[cell]);
    return {cell, (at - S(x[cell])) * S(per_length), per_length};
  }

  std::vector<double> x_, y_;
  std::vector<Eigen::Matrix4d> cells_; ///< coefficients of u^i v^j, cell by cell along y
  double top_ = 0.0;
};

} // namespace hydrodae
