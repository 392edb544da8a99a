#pragma once
/// Ropes with friction on points and sheaves of bodies (capstan friction). Places with friction
/// divide the rope; each part j has its own tension and unstretched length:
///
///   T_j = max(0, EA e_j + D e_j'),   e_j = max(0, l_j - L_j) / L_j     strain
///   L_j = c_(j+1) - c_j                c: unstretched length before a place
///
/// A place sticks or slips; located events change its state. A place on a sheave is the middle of
/// the arc, which moves by s' over the sheave; the sheave is fixed to its body.
///
///   stick:  v = 0:  c' = s' / (1 + (e_b + e_a) / 2), a state
///           until e_a > E e_b or e_b > E e_a,   E = exp(mu phi)
///   slip:   e_a = E e_b (v > 0), or e_b = E e_a (v < 0), with which c follows from the lengths
///           until v = s' - c' (1 + (e_b + e_a) / 2) changes its sign
///
/// phi: angle of wrap; b, a: parts before and after the place; v [m/s]: speed of the rope over it,
/// towards the last point. Parts with slip between them form one run: their strains are r_j e, and
///
///   sum_j l_j / (1 + r_j e) = c_end - c_start
///
/// gives e, and with constant r also e'. The tensions thus have the capstan ratio at every instant,
/// no state is stiff, and the dissipation (T_a - T_b) v is >= 0. With D, the elastic part of the
/// tension decides on sticking.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hydrodae/line/rope_model.h"

namespace hydrodae::line {

/// Part of a rope between two places with friction, or an end.
template <class S> struct RopePart {
  S length{0}, rate{0}; ///< l, l'
  S ratio{1};           ///< r
  S strain{0};          ///< e
  S tension{0};         ///< T
};

/// Point or sheave with friction.
template <class S> struct RopePlace {
  S grip{1};           ///< exp(mu phi)
  S flow{0};           ///< s'
  S stretch{1};        ///< 1 + (e_b + e_a) / 2
  S before{0};         ///< c
  S before_rate{0};    ///< c' of a place that sticks
  bool touched = true; ///< false: the rope has left it, and its parts have one tension
  bool holds = false;  ///< true: it sticks
};

template <class S> struct CapstanState {
  RopeState<S> rope;       ///< path; its tension is not used
  S free{0}, free_rate{0}; ///< L0, L0'
  /// Angular velocity of sheaves with friction about their axes [rad/s]
  std::array<S, most_rope_nodes> spin;
  std::array<Vec3<S>, most_rope_nodes> across; ///< directions fixed on the sheaves, across the axes
  std::array<RopePart<S>, most_rope_nodes> parts;
  std::array<RopePlace<S>, most_rope_nodes> places;
};

/// State of one place: two signals of the law.
enum class Rub { stick = 0, forward = 1, backward = -1 };

class CapstanModel {
public:
  explicit CapstanModel(const Rope& of);

  /// Indices of the signals: the change of length, and (way, offset) of each place.
  static constexpr int way_at(int place) { return 1 + 2 * place; }
  static constexpr int offset_at(int place) { return 2 + 2 * place; }

  RopeModel base;
  std::vector<int> nodes; ///< nodes with friction
  int n_places() const { return static_cast<int>(nodes.size()); }

  /// @param z     (n_places,) c of places that stick, less the offset; null: no friction
  /// @param free  L0 and its rate without the change of length
  template <class S>
  void see(const S* in, const S* z, const double* held, const S& free, const S& free_rate,
           CapstanState<S>& now) const {
    look(in, now);
    now.free = free + S(held[0]);
    now.free_rate = free_rate;
    set_places(z, held, now);
    set_strains(now);
    pull(now);
  }
  template <class S>
  void see(double t, const S* in, const S* z, const double* held, CapstanState<S>& now) const {
    const Dual wound = winds() ? base.winch.at(t) : Dual(base.length);
    see<S>(in, z, held, S(wound.a), S(wound.b), now);
  }
  template <class S> void load(const CapstanState<S>& now, S* out) const;

  /// Slip speeds v (n_places,) [m/s]; 0 for places that stick.
  /// @param now  state at the same time
  void slips(double t, const double* in, const double* z, const double* held,
             const CapstanState<double>& now, double* v) const;
  bool winds() const { return base.winch.winds(); }

private:
  std::array<bool, most_rope_nodes> rubs_{};
  std::array<int, most_rope_nodes> axis_at_{}, spin_at_{}; ///< indices of the auxiliary points

