#include "hydrodae/events/locator.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace hydrodae::events {

namespace {

constexpr int most_degree = 16; ///< highest degree; beyond it Bernstein coefficients lose digits
constexpr int halvings = 20;    ///< halvings of a step: roots closer than 1e-6 of it count as one
constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Noise of Bernstein coefficients, relative to the largest sample
constexpr double noise = 4.0 * epsilon;

/// Chebyshev points of the second kind on [0, 1], and the matrix from values there to Bernstein
/// coefficients.
struct Basis {
  VectorX points;
  MatrixX to_bernstein;
};

Basis make_basis(int degree) {
  Basis out;
  out.points.resize(degree + 1);
  MatrixX bernstein(degree + 1, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    const double x = i == degree ? 1.0 : 0.5 - 0.5 * std::cos(pi * i / degree);
    out.points[i] = x;
    double choose = 1.0;
    for (int k = 0; k <= degree; ++k) {
      bernstein(i, k) = choose * std::pow(x, k) * std::pow(1.0 - x, degree - k);
      choose *= static_cast<double>(degree - k) / (k + 1);
    }
  }
  out.to_bernstein = bernstein.inverse();
  return out;
}

const Basis& basis_of(int degree) {
  static const std::vector<Basis> all = [] {
    std::vector<Basis> made(1);
    for (int n = 1; n <= most_degree; ++n)
      made.push_back(make_basis(n));
    return made;
  }();
  return all[static_cast<std::size_t>(std::clamp(degree, 1, most_degree))];
}

/// A polynomial on [from, to] by its Bernstein coefficients.
struct Piece {
  VectorX b;
  double from = 0.0, to = 1.0;

  /// De Casteljau's algorithm: the parts before and after x of [0, 1].
  std::array<Piece, 2> split(double x) const {
    const Index n = b.size();
    const double middle = from + x * (to - from);
    std::array<Piece, 2> out{Piece{VectorX(n), from, middle}, Piece{b, middle, to}};
    VectorX& right = out[1].b;
    for (Index k = 0; k < n; ++k) {
      out[0].b[k] = right[0];
      for (Index i = 0; i + 1 < n - k; ++i)
        right[i] = (1.0 - x) * right[i] + x * right[i + 1];
    }
    return out;
  }
  Piece before(double place) const { return split((place - from) / (to - from))[0]; }
  Piece after(double place) const { return split((place - from) / (to - from))[1]; }
};

/// First point where the polynomial, positive at its start, is seen to be negative.
std::optional<double> first_dip(const Piece& piece, int depth) {
  if ((piece.b.array() > 0.0).all())
    return std::nullopt;
  if (depth == 0)
    return piece.b.tail(1)[0] < 0.0 ? std::optional(piece.to) : std::nullopt;
  const std::array<Piece, 2> halves = piece.split(0.5);
  if (const auto dip = first_dip(halves[0], depth - 1))
    return dip;
  return first_dip(halves[1], depth - 1);
}

/// The lowest place of the polynomial, negative at its start, before it is positive again.
double lowest(const Piece& from) {
  constexpr int looks = 16;
  const auto end = first_dip({-from.b, from.from, from.to}, halvings);
  const Piece piece = end && *end < from.to ? from.before(*end) : from;
  double place = piece.from, least = piece.b[0];
  for (int k = 1; k <= looks; ++k) {
    const double x = piece.from + (piece.to - piece.from) * k / looks;
    if (const double value = piece.before(x).b.tail(1)[0]; value < least) {
      least = value;
      place = x;
    }
  }
  return place;
}

class Search {
public:
  Search(const Margins& margins, std::size_t count, double t0, double t1, int degree)
      : margins_(margins), basis_(basis_of(degree)), t0_(t0), t1_(t1), now_(count) {
    values_.resize(static_cast<Index>(count), basis_.points.size());
    for (Index i = 0; i < basis_.points.size(); ++i) {
      margins_(time_of(basis_.points[i]), now_);
      values_.col(i) = Eigen::Map<const VectorX>(now_.data(), values_.rows());
    }
  }

  std::optional<Root> first() {
    std::optional<Root> out;
    for (std::size_t k = 0; k < now_.size(); ++k)
      if (const auto root = of_margin(k)) {
        out = root;
        end_ = (root->time - t0_) / (t1_ - t0_);
      }
    return out;
  }

private:
  double time_of(double x) const { return x == 1.0 ? t1_ : t0_ + x * (t1_ - t0_); }

