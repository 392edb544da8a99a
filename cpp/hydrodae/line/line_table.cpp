#include "hydrodae/line/line_table.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "hydrodae/line/triples.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define HYDRODAE_X86 1
#endif

namespace hydrodae::line {

namespace {

/// Columns of LineTable::segments and LineTable::nodes.
namespace seg {
enum { length, per_length, stiffness, damping, slack, n };
}
namespace node {
enum {
  weight,
  mass,
  drag,
  drag_axial,
  mass_body,
  mass_axial,
  lift,
  fluid,       ///< mass under the acceleration of the water
  fluid_axial, ///< additional mass along the line
  bed_height,
  bed_width,
  bed_stiffness,
  bed_damping,
  friction,
  n
};
} // namespace node

/// Columns of LineArrays; for vectors, the first of three. Values of segment k are in row k + 1,
/// between zeros.
namespace at_ {
enum {
  force = 0,
  place = 3,
  velocity = 6,
  pull = 9,
  span = 12,
  direction = 15,
  before = 18,
  behind = 21,
  acceleration = 24,
  water = 27,
  water_rate = 30,
  elevation = 33,
  wet,
  own_mass,
  inverse_length,
  bed,
  bed_x,
  bed_y,
  n
};
}

template <class S> HYDRODAE_PART Triples<S> triples(LineArrays<S>& arrays, int column) {
  return {arrays.column(column), arrays.column(column + 1), arrays.column(column + 2)};
}

/// Copies places and velocities, node by node in the states, into arrays.
template <class S>
HYDRODAE_PART void spread(const LineView<S>& at, const Triples<S>& x, const Triples<S>& v) {
  const int n = at.m.n(), last = at.m.n_unknown();
  const S* z = at.z;
  for (int i = 1; i <= last; ++i, z += 6) {
    x.put(i, {z[0], z[1], z[2]});
    v.put(i, {z[3], z[4], z[5]});
  }
  x.put(0, {at.x[0], at.x[1], at.x[2]});
  v.put(0, {at.v[0], at.v[1], at.v[2]});
  if (!at.m.free_end) {
    x.put(n, {at.x[3], at.x[4], at.x[5]});
    v.put(n, {at.v[3], at.v[4], at.v[5]});
  }
}

/// Computes spans and pulls of the segments, rows 1 .. N.
template <bool damps_slack, bool curved, class S>
HYDRODAE_PART void pull_segments(const LineTable& table, int n, LineArrays<S>& arrays) {
  using std::sqrt;
  const Triples<S> x = triples(arrays, at_::place), v = triples(arrays, at_::velocity),
                   pull = triples(arrays, at_::pull), span = triples(arrays, at_::span);
  S* inverse = arrays.column(at_::inverse_length);
  const double *length = table.segments.col(seg::length).data(),
               *per_length = table.segments.col(seg::per_length).data(),
               *stiffness = table.segments.col(seg::stiffness).data(),
               *damping = table.segments.col(seg::damping).data(),
               *slack = table.segments.col(seg::slack).data();
#pragma GCC ivdep
  for (int k = 0; k < n; ++k) {
    const Triple<S> d = x[k + 1] - x[k];
    const S l = sqrt(dot(d, d)), per_l = S(1) / l;
    const S rate = per_l * dot(d, v[k + 1] - v[k]);
    const Plus<S> s = plus<S>((l - S(length[k])) * S(per_length[k]), slack[k]);
    const S by = damps_slack ? S(1) : s.slope;
    S pulled = s.value;
    if constexpr (curved)
      if (const Curve* curve = table.curves[static_cast<std::size_t>(k)].get())
        pulled = (*curve)(pulled);
    const S tension = S(stiffness[k]) * pulled + S(damping[k]) * rate * by;
    span.put(k + 1, d);
    pull.put(k + 1, (tension * per_l) * d);
    inverse[k + 1] = per_l;
  }
  pull.clear(0);
  pull.clear(n + 1);
  span.clear(0);
  span.clear(n + 1);
}

/// Removes a parted segment: it pulls nothing and gives no direction, unless it is the only one.
template <class S>
HYDRODAE_PART void part(const LineView<S>& at, const Triples<S>& pull, const Triples<S>& span) {
  const int k = at.parted, n = at.m.n();
  if (k < 0)
    return;
  pull.clear(k + 1);
  if (k == 0)
    span.put(0, span[1]);
  if (k + 1 == n)
    span.put(n + 1, span[n]);
  span.clear(k + 1);
}

/// Adds the forces of bending: -grad of c (1 - e_a . e_b).
template <class S>
HYDRODAE_PART void bend(const LineView<S>& at, LineArrays<S>& arrays, const Triples<S>& force) {
  const Triples<S> x = triples(arrays, at_::place), q_a = triples(arrays, at_::before),
                   q_b = triples(arrays, at_::behind);
  const S* inverse = arrays.column(at_::inverse_length);
  const int n = at.m.n();
  for (int k = 1; k < n; ++k) {
    const S c(at.bending(k));
    const S p_a = inverse[k], p_b = inverse[k + 1];
    const Triple<S> e_a = p_a * (x[k] - x[k - 1]), e_b = p_b * (x[k + 1] - x[k]);
    const S s = dot(e_a, e_b);
    q_a.put(k, (-c * p_a) * (e_b - s * e_a));
    q_b.put(k, (-c * p_b) * (e_a - s * e_b));
  }
  for (int k : {0, n}) {
    q_a.clear(k);
    q_b.clear(k);
  }
  for (int i = 0; i <= n; ++i) {
    Triple<S> f = force[i] + (q_b[i] - q_a[i]);
    if (i < n)
      f = f + q_a[i + 1];
    if (i > 0)
      f = f - q_b[i - 1];
    force.put(i, f);
  }
}

/// Adds the forces of the bed.
template <bool damps_up, class S>
HYDRODAE_PART void lie(const LineTable& table, int n, LineArrays<S>& arrays) {
  using std::sqrt;
  const Triples<S> x = triples(arrays, at_::place), v = triples(arrays, at_::velocity),
                   force = triples(arrays, at_::force);
  const double *height = table.nodes.col(node::bed_height).data(),
               *width = table.nodes.col(node::bed_width).data(),
               *stiffness = table.nodes.col(node::bed_stiffness).data(),
               *damping = table.nodes.col(node::bed_damping).data(),
               *friction = table.nodes.col(node::friction).data();
#pragma GCC ivdep
  for (int i = 0; i <= n; ++i) {
    const Plus<S> s = plus<S>(S(height[i]) - x.z[i], width[i]);
    const S down = down_rate<damps_up, S>(-v.z[i]).value;
    const S drag = S(-friction[i] * stiffness[i]) * s.value /
                   sqrt(v.x[i] * v.x[i] + v.y[i] * v.y[i] + S(slip_speed * slip_speed));
    force.x[i] += drag * v.x[i];
    force.y[i] += drag * v.y[i];
    force.z[i] += S(stiffness[i]) * s.value + S(damping[i]) * s.slope * down;
  }
}

/// Adds the forces of a bed that is not flat.
template <bool damps_up, class S>
HYDRODAE_PART void lie_on_slopes(const LineTable& table, const LineModel& m,
                                 LineArrays<S>& arrays) {
  using std::sqrt;
  const Triples<S> x = triples(arrays, at_::place), v = triples(arrays, at_::velocity),
                   force = triples(arrays, at_::force);
  S *bed = arrays.column(at_::bed), *bed_x = arrays.column(at_::bed_x),
    *bed_y = arrays.column(at_::bed_y);
  const double *height = table.nodes.col(node::bed_height).data(),
               *width = table.nodes.col(node::bed_width).data(),
               *stiffness = table.nodes.col(node::bed_stiffness).data(),
               *damping = table.nodes.col(node::bed_damping).data(),
               *friction = table.nodes.col(node::friction).data();
  const int n = m.n();
  for (int i = 0; i <= n; ++i) {
    const Triple<S> at = x[i];
    const SurfacePoint<S> here = at.z < S(table.bed_top)
                                     ? m.surface->template at<S>(at.x, at.y)
                                     : SurfacePoint<S>{S(m.bed), S(0), S(0), S(0), S(0), S(0)};
    bed[i] = here.value - S(m.bed);
    bed_x[i] = here.x;
    bed_y[i] = here.y;
  }
#pragma GCC ivdep
  for (int i = 0; i <= n; ++i) {
    const Triple<S> g = {-bed_x[i], -bed_y[i], S(1)};
    const S into = -dot(g, v[i]), square = dot(g, g);
    const Triple<S> slip = v[i] + (into / square) * g;
    const Plus<S> s = plus<S>((S(height[i]) + bed[i]) - x.z[i], width[i]);
    const S down = down_rate<damps_up, S>(into).value;
    const S drag = S(-friction[i] * stiffness[i]) * s.value *
                   sqrt(square / (dot(slip, slip) + S(slip_speed * slip_speed)));
    const S push = S(stiffness[i]) * s.value + S(damping[i]) * s.slope * down;
    force.put(i, force[i] + (push * g + drag * slip));
  }
}

/// Computes the motion of the water at the nodes, the surface above them, and the wet parts.
template <class S>
HYDRODAE_PART void find_water(const LineTable& table, const LineView<S>& at,
                              const sea::WaveField& sea, double t, LineArrays<S>& arrays) {
  const Triples<S> x = triples(arrays, at_::place), u = triples(arrays, at_::water),
                   a = triples(arrays, at_::water_rate);
  S *elevation = arrays.column(at_::elevation), *wet = arrays.column(at_::wet);
  const int n = at.m.n();
  if (sea.terms.empty() && sea.profile.empty()) {
    const Triple<S> flow = {S(sea.current[0]), S(sea.current[1]), S(sea.current[2])};
    for (int i = 0; i <= n; ++i) {
      u.put(i, flow);
      a.clear(i);
      elevation[i] = S(0);
    }
  } else {
    for (int i = 0; i <= n; ++i) {
      const sea::FluidPoint<S> f = node_fluid<S>(at, sea, t, i);
      u.put(i, {f.velocity[0], f.velocity[1], f.velocity[2]});
      a.put(i, {f.acceleration[0], f.acceleration[1], f.acceleration[2]});
      elevation[i] = f.elevation;
    }
  }
  for (int i = 0; i <= n; ++i) {
    const S above = x.z[i] - elevation[i];
    wet[i] = above < S(-table.reach) ? S(1) : wet_line<S>(at, i, above);
  }
}

/// Adds the water on attachments: force and mass.
template <class S>
HYDRODAE_PART void load_attached(const LineTable& table, const LineModel& m,
                                 LineArrays<S>& arrays) {
  const Triples<S> force = triples(arrays, at_::force), v = triples(arrays, at_::velocity),
                   u = triples(arrays, at_::water), a = triples(arrays, at_::water_rate);
  const S *z = arrays.column(at_::place + 2), *elevation = arrays.column(at_::elevation);
  S* mass = arrays.column(at_::own_mass);
  const Vec3<S> none = Vec3<S>::Zero();
  for (const int i : table.attached) {
    const LineNode& on = m.nodes[static_cast<std::size_t>(i)];
    const S wet = water::wet_part<S>(on.body, z[i] - elevation[i], S(0));
    const Vec3<S> flow(u.x[i] - v.x[i], u.y[i] - v.y[i], u.z[i] - v.z[i]);
    const Vec3<S> rate(a.x[i], a.y[i], a.z[i]);
    const Vec3<S> f = wet * water::morison_force<S>(on.body, none, flow, rate, none);
    force.put(i, force[i] + Triple<S>{f[0], f[1], f[2] + wet * S(on.body_lift)});
    mass[i] += wet * S(on.body.mass_body);
  }
}

/// Adds the water on the line, and computes the accelerations from the masses along and across it.
template <bool waves, class S>
HYDRODAE_PART void flow(const LineTable& table, int n, LineArrays<S>& arrays) {
  using std::abs, std::sqrt;
  const Triples<S> force = triples(arrays, at_::force), span = triples(arrays, at_::span),
                   v = triples(arrays, at_::velocity), water = triples(arrays, at_::water),
                   rate = triples(arrays, at_::water_rate),
                   out = triples(arrays, at_::acceleration);
  const S *wet = arrays.column(at_::wet), *mass = arrays.column(at_::own_mass);
  const double *drag = table.nodes.col(node::drag).data(),
               *drag_axial = table.nodes.col(node::drag_axial).data(),
               *mass_body = table.nodes.col(node::mass_body).data(),
               *mass_axial = table.nodes.col(node::mass_axial).data(),
               *lift = table.nodes.col(node::lift).data(),
               *fluid = table.nodes.col(node::fluid).data(),
               *fluid_axial = table.nodes.col(node::fluid_axial).data();
#pragma GCC ivdep
  for (int i = 0; i <= n; ++i) {
    const Triple<S> d = span[i] + span[i + 1], t = (S(1) / sqrt(dot(d, d))) * d;
    const Triple<S> u = water[i] - v[i];
    const S u_t = dot(t, u);
    const Triple<S> u_n = u - u_t * t;
    const S square = dot(u_n, u_n), speed = square > S(0) ? S(sqrt(square)) : S(0);
    S across = S(drag[i]) * speed, along = S(drag_axial[i]) * abs(u_t) * u_t;
    Triple<S> law = across * u_n;
    if constexpr (waves) {
      along += S(fluid_axial[i]) * dot(t, rate[i]);
      law = law + S(fluid[i]) * rate[i];
    }
    const Triple<S> f = force[i] + wet[i] * (law + along * t + Triple<S>{S(0), S(0), S(lift[i])});
    const S by_across = S(1) / (mass[i] + wet[i] * S(mass_body[i])),
            by_along = S(1) / (mass[i] + wet[i] * S(mass_axial[i]));
    force.put(i, f);
    out.put(i, by_across * f + ((by_along - by_across) * dot(t, f)) * t);
  }
}

template <class S>
HYDRODAE_PART void evaluate(const LineTable& table, const LineView<S>& at,
                            const sea::WaveField& sea, double t, LineArrays<S>& arrays, S* load,
                            S* z_dot) {
  const LineModel& m = at.m;
  const int n = m.n();
  arrays.resize(n + 2, at_::n);
  const Triples<S> x = triples(arrays, at_::place), v = triples(arrays, at_::velocity),
                   pull = triples(arrays, at_::pull), force = triples(arrays, at_::force),
                   a = triples(arrays, at_::acceleration);
  S* mass = arrays.column(at_::own_mass);
  spread(at, x, v);
  const bool curved = !table.curves.empty();
  if (m.damps_slack)
    curved ? pull_segments<true, true>(table, n, arrays)
           : pull_segments<true, false>(table, n, arrays);
  else
    curved ? pull_segments<false, true>(table, n, arrays)
           : pull_segments<false, false>(table, n, arrays);
  part(at, pull, triples(arrays, at_::span));
  const double *weight = table.nodes.col(node::weight).data(),
               *own = table.nodes.col(node::mass).data();
#pragma GCC ivdep
  for (int i = 0; i <= n; ++i) {
    const Triple<S> f = pull[i + 1] - pull[i];
    force.put(i, {f.x, f.y, f.z - S(weight[i])});
    mass[i] = S(own[i]);
  }
  if (m.bends)
    bend(at, arrays, force);
  S low = x.z[0];
  for (int i = 1; i <= n; ++i)
    low = x.z[i] < low ? x.z[i] : low;
  if (low < S(table.bed_top)) {
    if (m.surface)
      m.bed_damps_up ? lie_on_slopes<true>(table, m, arrays)
                     : lie_on_slopes<false>(table, m, arrays);
    else if (m.bed_damps_up)
      lie<true>(table, n, arrays);
    else
      lie<false>(table, n, arrays);
  }
  if (m.wet) {
    find_water(table, at, sea, t, arrays);
    load_attached(table, m, arrays);
    if (sea.terms.empty())
      flow<false>(table, n, arrays);
    else
      flow<true>(table, n, arrays);
  } else {
    for (int i = 0; i <= n; ++i)
      a.put(i, (S(1) / mass[i]) * force[i]);
  }
  const int last = m.n_unknown();
  for (int i = 1; i <= last; ++i, z_dot += 6) {
    z_dot[0] = v.x[i];
    z_dot[1] = v.y[i];
    z_dot[2] = v.z[i];
    z_dot[3] = a.x[i];
    z_dot[4] = a.y[i];
    z_dot[5] = a.z[i];
  }
  for (int end = 0; end < m.n_points(); ++end)
    Eigen::Map<Vec3<S>>(load + 3 * end) = arrays.force(end == 0 ? 0 : n);
}

// One function for each instruction set.
#define HYDRODAE_EVALUATE(set, target)                                                             \
  target void evaluate_##set(const LineTable& table, const LineView<double>& at,                   \
                             const sea::WaveField& sea, double t, LineArrays<double>& arrays,      \
                             double* load, double* z_dot) {                                        \
    evaluate<double>(table, at, sea, t, arrays, load, z_dot);                                      \
  }
HYDRODAE_EVALUATE(plain, )
#ifdef HYDRODAE_X86
HYDRODAE_EVALUATE(avx2, [[gnu::target("avx2")]])
HYDRODAE_EVALUATE(avx512, [[gnu::target("avx512f,avx512dq,avx512vl")]])
#endif

using Evaluate = decltype(&evaluate_plain);
Evaluate widest() {
#ifdef HYDRODAE_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return evaluate_avx512;
  if (__builtin_cpu_supports("avx2"))
    return evaluate_avx2;
#endif
  return evaluate_plain;
}

} // namespace