  bool rubs(int node) const { return rubs_[static_cast<std::size_t>(node)]; }
  template <class S>
  Vec3<S> turning(const CapstanState<S>& now, int node, const Vec3<S>& rho) const {
    const RopeNode<S>& n = now.rope.nodes[node];
    return now.spin[node] * cross(n.axis, rho) - dot(rho, n.axis_rate) * n.axis;
  }
  template <class S>
  Vec3<S> contact(const CapstanState<S>& now, int node, const Vec3<S>& rho) const {
    const RopeNode<S>& n = now.rope.nodes[node];
    return n.velocity + S(n.radius) * turning(now, node, rho);
  }
  template <class S> void look(const S* in, CapstanState<S>& now) const;
  template <class S> void measure(CapstanState<S>& now) const;
  template <class S> void set_places(const S* z, const double* held, CapstanState<S>& now) const;
  template <class S> void set_strains(CapstanState<S>& now) const;
  template <class S> void pull(CapstanState<S>& now) const;
};

template <class S> void CapstanModel::look(const S* in, CapstanState<S>& now) const {
  RopeState<S>& rope = now.rope;
  const S *x = in, *v = in + base.width;
  base.see_nodes(x, v, rope.nodes.data());
  for (int i = 0; i < base.n_points; ++i) {
    now.spin[i] = S(0);
    if (spin_at_[i] < 0)
      continue;
    const RopeNode<S>& n = rope.nodes[i];
    const auto at = [&](const S* from) {
      return Vec3<S>(Eigen::Map<const Vec3<S>>(from + 3 * spin_at_[i]));
    };
    const S size(n.radius);
    now.across[i] = (at(x) - n.place) / size;
    now.spin[i] = dot<S>((at(v) - n.velocity) / size, cross(n.axis, now.across[i]));
  }
  lay_rope<S>(rope.nodes.data(), base.n_points, rope.path);
  measure(now);
}

/// Computes lengths of the parts, their rates, and the speeds of the places along the sheaves. The
/// part after a sheave that the rope has left has no length: it belongs to the part before.
template <class S> void CapstanModel::measure(CapstanState<S>& now) const {
  using std::exp;
  const RopePath<S>& path = now.rope.path;
  now.parts[0] = {};
  now.rope.length = S(0);
  int at = 0;
  const auto next = [&](int node) {
    RopePlace<S>& place = now.places[at] = {};
    place.touched = path.touched[node];
    place.grip = exp(S(base.rope.friction_at(static_cast<std::size_t>(node))) * path.wrap[node]);
    now.parts[++at] = {};
  };
  std::array<S, most_rope_nodes> moves;
  moves.fill(S(0));
  for (int k = 0; k < path.n_spans; ++k) {
    const RopeSpan<S>& s = path.spans[k];
    const RopeNode<S>&from = now.rope.nodes[s.from], &to = now.rope.nodes[s.to];
    const Vec3<S> dv = contact(now, s.to, s.on) - contact(now, s.from, s.off);
    const S arc = S(to.radius) * path.wrap[s.to];
    now.parts[at].length += s.length + (rubs(s.to) ? S(0.5) * arc : arc);
    now.parts[at].rate += dot<S>(s.e, dv);
    now.rope.length += s.length + arc;
    for (int i = s.from + 1; i < s.to; ++i)
      if (rubs(i))
        next(i);
    if (rubs(s.to)) {
      next(s.to);
      now.parts[at].length += S(0.5) * arc;
    }
    if ((rubs(s.from) && from.radius > 0.0) || (rubs(s.to) && to.radius > 0.0)) {
      const Contact<S> c(from, to, s);
      S turn_from, turn_to;
      c.solve(dot(dv, s.off) + dot<S>(c.d, turning(now, s.from, s.off)),
              dot(dv, s.on) + dot<S>(c.d, turning(now, s.to, s.on)), turn_from, turn_to);
      moves[s.from] += S(0.5 * from.radius) * turn_from;
      moves[s.to] += S(0.5 * to.radius) * turn_to;
    }
  }
  for (int p = 0; p < n_places(); ++p) {
    const int node = nodes[static_cast<std::size_t>(p)];
    if (!path.touched[node])
      continue;
    now.places[p].flow = moves[node];
    now.parts[p].rate += moves[node];
    now.parts[p + 1].rate -= moves[node];
  }
}

/// Sets the places that stick, and the ratios of strains to that of the first part since the last
/// place that sticks.
template <class S>
void CapstanModel::set_places(const S* z, const double* held, CapstanState<S>& now) const {
  for (int p = 0; p < n_places(); ++p) {
    RopePlace<S>& place = now.places[p];
    const double way = held[way_at(p)];
    place.holds = z && place.touched && way == 0.0;
    if (place.holds)
      place.before = z[p] + S(held[offset_at(p)]);
    const S& r = now.parts[p].ratio;
    now.parts[p + 1].ratio = place.holds            ? S(1)
                             : !z || !place.touched ? r
                             : way > 0.0            ? r * place.grip
                                                    : r / place.grip;
  }
}

/// Solves sum l_j / (1 + r_j e) = L over parts [first, last] for e by Newton's method from below,
/// along a convex curve; e = 0 for slack parts.
template <class S>
S strain_of_parts(const RopePart<S>* first, const RopePart<S>* last, const S& free) {
  constexpr int most = 200;
  if (!(free > S(0))) // the whole length has passed the place
    return S(std::numeric_limits<double>::quiet_NaN());
  S e(0);
  bool close = false;
  for (int i = 0; i < most; ++i) {
    S excess = -free, slope(0);
    for (const RopePart<S>* part = first; part <= last; ++part) {
      const S w = S(1) / (S(1) + part->ratio * e);
      excess += part->length * w;
      slope += part->length * part->ratio * w * w;
    }
    if (i == 0 && excess <= S(0))
      return S(0);
    const S step = excess / slope;
    e += step;
    if (close) // one more step than the value needs, for its derivative
      return e;
    close = !(step > S(1e-12) * e);
  }
  return S(std::numeric_limits<double>::quiet_NaN());
}

/// Visits runs of parts without sticking between them: act(first, last), ending at the places first
/// - 1 and last.
template <class S, class Act> void for_each_run(const CapstanState<S>& now, int n, Act&& act) {
  for (int first = 0, p = 0; p <= n; ++p)
    if (p == n || now.places[p].holds) {
      act(first, p);
      first = p + 1;
    }
}

template <class S> void CapstanModel::set_strains(CapstanState<S>& now) const {
  const int n = n_places();
  const auto before = [&](int part) { return part > 0 ? now.places[part - 1].before : S(0); };
  for_each_run(now, n, [&](int first, int last) {
    const S end = last < n ? now.places[last].before : now.free;
    const S e = strain_of_parts<S>(&now.parts[first], &now.parts[last], end - before(first));
    for (int j = first; j <= last; ++j) {
      now.parts[j].strain = now.parts[j].ratio * e;
      if (j < last)
        now.places[j].before = before(j) + now.parts[j].length / (S(1) + now.parts[j].strain);
    }
  });
  for (int p = 0; p < n; ++p) {
    RopePlace<S>& place = now.places[p];
    place.stretch = S(1) + S(0.5) * (now.parts[p].strain + now.parts[p + 1].strain);
    place.before_rate = place.holds ? place.flow / place.stretch : S(0);
  }
}

/// Computes the tensions from the strain and, with r constant, its rate.
template <class S> void CapstanModel::pull(CapstanState<S>& now) const {
  const int n = n_places();
  const S EA(base.rope.stiffness), D(base.rope.damping);
  for_each_run(now, n, [&](int first, int last) {
    S change = last < n ? -now.places[last].before_rate : -now.free_rate, slope(0);
    if (first > 0)
      change += now.places[first - 1].before_rate;
    for (int j = first; j <= last; ++j) {
      const RopePart<S>& part = now.parts[j];
      const S w = S(1) / (S(1) + part.strain);
      change += part.rate * w;
      slope += part.length * part.ratio * w * w;
    }
    const S strain_rate = change / slope;
    for (int j = first; j <= last; ++j) {
      RopePart<S>& part = now.parts[j];
      const S T = EA * part.strain + D * part.ratio * strain_rate;
      part.tension = part.strain == S(0) || T < S(0) ? S(0) : T;
    }
  });
}

/// Adds the loads. The third point of a sheave with friction takes the moment about its axis.
template <class S> void CapstanModel::load(const CapstanState<S>& now, S* out) const {
  std::fill_n(out, base.width, S(0));
  const auto put = [&](int i, const Vec3<S>& rho, const Vec3<S>& force) {
    const RopeNode<S>& node = now.rope.nodes[i];
    put_on_sheave<S>(node, rho, force, out + 3 * i, out + 3 * axis_at_[i]);
    if (spin_at_[i] < 0)
      return;
    const Vec3<S> turn = dot<S>(cross(rho, force), node.axis) * cross(node.axis, now.across[i]);
    Eigen::Map<Vec3<S>>(out + 3 * spin_at_[i]) += turn;
    Eigen::Map<Vec3<S>>(out + 3 * i) -= turn;
  };
  int at = 0;
  for (int k = 0; k < now.rope.path.n_spans; ++k) {
    const RopeSpan<S>& s = now.rope.path.spans[k];
    put(s.from, s.off, now.parts[at].tension * s.e);
    put(s.to, s.on, -now.parts[at].tension * s.e);
    for (int i = s.from + 1; i <= s.to; ++i)
      at += rubs(i) ? 1 : 0;
  }
}

} // namespace hydrodae::line
