#pragma once
/// Path of a taut rope over points and sheaves: straight parts, and arcs on the sheaves.
///
///   X = C + R rho,   tau = a x rho,   e . rho = 0,   e . tau > 0      at the ends of each arc
///
/// C, R: centre and radius of a sheave; a: its axis, which the rope circles by the right-hand rule;
/// rho: direction from the centre to the point of contact X; e: direction of the straight part. A
/// point is a sheave without radius. Straight parts may leave the plane of a sheave by a small
/// angle f (fleet angle); energy is kept up to a part f^2 of the energy of the rope that runs on or
/// off.

#include <array>
#include <cmath>
#include <cstddef>

#include "hydrodae/math/rotation.h"

namespace hydrodae::line {

inline constexpr int most_rope_nodes = 20;

/// Point of the rope, or sheave.
template <class S> struct RopeNode {
  double radius = 0.0;
  Vec3<S> place = Vec3<S>::Zero(), velocity = Vec3<S>::Zero();
  Vec3<S> axis = Vec3<S>::Zero(), axis_rate = Vec3<S>::Zero(); ///< a, a'
};

/// Straight part from one node to another.
template <class S> struct RopeSpan {
  int from = 0, to = 0;
  Vec3<S> e;
  S length;
  Vec3<S> off, on; ///< rho at the ends on `from` and `to`; zero at points
};

template <class S> struct RopePath {
  std::array<RopeSpan<S>, most_rope_nodes> spans;
  int n_spans = 0;
  std::array<S, most_rope_nodes> wrap;       ///< angle of wrap [rad]
  std::array<bool, most_rope_nodes> touched; ///< true if the rope touches the node
};

/// Velocity of the contact point of a sheave that turns freely about its axis.
template <class S> Vec3<S> contact_velocity(const RopeNode<S>& node, const Vec3<S>& rho) {
  return node.velocity - S(node.radius) * dot(rho, node.axis_rate) * node.axis;
}

/// Direction rho of the tangent from a sheave to `target` (leaves), or from there to the sheave;
/// NaN if the target is inside.
template <class S> Vec3<S> touching(const RopeNode<S>& sheave, const Vec3<S>& target, bool leaves) {
  using std::sqrt;
  const Vec3<S> d = target - sheave.place;
  const Vec3<S> p = d - dot(sheave.axis, d) * sheave.axis;
  const S square = dot(p, p), R(sheave.radius), t = sqrt(square - R * R);
  return (R * p + (leaves ? -t : t) * cross(sheave.axis, p)) / square;
}

/// Contact conditions g = (d . rho_a, d . rho_b), d = X_b - X_a, and their solution by rotations of
/// both rho about the axes: M turn = -g; a point does not rotate.
template <class S> struct Contact {
  Vec3<S> d, tau_a, tau_b;
  S m[2][2];

  Contact(const RopeNode<S>& a, const RopeNode<S>& b, const RopeSpan<S>& s)
      : d(b.place + S(b.radius) * s.on - a.place - S(a.radius) * s.off),
        tau_a(cross(a.axis, s.off)), tau_b(cross(b.axis, s.on)) {
    const bool at_a = a.radius > 0.0, at_b = b.radius > 0.0;
    m[0][0] = at_a ? dot(d, tau_a) : S(1);
    m[0][1] = at_a ? S(b.radius) * dot(tau_b, s.off) : S(0);
    m[1][0] = at_b ? S(-a.radius) * dot(tau_a, s.on) : S(0);
    m[1][1] = at_b ? dot(d, tau_b) : S(1);
  }
  void solve(const S& g_a, const S& g_b, S& turn_a, S& turn_b) const {
    const S det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    turn_a = (m[0][1] * g_b - m[1][1] * g_a) / det;
    turn_b = (m[1][0] * g_a - m[0][0] * g_b) / det;
  }
};

template <class S> void turn_about(const Vec3<S>& tau, const S& angle, Vec3<S>& rho) {
  using std::cos;
  using std::sin;
  rho = cos(angle) * rho + sin(angle) * tau;
}

/// Finds the straight part between two nodes, by Newton's method if both are sheaves.
template <class S> void span_between(const RopeNode<S>& a, const RopeNode<S>& b, RopeSpan<S>& s) {
  using std::sqrt;
  constexpr int newton_steps = 6;
  s.off = s.on = Vec3<S>::Zero();
  for (int pass = 0; pass < 2; ++pass) {
    if (a.radius > 0.0)
      s.off = touching<S>(a, b.place + S(b.radius) * s.on, true);
    if (b.radius > 0.0)
      s.on = touching<S>(b, a.place + S(a.radius) * s.off, false);
  }
  for (int i = 0; a.radius > 0.0 && b.radius > 0.0 && i < newton_steps; ++i) {
    const Contact<S> c(a, b, s);
    S turn_a, turn_b;
    c.solve(dot(c.d, s.off), dot(c.d, s.on), turn_a, turn_b);
    turn_about(c.tau_a, turn_a, s.off);
    turn_about(c.tau_b, turn_b, s.on);
  }
  const Vec3<S> d = b.place + S(b.radius) * s.on - a.place - S(a.radius) * s.off;
  s.length = sqrt(dot(d, d));
  s.e = d / s.length;
}

/// Angle from `a` to `b` about `axis`, in [-pi/2, 3 pi/2): negative if the rope has left the
/// sheave.
template <class S> S angle_about(const Vec3<S>& axis, const Vec3<S>& a, const Vec3<S>& b) {
  using std::atan2;
  const S angle = atan2(dot(cross(a, b), axis), dot(a, b));
  return angle < S(-0.5 * pi) ? angle + S(2.0 * pi) : angle;
}

/// Angle between two directions, in [0, pi]. At both ends of that range it has no derivative; zero
/// is taken, the mean of the derivatives around.
template <class S> S angle_between(const Vec3<S>& a, const Vec3<S>& b) {
  using std::atan2;
  using std::sqrt;
  const Vec3<S> c = cross(a, b);
  const S square = dot(c, c);
  if (square > S(0))
    return atan2(sqrt(square), dot(a, b));
  return dot(a, b) < S(0) ? S(pi) : S(0);
}

/// Lays the path over n nodes, without those that the rope has left.
template <class S> void lay_rope(const RopeNode<S>* nodes, int n, RopePath<S>& path) {
  path.touched.fill(true);
  path.wrap.fill(S(0));
  for (bool whole = false; !whole;) {
    path.n_spans = 0;
    for (int from = 0, to = 1; to < n; ++to)
      if (path.touched[to]) {
        RopeSpan<S>& s = path.spans[path.n_spans++];
        s.from = from;
        s.to = to;
        span_between(nodes[from], nodes[to], s);
        from = to;
      }
    whole = true;
    for (int k = 0; k + 1 < path.n_spans && whole; ++k) {
      const RopeSpan<S>&before = path.spans[k], &after = path.spans[k + 1];
      const auto i = static_cast<std::size_t>(after.from);
      const bool sheave = nodes[i].radius > 0.0;
      const S angle = sheave ? angle_about(nodes[i].axis, before.on, after.off)
                             : angle_between(before.e, after.e);
      path.wrap[i] = angle;
      if (path.wrap[i] < S(0)) {
        path.wrap[i] = S(0);
        path.touched[i] = false;
        whole = false;
      }
    }
  }
}

} // namespace hydrodae::line
