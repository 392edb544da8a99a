#pragma once
/// Equations of a dynamic line. Nodes 0 .. N are the ends of segments of unstretched length l_i.
/// Node 0 is end A, node N is end B or free; each node has half of the segments beside it.
///
///   m a = T_i+1/2 e_i+1/2 - T_i-1/2 e_i-1/2 - m g z + w rho g V z + F_water + F_bend + F_bed
///                                                         or with `damps_slack` C strain'
///                                                        throughout
///   F_water = w (Morison's force), along and across t_i = (x_i+1 - x_i-1) / |.|    (morison.h)
///   F_bend  = -grad sum_i EI / l_i (1 - e_i-1/2 . e_i+1/2)
///   F_bed   = (k s(d) + c s'(d) p(d')) g - mu k s(d) |g| v_t / sqrt(v_t^2 + v_s^2)
/// w: wet part of the node; d = b(x, y) - z: depth of the node in the bed at z = b [m]; g = -grad d
/// = (-b_x, -b_y, 1): normal of the bed, so that k s(d) g is minus the gradient of the energy of
/// the bed; v_t: velocity across g; p: positive part, smooth, so that the bed never pulls; with
/// `bed_damps_up` p(v) = v, and the bed may pull. On a flat bed g = z. End nodes add the
/// inertia of half a segment to that of their body.

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "hydrodae/element/surroundings.h"
#include "hydrodae/math/curve.h"
#include "hydrodae/math/smooth_table.h"
#include "hydrodae/water/morison.h"

namespace hydrodae::line {

struct LineSegment {
  double length = 0.0;    ///< unstretched length [m]
  double stiffness = 0.0; ///< EA [N]; with a curve: secant at its last point
  double damping = 0.0;   ///< C [N s]
  double slack = 0.0;     ///< half the width of strain in which s bends [-]
  double strength = std::numeric_limits<double>::infinity(); ///< breaking load [N]
  std::shared_ptr<const Curve> curve = nullptr; ///< tension over EA by s [-]; null: s itself
};

struct LineNode {
  double at = 0.0;                    ///< unstretched length from A [m]
  double mass = 0.0;                  ///< [kg]
  double bending = 0.0;               ///< EI / l [N m]
  water::MorisonSegment line;         ///< water load on the line
  water::MorisonSegment body;         ///< water load on the attachment
  double lift = 0.0, body_lift = 0.0; ///< rho g V of line and attachment [N]
  double displaced = 0.0;             ///< rho V [kg], for the wave pressure along the line
  double bed_stiffness = 0.0;         ///< k [N/m]
  double bed_damping = 0.0;           ///< c [N s/m]
  double bed_width = 0.0;             ///< half the width of depth in which s(d) bends [m]
  double friction = 0.0;              ///< friction coefficient mu
  double axis_height = 0.0;           ///< height of the axis above the bed at first contact [m]
};

struct LineModel {
  std::vector<LineSegment> segments; ///< (N,)
  std::vector<LineNode> nodes;       ///< (N + 1,)
  double gravity = 9.81;
  /// height of the bed, or an upper bound of that of `surface` [m]
  double bed = -std::numeric_limits<double>::infinity();
  std::shared_ptr<const SmoothTable> surface; ///< bed, z over x and y [m]; null: flat
  bool wet = false;                           ///< true: there is water
  bool bends = false;
  bool damps_slack = false;  ///< true: C acts in slack segments, too
  bool bed_damps_up = false; ///< true: c acts on the way up, too
  bool free_end = false;

