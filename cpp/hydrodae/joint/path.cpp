#include "hydrodae/joint/path.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/math/spline.h"

namespace hydrodae::joint {

namespace {

/// Largest turn of the tangent from point to point [rad]
constexpr double sharpest = 60.0 * pi / 180.0;
constexpr double bent = 0.25; ///< least chord over arc of two neighbours
/// Least distance of two branches over the spacing h of samples. A point at distance e from the
/// curve is at most h/2 + e from a sample of its own branch; 2 h - e is more while e < 3/4 h.
constexpr double apart = 2.0;

/// Nodes and weights of Gauss and Legendre on [-1, 1].
constexpr std::array<double, 5> nodes = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                         0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, 5> weights = {0.2369268850561891, 0.4786286704993665,
                                           0.5688888888888889, 0.4786286704993665,
                                           0.2369268850561891};

std::vector<double> chord_lengths(const std::vector<Vector3>& points) {
  std::vector<double> s{0.0};
  for (std::size_t i = 1; i < points.size(); ++i)
    s.push_back(s.back() + (points[i] - points[i - 1]).norm());
  return s;
}

std::vector<CubicSpline> splines(const std::vector<double>& s, const std::vector<VectorX>& values) {
  std::vector<CubicSpline> out;
  for (Eigen::Index c = 0; c < values.front().size(); ++c) {
    std::vector<double> y;
    for (const VectorX& v : values)
      y.push_back(v[c]);
    out.emplace_back(s, y);
  }
  return out;
}

/// Unit tangents of the spline at its points.
std::vector<Vector3> tangents(const std::vector<double>& s, const std::vector<Vector3>& points) {
  const std::vector<CubicSpline> curve = splines(s, {points.begin(), points.end()});
  std::vector<Vector3> out;
  for (double x : s)
    out.push_back(Vector3(curve[0](x)[1], curve[1](x)[1], curve[2](x)[1]).normalized());
  return out;
}

} // namespace

std::optional<std::string> Path::flaw(const std::vector<Vector3>& points) {
  const auto number = [](std::size_t i) { return std::to_string(i + 1); };
  if (points.size() < 2)
    return "needs two points or more";
  const std::vector<double> s = chord_lengths(points);
  for (std::size_t i = 1; i < s.size(); ++i)
    if (!(s[i] - s[i - 1] > 1e-9 * s.back()))
      return "points " + number(i - 1) + " and " + number(i) + " are the same";
  const std::vector<Vector3> t = tangents(s, points);
  for (std::size_t i = 1; i < s.size(); ++i)
    if (!(std::acos(std::clamp(t[i].dot(t[i - 1]), -1.0, 1.0)) < sharpest))
      return "turns by more than 60 degrees from point " + number(i - 1) + " to point " +
             number(i) + "; give more points there";
  const Path path(points);
  double spacing = 0.0;
  for (std::size_t i = 1; i < path.samples_.size(); ++i)
    spacing = std::max(spacing, path.samples_[i].arc - path.samples_[i - 1].arc);
  for (const Sample& a : path.samples_)
    for (const Sample& b : path.samples_)
      if (b.arc > a.arc &&
          (b.point - a.point).norm() < std::min(bent * (b.arc - a.arc), apart * spacing))
        return "comes back near itself: " + number_text(a.arc) + " m and " + number_text(b.arc) +
               " m along it are only " + number_text((b.point - a.point).norm()) +
               " m apart, and a point that slides there could not distinguish them";
  return {};
}

Path::Path(const std::vector<Vector3>& points) : knots_(chord_lengths(points)) {
  const std::size_t n = points.size();
  // Normal vectors: the last one, made perpendicular to the tangent here.
  const std::vector<Vector3> t = tangents(knots_, points);
  std::vector<VectorX> values;
  Vector3 across = t.front().unitOrthogonal();
  for (std::size_t i = 0; i < n; ++i) {
    across = (across - across.dot(t[i]) * t[i]).normalized();
    VectorX v(9);
    v << points[i], across, t[i].cross(across);
    values.push_back(v);
  }
  const std::vector<CubicSpline> spline = splines(knots_, values);
  const auto straight = [&](std::size_t i) {
    Piece end;
    end.start = knots_[i];
    end.coefficient = {values[i], Vector9::Zero(), Vector9::Zero(), Vector9::Zero()};
    for (int c = 0; c < 3; ++c)
      end.coefficient[1][c] = spline[c](knots_[i])[1];
    return end;
  };
  pieces_.push_back(straight(0));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    Piece p;
    p.start = knots_[i];
    const double h = knots_[i + 1] - knots_[i];
    for (int c = 0; c < 9; ++c) {
      const std::array<double, 3> left = spline[c](knots_[i]), right = spline[c](knots_[i + 1]);
      p.coefficient[0][c] = left[0];
      p.coefficient[1][c] = left[1];
      p.coefficient[2][c] = 0.5 * left[2];
      p.coefficient[3][c] = (right[2] - left[2]) / (6.0 * h);
    }
    pieces_.push_back(p);
  }
  pieces_.push_back(straight(n - 1));
  samples_.push_back({0.0, 0.0, points.front()});
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (int k = 1; k <= per_piece; ++k) {
      const double s = knots_[i] + (knots_[i + 1] - knots_[i]) * k / per_piece;
      const double arc = arc_at(s);
      samples_.push_back({s, arc, jet<double>(s)[0].head<3>()});
    }
}

