#pragma once
/// Ropes over sheaves, and over points and sheaves with friction. Between two places with friction
/// the tension is one:
///
///   T_k = max(0, EA (l_k - L_k) + D (l_k' - L_k')) / L_k     where l_k > L_k, else 0 [N]
///   T_(k+1) = exp(mu phi) T_k + c EA v        slip towards the last point, v > 0 [m/s]
///   T_k = exp(mu phi) T_(k+1) - c EA v        the other way, v < 0
///   v = 0                                     between these       (Euler and Eytelwein)
///
/// phi: angle of wrap, c: slip_viscosity. l_k ends in the middle of an arc; what rope passes there
/// is v, and what is laid on or comes off as the arc moves over the sheave. Half of an arc has the
/// tension of either side.

#include <algorithm>
#include <vector>

#include "hydrodae/element/rope.h"
#include "hydrodae/element/rope_path.h"
#include "hydrodae/math/curve.h"

namespace hydrodae::element {

/// Unstretched length by a table; it stands before and after it.
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
  /// Length and its rate.
  Dual at(double t) const {
    const double inside = std::clamp(t, begin, end);
    return table(Dual(inside, t == inside ? 1.0 : 0.0));
  }
};

/// What friction cuts a rope into, one part more than places with friction.
template <class S> struct RopeParts {
  std::array<S, most_rope_nodes> length, rate;  ///< l; l' as if nothing slipped [m/s]
  std::array<S, most_rope_nodes> free, tension; ///< L, T
  std::array<S, most_rope_nodes> laid;          ///< what passes each place without slip [m/s]
  std::array<int, most_rope_nodes> first, last; ///< part in which each span begins, and ends
  std::array<int, most_rope_nodes> node;        ///< of each place with friction
  int n = 0;
  double free_rate = 0.0; ///< L0'

  S whole() const {
    S sum(0);
    for (int k = 0; k < n; ++k)
      sum += length[k];
    return sum;
  }
};

/// What a rope sees: places and velocities of its points and of two more for each sheave, then what
/// has passed each place with friction, and the slips.
template <class S> struct RopeState {
  std::array<RopeNode<S>, most_rope_nodes> nodes;
  RopePath<S> path;
  RopeParts<S> parts;
};

class RopeModel {
public:
  explicit RopeModel(const Rope& rope);

  Rope rope;
  Winch winch;
  double length = 0.0;      ///< L0 in the reference pose [m]
  std::vector<double> free; ///< of its parts
  int n_points = 0, n_friction = 0, width = 0;

  /// Where it runs, and how long its parts are.
  template <class S> void place(const S* in, RopeState<S>& now) const {
    see_nodes(in, in + width, now.nodes.data());
    lay_rope<S>(now.nodes.data(), n_points, rope.turns.empty() ? nullptr : rope.turns.data(),
                now.path);
    measure(now);
    if (n_friction > 0)
      lay_on(now);
  }
  /// Tensions too. @param change  of the unstretched length [m]
  template <class S> void see(double t, const S* in, double change, RopeState<S>& now) const {
    place(in, now);
    pull(t, in, change, now.parts);
  }
  /// Loads on the points, and what the unknowns answer.
  template <class S> void load(const RopeState<S>& now, const S* in, S* out) const;

  template <class S> const S* slip(const S* in) const { return in + 2 * width + n_friction; }

private:
  template <class S> void see_nodes(const S* x, const S* v, RopeNode<S>* nodes) const;
  template <class S> void measure(RopeState<S>& now) const;
  template <class S> void lay_on(RopeState<S>& now) const;
  template <class S> void pull(double t, const S* in, double change, RopeParts<S>& parts) const;
  template <class S> void rub(const RopeState<S>& now, int place, const S& v, S* out) const;
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
    if (!rope.has_sheave(i))
      continue;
    node.radius = rope.radii[i];
    const S size(node.radius);
    node.axis = (at(x, more) - node.place) / size;
    node.axis_rate = (at(v, more) - node.velocity) / size;
    node.across = (at(x, more + 1) - node.place) / size;
    node.spin = dot<S>(at(v, more + 1) - node.velocity, cross(node.axis, node.across)) / size;
    more += 2;
  }
}

/// Lengths of the parts, and their rates.
template <class S> void RopeModel::measure(RopeState<S>& now) const {
  RopeParts<S>& parts = now.parts;
  parts.length.fill(S(0));
  parts.rate.fill(S(0));
  int k = 0;
  for (int i = 0; i < now.path.n_spans; ++i) {
    const RopeSpan<S>& s = now.path.spans[i];
    const RopeNode<S>&from = now.nodes[s.from], &to = now.nodes[s.to];
    const Vec3<S> start = from.place + S(from.radius) * s.off;
    parts.first[i] = k;
    parts.rate[k] += dot<S>(s.e, contact_velocity(to, s.on, rope.has_friction(s.to)) -
                                     contact_velocity(from, s.off, rope.has_friction(s.from)));
    S used(0);
    for (int left = s.from + 1; left < s.to; ++left) // cut beside what it does not touch
      if (rope.has_friction(left)) {
        const S cut = dot<S>(now.nodes[left].place - start, s.e) - used;
        parts.length[k] += cut;
        used += cut;
        parts.node[k++] = left;
      }
    parts.last[i] = k;
    const S arc = S(to.radius) * now.path.wrap[s.to];
    parts.length[k] += s.length - used;
    if (!rope.has_friction(s.to)) {
      parts.length[k] += arc;
      continue;
    }
    parts.length[k] += S(0.5) * arc;
    parts.node[k++] = s.to;
    parts.length[k] += S(0.5) * arc;
  }
  parts.n = k + 1;
}