  /// Bed beneath the place x.
  template <class S> SurfacePoint<S> bed_at(const Vec3<S>& x) const {
    return surface ? surface->at<S>(x[0], x[1])
                   : SurfacePoint<S>{S(bed), S(0), S(0), S(0), S(0), S(0)};
  }
  int n() const { return static_cast<int>(segments.size()); }
  int n_points() const { return free_end ? 1 : 2; }
  int n_unknown() const { return free_end ? n() : n() - 1; } ///< number of free nodes
  bool is_end(int i) const { return i == 0 || (i == n() && !free_end); }
};

inline constexpr double slip_speed =
    0.01; ///< v_s, and in which the damping of the bed begins [m/s]

/// Smooth max(0, x), twice differentiable: a polynomial of degree four for |x| < w.
template <class S> struct Plus {
  S value, slope, curvature;
};
template <class S> Plus<S> plus(const S& x, double w) {
  if (!(x > S(-w)))
    return {S(0), S(0), S(0)};
  if (!(x < S(w)))
    return {x, S(1), S(0)};
  const S y = x / S(w), y2 = y * y;
  return {S(w) * (S(0.5) * y + S(0.375) * y2 - S(0.0625) * y2 * y2 + S(0.1875)),
          S(0.5) + S(0.75) * y - S(0.25) * y2 * y, S(0.75 / w) * (S(1) - y2)};
}
/// Integral of Plus from -w on.
inline double plus_integral(double x, double w) {
  if (x <= -w)
    return 0.0;
  if (x >= w)
    return 0.5 * x * x + 0.1 * w * w;
  const double y = x / w;
  return w * w * (0.25 * y * y + 0.125 * y * y * y - 0.0125 * std::pow(y, 5) + 0.1875 * y + 0.05);
}

/// View of the nodes in the inputs of a law: x, v of the ends as in `points`, states [place |
/// velocity] of the others node by node.
template <class S> struct LineView {
  const LineModel& m;
  const S *x, *v, *z;
  int parted = -1; ///< segment that has parted; -1: none
  Vec3<S> place(int i) const { return Eigen::Map<const Vec3<S>>(at(i, x, 0)); }
  Vec3<S> velocity(int i) const { return Eigen::Map<const Vec3<S>>(at(i, v, 3)); }

  /// Function s(strain) of segment k at this length.
  Plus<S> stretch(int k, const S& length) const {
    if (k == parted)
      return {S(0), S(0), S(0)};
    const LineSegment& seg = m.segments[static_cast<std::size_t>(k)];
    return plus<S>((length - S(seg.length)) / S(seg.length), seg.slack);
  }
  /// Tension over EA of segment k at s of its strain; its slope is that over the strain.
  Plus<S> pulled(int k, const Plus<S>& s) const {
    const Curve* curve = m.segments[static_cast<std::size_t>(k)].curve.get();
    if (!curve)
      return s;
    return {(*curve)(s.value), curve->slope(s.value) * s.slope, S(0)};
  }
  /// Factor of the damping of segment k, from its s.
  Plus<S> damped(int k, const Plus<S>& s) const {
    return m.damps_slack && k != parted ? Plus<S>{s.value, S(1), S(0)} : s;
  }
  /// Bending stiffness EI / l at node k, between two segments.
  double bending(int k) const {
    return k == parted || k == parted + 1 ? 0.0 : m.nodes[static_cast<std::size_t>(k)].bending;
  }

private:
  const S* at(int i, const S* end, int part) const {
    return i == 0 ? end : m.is_end(i) ? end + 3 : z + 6 * (i - 1) + part;
  }
};

template <class S> S length_of(const Vec3<S>& d) {
  using std::sqrt;
  return sqrt(d.cwiseProduct(d).sum());
}

/// Nodes that give the direction of the line at node i: its neighbours, except over a parted
/// segment, unless there is no other.
template <class S> int node_before(const LineView<S>& at, int i) {
  return i == 0 || (at.parted == i - 1 && i < at.m.n()) ? i : i - 1;
}
template <class S> int node_behind(const LineView<S>& at, int i) {
  return i == at.m.n() || (at.parted == i && i > 0) ? i : i + 1;
}

/// Tangent of the line at node i, from the neighbour before to the one behind.
template <class S> Vec3<S> tangent(const LineView<S>& at, int i) {
  const Vec3<S> d = at.place(node_behind(at, i)) - at.place(node_before(at, i));
  return d / length_of<S>(d);
}

template <class S> struct SegmentPull {
  Vec3<S> e;
  S length, rate, tension;
};
template <class S> SegmentPull<S> segment_pull(const LineView<S>& at, int k) {
  const LineSegment& seg = at.m.segments[static_cast<std::size_t>(k)];
  SegmentPull<S> out;
  const Vec3<S> d = at.place(k + 1) - at.place(k);
  out.length = length_of<S>(d);
  out.e = d / out.length;
  out.rate = out.e.cwiseProduct(at.velocity(k + 1) - at.velocity(k)).sum();
  const Plus<S> s = at.stretch(k, out.length);
  out.tension = S(seg.stiffness) * at.pulled(k, s).value +
                S(seg.damping / seg.length) * out.rate * at.damped(k, s).slope;
  return out;
}

/// Water at a node, and the wet parts of the node and its attachment. Below the bed the water moves
/// as at the bed.
template <class S> struct NodeWater {
  Vec3<S> t;
  sea::FluidPoint<S> fluid;
  S line, body; ///< wet parts
};
template <class S>
sea::FluidPoint<S> node_fluid(const LineView<S>& at, const sea::WaveField& sea, double t, int i,
                              sea::FluidGradient* gradient = nullptr) {
  const Vec3<S> none = Vec3<S>::Zero();
  if (sea.terms.empty() && sea.profile.empty()) {
    if (gradient)
      *gradient = {Matrix3::Zero(), Matrix3::Zero(), Vector3::Zero()};
    return {sea.current.template cast<S>(), none, S(0)};
  }
  Vec3<S> x = at.place(i);
  const bool below = x[2] < S(-sea.depth);
  if (below)
    x[2] = S(-sea.depth);
  sea::FluidPoint<S> out;
  sea::fluid_on_line<S>(sea, t, x, none, 1, &out, gradient);
  if (gradient && below)
    gradient->velocity.col(2).setZero(), gradient->acceleration.col(2).setZero();
  return out;
}
/// Wet part of the line at node i, at height `above` over the surface.
template <class S> S wet_line(const LineView<S>& at, int i, const S& above) {
  const water::MorisonSegment& line = at.m.nodes[static_cast<std::size_t>(i)].line;
  const double reach = std::max(line.half_length, line.radius); // no part is farther away
  return line.radius == 0.0 || above > S(reach) ? S(0)
         : above < S(-reach) ? S(1)
                             : water::wet_part<S>(line, above, tangent<S>(at, i)[2]);
}
template <class S>
NodeWater<S> node_water(const LineView<S>& at, const sea::WaveField& sea, double t, int i,
                        sea::FluidGradient* gradient = nullptr) {
  const LineNode& node = at.m.nodes[static_cast<std::size_t>(i)];
  NodeWater<S> out;
  out.t = tangent<S>(at, i);
  out.fluid = node_fluid<S>(at, sea, t, i, gradient);
  const S above = at.place(i)[2] - out.fluid.elevation;
  out.line = wet_line<S>(at, i, above);
  out.body = node.body.radius > 0.0 ? water::wet_part<S>(node.body, above, S(0)) : S(0);
  return out;
}

/// Force of the water on a node with the acceleration a.
template <class S>
Vec3<S> water_force(const LineNode& node, const NodeWater<S>& w, const Vec3<S>& v,
                    const Vec3<S>& a) {
  const Vec3<S> u = w.fluid.velocity - v, none = Vec3<S>::Zero();
  Vec3<S> f = none;
  if (node.line.radius > 0.0)
    f = w.line * (water::morison_force<S>(node.line, w.t, u, w.fluid.acceleration, a) +
                  S(node.displaced) * w.t.cwiseProduct(w.fluid.acceleration).sum() * w.t);
  if (node.body.radius > 0.0)
    f += w.body * water::morison_force<S>(node.body, none, u, w.fluid.acceleration, a);
  f[2] += w.line * S(node.lift) + w.body * S(node.body_lift);
  return f;
}

/// Function p(v) of the bed damping, v downwards: v beyond v_s, zero on the way up or at rest, so
/// that it dissipates energy and never pulls. Twice differentiable. `both`: p(v) = v.
template <bool both, class S> Plus<S> down_rate(const S& v) {
  if constexpr (both)
    return {v, S(1), S(0)};
  const S y = v * v / S(slip_speed * slip_speed), part = y / (S(1) + y);
  const bool down = v > S(0);
  return {down ? S(v * part) : S(0), down ? S(part * (S(3) - S(2) * part)) : S(0), S(0)};
}
template <class S> Plus<S> down_rate(const S& v, bool both) {
  return both ? down_rate<true, S>(v) : down_rate<false, S>(v);
}

/// Bed at a node: s(d), and the normal g.
template <class S> struct BedContact {
  SurfacePoint<S> bed;
  Plus<S> s;
  Vec3<S> up;
};
template <class S>
BedContact<S> bed_contact(const LineModel& m, const LineNode& node, const Vec3<S>& x) {
  const SurfacePoint<S> bed = m.bed_at<S>(x);
  return {bed, plus<S>(bed.value + S(node.axis_height) - x[2], node.bed_width),
          Vec3<S>(-bed.x, -bed.y, S(1))};
}

template <class S>
Vec3<S> bed_force(const LineModel& m, const LineNode& node, const BedContact<S>& at,
                  const Vec3<S>& v) {
  using std::sqrt;
  if (!(at.s.value > S(0)))
    return Vec3<S>::Zero();
  const S into = -at.up.cwiseProduct(v).sum(), square = at.up.cwiseProduct(at.up).sum();
  const S down = down_rate<S>(into, m.bed_damps_up).value;
  const Vec3<S> slip = v + into / square * at.up;
  const S drag = S(-node.friction * node.bed_stiffness) * at.s.value *
                 sqrt(square / (slip.cwiseProduct(slip).sum() + S(slip_speed * slip_speed)));
  return (S(node.bed_stiffness) * at.s.value + S(node.bed_damping) * at.s.slope * down) * at.up +
         drag * slip;
}

/// Mass of a node across and along the line, with the added mass.
template <class S> struct NodeMass {
  S across, along;
};
template <class S> NodeMass<S> node_mass(const LineNode& node, const S& line, const S& body) {
  const S m = S(node.mass) + body * S(node.body.mass_body);
  return {m + line * S(node.line.mass_body), m + line * S(node.line.mass_axial)};
}

/// Pairs (row, column) of the nonzeros of d (load, z_dot) / d (x, v, z).
std::vector<std::array<int, 2>> line_sparsity(const LineModel& model);

/// Scratch of the derivatives: 3x3 blocks of each node by the places (5) and velocities (3) nearby.
struct LineBlocks {
  std::vector<std::array<Matrix3, 5>> by_place;
  std::vector<std::array<Matrix3, 3>> by_velocity;
};

/// Writes the values of `line_sparsity` from hand-written derivatives. `rates`: z_dot at the same
/// state.
/// @returns the end of the written values
double* line_jacobian(const LineView<double>& at, const sea::WaveField& sea, double t,
                      const double* rates, LineBlocks& blocks, double* values);

} // namespace hydrodae::line