const Path::Piece& Path::piece(double s) const {
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), s);
  return pieces_[static_cast<std::size_t>(above - knots_.begin())];
}

/// Nearest sample, then Newton's method within its neighbourhood.
double Path::nearest(const Vector3& d) const {
  const Sample* best = &samples_.front();
  for (const Sample& sample : samples_)
    if ((d - sample.point).squaredNorm() < (d - best->point).squaredNorm())
      best = &sample;
  double s = best->s;
  const double reach = knots_.back() / 2.0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Jet<double> at = jet<double>(s);
    const Vector3 w = d - at[0].head<3>(), c1 = at[1].head<3>();
    const double speed2 = c1.squaredNorm(), D = speed2 - w.dot(at[2].head<3>());
    // Beyond the centre of curvature D is negative: a descent step.
    const double step = std::clamp(w.dot(c1) / (D > 0.1 * speed2 ? D : speed2), -reach, reach);
    s += step;
    if (std::abs(step) < 1e-14 * knots_.back())
      break;
  }
  return s;
}

double Path::arc_at(double s) const {
  const auto above = std::upper_bound(samples_.begin(), samples_.end(), s,
                                      [](double x, const Sample& sample) { return x < sample.s; });
  if (above == samples_.begin()) // straight: the speed is that at the end
    return s * jet<double>(0.0)[1].head<3>().norm();
  const Sample& from = *(above - 1);
  const double half = 0.5 * (s - from.s);
  double arc = from.arc;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    arc += half * weights[k] * jet<double>(from.s + half * (1.0 + nodes[k]))[1].head<3>().norm();
  return arc;
}

std::array<Vector3, 2> Path::at_arc(double arc) const {
  double s = arc / length() * knots_.back();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const double step = (arc - arc_at(s)) / jet<double>(s)[1].head<3>().norm();
    s += step;
    if (std::abs(step) < 1e-14 * knots_.back())
      break;
  }
  const Jet<double> at = jet<double>(s);
  return {at[0].head<3>(), at[1].head<3>().normalized()};
}

// grad s = c'/D, so with dD = (3 c'.c'' - w.c''') ds - c''.dd
//   hess s = (c'' c'^T + c' c''^T) / D^2 - (3 c'.c'' - w.c''') c' c'^T / D^3.
Matrix3 Path::place_hessian(const Place<double>& p) const {
  const Vector3 c1 = p.curve(1), c2 = p.curve(2);
  const double D_s = 3.0 * c1.dot(c2) - p.w.dot(p.curve(3));
  return (c2 * c1.transpose() + c1 * c2.transpose()) / (p.D * p.D) -
         D_s / (p.D * p.D * p.D) * c1 * c1.transpose();
}

// grad (n.w) = n + q grad s with q = n'.w - n.c', q_s = n''.w - 2 n'.c' - n.c'':
//   hess (n.w) = n' (grad s)^T + grad s n'^T + q_s grad s (grad s)^T + q hess s.
Matrix3 Path::across_hessian(int i, const Vector3& d) const {
  const Place<double> p = place<double>(d);
  const Vector3 n = p.normal(i, 0), n1 = p.normal(i, 1), n2 = p.normal(i, 2);
  const double q = n1.dot(p.w) - n.dot(p.curve(1));
  const double q_s = n2.dot(p.w) - 2.0 * n1.dot(p.curve(1)) - n.dot(p.curve(2));
  return n1 * p.gradient.transpose() + p.gradient * n1.transpose() +
         q_s * p.gradient * p.gradient.transpose() + q * place_hessian(p);
}

// arc' = |c'|, arc'' = c'.c'' / |c'|.
Matrix3 Path::arc_hessian(const Vector3& d) const {
  const Place<double> p = place<double>(d);
  const Vector3 c1 = p.curve(1);
  return c1.norm() * place_hessian(p) +
         c1.dot(p.curve(2)) / c1.norm() * p.gradient * p.gradient.transpose();
}

} // namespace hydrodae::joint
