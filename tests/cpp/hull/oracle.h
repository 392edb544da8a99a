#pragma once
/// The load of hydrodae/hull/loads.h written a second time, triangle by triangle and without
/// anything shared or precomputed, for duals as well: the truth for values and gradients.

#include <vector>

#include "hydrodae/hull/loads.h"
#include "hydrodae/math/dual.h"

namespace hydrodae::tests {

/// Dynamic pressure at a point, elevation above it.
template <class S> struct WaveAt {
  S eta, pressure;
};

template <class S>
WaveAt<S> wave_at(const hull::Water& water, const std::vector<hull::Wave>& waves, double t,
                  const Vec3<S>& x) {
  using std::cos, std::sin, std::exp;
  const double d = water.depth;
  const auto angle = [&](const hull::Wave& w) -> S {
    return S(w.omega * t + w.phase) -
           S(w.wavenumber) * (S(std::cos(w.heading)) * x[0] + S(std::sin(w.heading)) * x[1]);
  };
  S eta(0);
  for (const hull::Wave& w : waves)
    eta += S(w.amplitude) * cos(angle(w));
  S s = x[2];
  if (water.stretching == hull::Stretching::vertical && x[2] > S(0))
    s = S(0);
  if (water.stretching == hull::Stretching::wheeler)
    s = std::isfinite(d) ? S((x[2] - eta) * S(d) / (S(d) + eta)) : S(x[2] - eta);
  S q(0);
  Vec3<S> u(S(0), S(0), S(0));
  for (const hull::Wave& w : waves) {
    const double k = w.wavenumber;
    S f = exp(S(k) * s), f_s = S(k) * f;
    if (std::isfinite(d)) { // cosh k(s+d) / cosh kd and its derivative
      const S up = exp(S(k) * (s + S(d))), down = S(1) / up;
      f = (up + down) / S(2 * std::cosh(k * d));
      f_s = S(k) * (up - down) / S(2 * std::cosh(k * d));
    }
    const S a(w.amplitude), c = cos(angle(w)), h(water.gravity / w.omega);
    q += a * f * c;
    u += Vec3<S>(a * h * S(k * std::cos(w.heading)) * f * c,
                 a * h * S(k * std::sin(w.heading)) * f * c, -(a * h * f_s * sin(angle(w))));
  }
  S p = S(water.density * water.gravity) * q;
  if (water.bernoulli)
    p -= S(0.5 * water.density) * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  return {eta, p};
}

/// A corner of a polygon: place in the world, level.
template <class S> struct OracleCorner {
  Vec3<S> x;
  S level;
};

template <class S> std::vector<OracleCorner<S>> below(const std::vector<OracleCorner<S>>& polygon) {
  std::vector<OracleCorner<S>> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const OracleCorner<S>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.level < S(0))
      out.push_back(a);
    if ((a.level < S(0)) != (b.level < S(0)))
      out.push_back({a.x + a.level / (a.level - b.level) * (b.x - a.x), S(0)});
  }
  return out;
}

/// Hydrostatic and dynamic load (rows 0..5, 6..11) at a pose that is moved by `by`: displacement
/// and rotation vector, whose value is zero.
template <class S>
Eigen::Matrix<S, 12, 1> oracle(const hull::Mesh& mesh, const hull::Water& water,
                               const std::vector<hull::Wave>& waves, const hull::Pose& pose,
                               double t, const Vec6<S>& by) {
  const Mat3<S> turn = Mat3<S>::Identity() + skew<S>(by.template tail<3>());
  const Mat3<S> R = turn * pose.rotation.cast<S>();
  const Vec3<S> r = pose.position.cast<S>() + by.template head<3>();
  const bool kink = !waves.empty() && water.stretching == hull::Stretching::vertical;
  Eigen::Matrix<S, 12, 1> load = Eigen::Matrix<S, 12, 1>::Zero();
  const auto add = [&](const std::vector<OracleCorner<S>>& polygon) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const std::array<Vec3<S>, 3> v{polygon[0].x, polygon[i].x, polygon[i + 1].x};
      const Vec3<S> weight = S(1.0 / 6) * cross<S>(v[1] - v[0], v[2] - v[0]);
      for (std::size_t m = 0; m < 3; ++m) {
        const Vec3<S> x = S(0.5) * (v[m] + v[(m + 1) % 3]);
        const Vec3<S> arm = cross<S>(x - r, weight);
        const S fixed = S(-water.density * water.gravity) * x[2];
        const S moving = waves.empty() ? S(0) : wave_at<S>(water, waves, t, x).pressure;
        load.template segment<3>(0) -= fixed * weight;
        load.template segment<3>(3) -= fixed * arm;
        load.template segment<3>(6) -= moving * weight;
        load.template segment<3>(9) -= moving * arm;
      }
    }
  };
  for (int i = 0; i < mesh.triangles.rows(); ++i) {
    std::vector<OracleCorner<S>> whole;
    for (int j = 0; j < 3; ++j) {
      const Vector3 X = mesh.vertices.row(mesh.triangles(i, j)).transpose();
      const Vec3<S> x = r + R * X.cast<S>();
      whole.push_back({x, x[2] - (waves.empty() ? S(0) : wave_at<S>(water, waves, t, x).eta)});
    }
    std::vector<OracleCorner<S>> wet = below(whole);
    if (!kink) {
      add(wet);
      continue;
    }
    for (double side : {1.0, -1.0}) {
      for (OracleCorner<S>& c : wet)
        c.level = S(side) * c.x[2];
      add(below(wet));
    }
  }
  return load;
}

/// Derivative of the whole load by the pose.
inline Matrix6 oracle_gradient(const hull::Mesh& mesh, const hull::Water& water,
                               const std::vector<hull::Wave>& waves, const hull::Pose& pose,
                               double t) {
  Matrix6 out;
  for (int j = 0; j < 6; ++j) {
    Vec6<Dual> by = Vec6<Dual>::Zero();
    by[j] = {0.0, 1.0};
    const auto load = oracle<Dual>(mesh, water, waves, pose, t, by);
    for (int i = 0; i < 6; ++i)
      out(i, j) = load[i].b + load[6 + i].b;
  }
  return out;
}

} // namespace hydrodae::tests
