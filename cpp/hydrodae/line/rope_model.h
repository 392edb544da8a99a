#pragma once
/// Ropes over sheaves that turn freely, with one tension in all parts:
///
///   T = max(0, EA (l - L0) + D (l' - L0')) / L0     where l > L0, else 0 [N]
///
/// l: the straight parts and the arcs between them (rope_path.h).

#include <algorithm>
#include <vector>

#include "hydrodae/line/rope.h"
#include "hydrodae/line/rope_path.h"
#include "hydrodae/math/curve.h"

namespace hydrodae::line {

/// Change of unstretched length by a table, constant before and after it.
struct Winch {
  Curve table;
  double begin = 0.0, end = 0.0; ///< [s]

  Winch() = default;
  explicit Winch(const Rope& rope) {
    if (rope.winch_time.empty())
      return;
    table = Curve(rope.winch_time, rope.winch_length);
    begin = rope.winch_time.front();
    end = rope.winch_time.back();
  }
  bool winds() const { return !table.empty(); }
  /// Change of length and its rate.
  Dual at(double t) const {
    const double inside = std::clamp(t, begin, end);
    return table(Dual(inside, t == inside ? 1.0 : 0.0));
  }
};

/// Switching function of a rope: its strain, or T / EA if that is less (a damper that would push).
/// The rope pulls above 0.
template <class S> S tautness_of(const S& strain, const S& by_tension) {
  return strain > S(0) && by_tension < strain ? by_tension : strain;
}
/// @param side  side of the kink; 0: unknown
template <class S> bool rope_pulls(const S& tautness, double side) {
  return side != 0.0 ? side > 0.0 : tautness > S(0);
}

/// Path and tension of a rope.
template <class S> struct RopeState {
  std::array<RopeNode<S>, most_rope_nodes> nodes;
  RopePath<S> path;
  S length{0}, rate{0}, tension{0};   ///< l, l', T
  S tautness{0};                      ///< see tautness_of
  double free = 0.0, free_rate = 0.0; ///< L0, L0'
};

/// Rope model; its inputs are the places and velocities of its points, and of one more for each
/// sheave.
class RopeModel {
public:
  explicit RopeModel(const Rope& of)
      : rope(of), winch(of), length(of.free_length()), n_points(static_cast<int>(of.points.size())),
        width(3 * static_cast<int>(of.ends().size())) {}

  Rope rope;
  Winch winch;
  double length = 0.0; ///< unstretched length L0 without the winch [m]
  int n_points = 0, width = 0;

  /// @param held  change of the unstretched length [m]; side of the kink
  template <class S> void see(double t, const S* in, const double* held, RopeState<S>& now) const {
    see_nodes(in, in + width, now.nodes.data());
    lay_rope<S>(now.nodes.data(), n_points, now.path);
    measure(now);
    pull(t, held, now);
  }
  /// Writes the loads on the points.
  template <class S> void load(const RopeState<S>& now, S* out) const;
  template <class S> void see_nodes(const S* x, const S* v, RopeNode<S>* nodes) const;

private:
  template <class S> void measure(RopeState<S>& now) const;
  template <class S> void pull(double t, const double* held, RopeState<S>& now) const;
};

template <class S> void RopeModel::see_nodes(const S* x, const S* v, RopeNode<S>* nodes) const {
  const auto at = [](const S* from, int i) {
    return Vec3<S>(Eigen::Map<const Vec3<S>>(from + 3 * i));
  };
  for (int i = 0, more = n_points; i < n_points; ++i) {
    RopeNode<S>& node = nodes[i];
    node = {};
    node.place = at(x, i);
    node.velocity = at(v, i);
    if (!rope.has_sheave(static_cast<std::size_t>(i)))
      continue;
    node.radius = rope.radii[static_cast<std::size_t>(i)];
    const S size(node.radius);
    node.axis = (at(x, more) - node.place) / size;
    node.axis_rate = (at(v, more) - node.velocity) / size;
    ++more;
  }
}

/// Computes the length and its rate. The rate is that of the straight parts, because the points of
/// contact move along the rope.
template <class S> void RopeModel::measure(RopeState<S>& now) const {
  now.length = now.rate = S(0);
  for (int i = 0; i < now.path.n_spans; ++i) {
    const RopeSpan<S>& s = now.path.spans[i];
    const RopeNode<S>&from = now.nodes[s.from], &to = now.nodes[s.to];
    now.length += s.length + S(to.radius) * now.path.wrap[s.to];
    now.rate += dot<S>(s.e, contact_velocity(to, s.on) - contact_velocity(from, s.off));
  }
}

template <class S> void RopeModel::pull(double t, const double* held, RopeState<S>& now) const {
  now.free = length + held[0];
  now.free_rate = 0.0;
  if (winch.winds()) {
    const Dual at = winch.at(t);
    now.free = at.a + held[0];
    now.free_rate = at.b;
  }
  const S strain = (now.length - S(now.free)) / S(now.free);
  const S T =
      S(rope.stiffness) * strain + S(rope.damping) * (now.rate - S(now.free_rate)) / S(now.free);
  now.tautness = tautness_of(strain, T / S(rope.stiffness));
  now.tension = rope_pulls(now.tautness, held[1]) ? T : S(0);
}

/// Puts a force at a point of contact onto the two points of a sheave: its centre C and C + R a.
/// The moment about C is R a x F; the moment about the axis is zero.
/// zero.
template <class S>
void put_on_sheave(const RopeNode<S>& node, const Vec3<S>& rho, const Vec3<S>& force, S* at_centre,
                   S* at_helper) {
  Eigen::Map<Vec3<S>> centre(at_centre);
  centre += force;
  if (node.radius == 0.0)
    return;
  const Vec3<S> lever = cross(rho, force), couple = cross(lever, node.axis); // moment over R
  Eigen::Map<Vec3<S>> helper(at_helper);
  helper += couple;
  centre -= couple;
}

template <class S> void RopeModel::load(const RopeState<S>& now, S* out) const {
  std::fill_n(out, width, S(0));
  if (!(now.tension > S(0)))
    return;
  std::array<int, most_rope_nodes> helper;
  for (int i = 0, next = n_points; i < n_points; ++i) {
    helper[i] = 3 * next;
    next += rope.has_sheave(static_cast<std::size_t>(i)) ? 1 : 0;
  }
  const auto put = [&](int i, const Vec3<S>& rho, const Vec3<S>& force) {
    put_on_sheave<S>(now.nodes[i], rho, force, out + 3 * i, out + helper[i]);
  };
  for (int i = 0; i < now.path.n_spans; ++i) {
    const RopeSpan<S>& s = now.path.spans[i];
    put(s.from, s.off, now.tension * s.e);
    put(s.to, s.on, -now.tension * s.e);
  }
}

/// Schedules of the winches, known in advance.
std::vector<element::Schedule> winch_schedules(const std::vector<Rope>& ropes);

std::shared_ptr<const element::Elements> ropes_over_sheaves(const std::vector<Rope>& ropes);
std::shared_ptr<const element::Elements> ropes_with_friction(const std::vector<Rope>& ropes);

} // namespace hydrodae::line