/// What is laid on the sheaves with friction, or comes off, as their arcs move over them.
template <class S> void RopeModel::lay_on(RopeState<S>& now) const {
  now.parts.laid.fill(S(0));
  for (int i = 0; i < now.path.n_spans; ++i) {
    RopeSpan<S>& s = now.path.spans[i];
    turn_rates(now.nodes[s.from], now.nodes[s.to], s);
  }
  for (int i = 1; i < now.path.n_spans; ++i) {
    const RopeSpan<S>&before = now.path.spans[i - 1], &after = now.path.spans[i];
    const RopeNode<S>& node = now.nodes[after.from];
    if (node.radius > 0.0 && rope.has_friction(after.from))
      now.parts.laid[now.parts.first[i] - 1] =
          S(-node.radius) * (S(0.5) * (before.on_rate + after.off_rate) - node.spin);
  }
}

template <class S>
void RopeModel::pull(double t, const S* in, double change, RopeParts<S>& parts) const {
  double wound = change;
  parts.free_rate = 0.0;
  if (winch.winds()) {
    const Dual at = winch.at(t);
    wound += at.a - length;
    parts.free_rate = at.b;
  }
  const S *passed = in + 2 * width, *v = slip(in);
  for (int k = 0; k < parts.n; ++k) {
    S L(free[k] + (k == 0 ? wound : 0.0)), rate(k == 0 ? parts.free_rate : 0.0);
    if (k > 0) {
      L += passed[k - 1];
      rate += v[k - 1];
    }
    if (k < n_friction) {
      L -= passed[k];
      rate -= v[k];
    }
    const S stretch = parts.length[k] - L;
    S T(0);
    if (stretch > S(0))
      T = (S(rope.stiffness) * stretch + S(rope.damping) * (parts.rate[k] - rate)) / L;
    parts.free[k] = L;
    parts.tension[k] = T > S(0) ? T : S(0);
  }
}

/// A force at a point of contact, on the three points that stand for a sheave: at its centre C,
/// C + R a and C + R b, with the moment R a x F_1 + R b x F_2. Without friction it has none about
/// the axis.
template <class S>
void put_on_sheave(const RopeNode<S>& node, const Vec3<S>& rho, bool rough, const Vec3<S>& force,
                   S* at_centre, S* at_helpers) {
  Eigen::Map<Vec3<S>> centre(at_centre);
  centre += force;
  if (node.radius == 0.0)
    return;
  const Vec3<S> lever = cross(rho, force), f_1 = cross(lever, node.axis); // moment over R
  const Vec3<S> f_2 = (rough ? dot(lever, node.axis) : S(0)) * cross<S>(node.axis, node.across);
  Eigen::Map<Vec3<S>> first(at_helpers), second(at_helpers + 3);
  first += f_1;
  second += f_2;
  centre -= f_1 + f_2;
}

template <class S> void RopeModel::load(const RopeState<S>& now, const S* in, S* out) const {
  std::fill_n(out, width + 2 * n_friction, S(0));
  std::array<int, most_rope_nodes> helper;
  for (int i = 0, next = n_points; i < n_points; ++i) {
    helper[i] = 3 * next;
    next += rope.has_sheave(i) ? 2 : 0;
  }
  const auto put = [&](int i, const Vec3<S>& rho, const Vec3<S>& force) {
    put_on_sheave<S>(now.nodes[i], rho, rope.has_friction(i), force, out + 3 * i, out + helper[i]);
  };
  for (int i = 0; i < now.path.n_spans; ++i) {
    const RopeSpan<S>& s = now.path.spans[i];
    const S T =
        S(0.5) * (now.parts.tension[now.parts.first[i]] + now.parts.tension[now.parts.last[i]]);
    if (!(T > S(0)))
      continue;
    put(s.from, s.off, T * s.e);
    put(s.to, s.on, -T * s.e);
  }
  for (int j = 0; j < n_friction; ++j)
    rub(now, j, slip(in)[j], out + width);
}

/// What passes a place with friction, and what is to be zero for its slip v.
template <class S>
void RopeModel::rub(const RopeState<S>& now, int place, const S& v, S* out) const {
  using std::exp;
  const RopeParts<S>& parts = now.parts;
  const double over_stiffness = 1.0 / rope.stiffness;
  const S before = S(over_stiffness) * parts.tension[place],
          after = S(over_stiffness) * parts.tension[place + 1];
  out[place] = v + parts.laid[place] / (S(1) + S(0.5) * (before + after));
  const int node = parts.node[place];
  const S ratio = exp(S(rope.friction[node]) * now.path.wrap[node]);
  S& to_vanish = out[n_friction + place];
  to_vanish = S(-rope.slip_viscosity) * v;
  if (after > ratio * before)
    to_vanish += after - ratio * before;
  else if (before > ratio * after)
    to_vanish -= before - ratio * after;
}

/// What the winches do, known ahead.
std::vector<Schedule> winch_schedules(const std::vector<Rope>& ropes);

std::shared_ptr<const Elements> ropes_over_sheaves(const std::vector<Rope>& ropes);

} // namespace hydrodae::element