  double margin(std::size_t k, double x) {
    margins_(time_of(x), now_);
    return now_[k];
  }

  /// The first root of one margin before the earliest that is known.
  std::optional<Root> of_margin(std::size_t k) {
    const auto value = values_.row(static_cast<Index>(k));
    const VectorX& x = basis_.points;
    Index first = 0, last = 1; // samples: the first that is positive, the next that is not
    while (first < x.size() && !(value[first] > 0.0))
      ++first;
    if (first > 1 || first == x.size())
      return Root{k, t0_, t0_ + epsilon * std::max(std::abs(t0_), t1_ - t0_)};
    for (last = first + 1; last < x.size() && value[last] > 0.0;)
      ++last;
    const bool lost = last < x.size();
    const double stop = std::min(end_, lost ? x[last] : 1.0);
    if (const auto root = of_polynomial(k, x[first], stop))
      return root;
    if (!lost || x[last - 1] >= end_)
      return std::nullopt;
    if (x[last] <= end_)
      return between(k, x[last - 1], value[last - 1], x[last], value[last]);
    const double at_end = margin(k, end_);
    return at_end > 0.0 ? std::nullopt
                        : std::optional(between(k, x[last - 1], value[last - 1], end_, at_end));
  }

  /// Root of the polynomial in [start, stop] that the margin confirms.
  std::optional<Root> of_polynomial(std::size_t k, double start, double stop) {
    const auto values = values_.row(static_cast<Index>(k)).transpose();
    Piece piece{basis_.to_bernstein * values};
    piece.b.array() += noise * values.cwiseAbs().maxCoeff();
    if ((piece.b.array() > 0.0).all() || !(start < stop))
      return std::nullopt;
    if (stop < 1.0)
      piece = piece.split(stop)[0];
    if (start > 0.0)
      piece = piece.after(start);
    double seen = start;                                     // positive there
    for (Index tries = 0; tries < piece.b.size(); ++tries) { // it has no more roots
      const auto dip = first_dip(piece, halvings);
      if (!dip)
        break;
      const double at_dip = margin(k, *dip);
      if (!(at_dip > 0.0))
        return between(k, seen, margin(k, seen), *dip, at_dip);
      const double deep = *dip < piece.to ? lowest(piece.after(*dip)) : *dip;
      const double value = margin(k, deep);
      if (!(value > 0.0))
        return between(k, *dip, at_dip, deep, value);
      seen = deep;
      if (!(deep < piece.to))
        break;
      piece = piece.after(deep);
      piece.b[0] = std::max(piece.b[0], 0.0); // the margin is positive there
    }
    return std::nullopt;
  }

  /// Positive at a, not so at b: by Chandrupatla's method (Advances in Engineering Software 28
  /// (1997) 145), inverse quadratic interpolation where that is safe, else bisection.
  Root between(std::size_t k, double a, double at_a, double b, double at_b) {
    const double close = 2.0 * epsilon * std::max(std::abs(t1_) / (t1_ - t0_), 1.0);
    double part = 0.5; // of the way from a to b
    while (b - a > close) {
      const double x = a + part * (b - a), value = margin(k, x);
      const bool before = value > 0.0;
      // c is the end that x replaces, d the other one.
      const double c = before ? a : b, at_c = before ? at_a : at_b;
      const double d = before ? b : a, at_d = before ? at_b : at_a;
      const double xi = (x - d) / (c - d), phi = (value - at_d) / (at_c - at_d);
      double next = 0.5; // of the way from x to d
      if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
        next = value / (at_d - value) * at_c / (at_d - at_c) +
               (c - x) / (d - x) * value / (at_c - value) * at_d / (at_c - at_d);
      (before ? a : b) = x;
      (before ? at_a : at_b) = value;
      const double least = std::min(0.5, 0.5 * close / (b - a)); // so that both ends come near
      next = std::clamp(next, least, 1.0 - least);
      part = before ? next : 1.0 - next;
    }
    return {k, time_of(a), time_of(b)};
  }

  const Margins& margins_;
  const Basis& basis_;
  double t0_, t1_;
  std::vector<double> now_;
  MatrixX values_;   ///< (count, points)
  double end_ = 1.0; ///< end of the searched range, as part of the step
};

} // namespace

std::optional<Root> first_root(const Margins& margins, std::size_t count, double t0, double t1,
                               int degree) {
  if (count == 0 || !(t0 < t1))
    return std::nullopt;
  return Search(margins, count, t0, t1, degree).first();
}

} // namespace hydrodae::events