LineTable::LineTable(const LineModel& m)
    : segments(m.n(), static_cast<int>(seg::n)), nodes(m.n() + 1, static_cast<int>(node::n)) {
  for (int k = 0; k < m.n(); ++k) {
    const LineSegment& s = m.segments[static_cast<std::size_t>(k)];
    segments.row(k) << s.length, 1.0 / s.length, s.stiffness, s.damping / s.length, s.slack;
  }
  if (std::any_of(m.segments.begin(), m.segments.end(),
                  [](const LineSegment& s) { return s.curve != nullptr; }))
    for (const LineSegment& s : m.segments)
      curves.push_back(s.curve);
  bed_top = m.bed;
  for (int i = 0; i <= m.n(); ++i) {
    const LineNode& q = m.nodes[static_cast<std::size_t>(i)];
    const water::MorisonSegment& w = q.line;
    nodes.row(i) << q.mass * m.gravity, q.mass, w.drag, w.drag_axial, w.mass_body, w.mass_axial,
        q.lift, w.mass_fluid, q.displaced + w.mass_axial - w.mass_fluid, m.bed + q.axis_height,
        q.bed_width, q.bed_stiffness, q.bed_damping, q.friction;
    reach = std::max({reach, w.half_length, w.radius});
    bed_top = std::max(bed_top, m.bed + q.axis_height + q.bed_width);
    if (q.body.radius > 0.0)
      attached.push_back(i);
  }
}

void evaluate_line(const LineTable& table, const LineView<double>& at, const sea::WaveField& sea,
                   double t, LineArrays<double>& arrays, double* load, double* z_dot) {
  static const Evaluate evaluate_widest = widest();
  evaluate_widest(table, at, sea, t, arrays, load, z_dot);
}

void evaluate_line(const LineTable& table, const LineView<Dual>& at, const sea::WaveField& sea,
                   double t, LineArrays<Dual>& arrays, Dual* load, Dual* z_dot) {
  evaluate<Dual>(table, at, sea, t, arrays, load, z_dot);
}

} // namespace hydrodae::line
