/// Kinematics of the tree of joint coordinates, forward and back.

#include <algorithm>
#include <cmath>

#include "hydrodae/tree/joint_tree_link.h"

namespace hydrodae::tree {

namespace {

using Turn = TreeLink::Turn;

Vector4 conjugate(const Vector4& p) { return {p[0], -p[1], -p[2], -p[3]}; }

Vector4 about(const Vector3& axis, double angle) {
  Vector4 p;
  p << std::cos(0.5 * angle), std::sin(0.5 * angle) * axis;
  return p;
}

/// The turn of B against A, `q` past the slides.
Vector4 relative_turn(const TreeLink& l, const double* q) {
  switch (l.turn) {
  case Turn::none:
    return {1, 0, 0, 0};
  case Turn::about_axis:
    return about(l.axis, q[0]);
  case Turn::crossed:
    return product(about(Vector3::UnitX(), q[0]), about(Vector3::UnitY(), q[1]));
  case Turn::ball:
    break;
  }
  return Vector4(q[0], q[1], q[2], q[3]).normalized();
}

void place_own(const TreeLink& l, const double* q, TreeMotion::Body& c) {
  const std::size_t n = l.slides.size();
  for (std::size_t k = 0; k < n; ++k)
    c.r[l.slides[k]] = q[k];
  if (l.turn == Turn::none)
    return;
  c.p = relative_turn(l, q + n);
  if (l.turn == Turn::about_axis)
    c.angle = q[n];
  c.R = rotation_matrix<double>(c.p);
}

void place(const TreeLink& l, const double* q, const TreeMotion::Body& parent, double angle_offset,
           TreeMotion::Body& c) {
  const std::size_t n = l.slides.size();
  const Vector4 turn = relative_turn(l, q + n);
  const Vector4 marker = product(parent.p, l.parent_turn);
  c.p = product(product(marker, l.turned ? conjugate(turn) : turn), conjugate(l.child_turn));
  c.R = rotation_matrix<double>(c.p);
  Vector3 x = Vector3::Zero();
  for (std::size_t k = 0; k < n; ++k)
    x[l.slides[k]] = q[k];
  if (l.turn == Turn::about_axis) {
    x += l.advance * q[n] * l.axis;
    c.angle = l.angle_factor * q[n];
  } else {
    c.angle = 0.0;
  }
  c.angle += parent.angle + angle_offset;
  const Vector3 p = parent.r + parent.R * l.parent_point;
  const Vector3 way =
      l.turned ? Vector3(-(c.R * (l.child_axes * x))) : Vector3(parent.R * (l.parent_axes * x));
  c.r = p + way - c.R * l.child_point;
}

/// Is column k of a joint fixed in body B of it (else in A)?
bool lies_in_b(const TreeLink& l, int k) {
  const int turn = k - static_cast<int>(l.slides.size());
  return l.turn == Turn::ball ? turn >= 0 : l.turn == Turn::crossed && turn == 1;
}

const TreeMotion::Body& ground() {
  static const TreeMotion::Body body = [] {
    TreeMotion::Body b;
    b.r = Vector3::Zero();
    b.p << 1, 0, 0, 0;
    b.R = Matrix3::Identity();
    return b;
  }();
  return body;
}

} // namespace

LinkEnds link_ends(const TreeLink& l, const TreeMotion::Body& parent,
                   const TreeMotion::Body& child) {
  LinkEnds e;
  const Matrix3 P = parent.R * l.parent_axes, C = child.R * l.child_axes;
  const Vector3 p = parent.r + parent.R * l.parent_point, c = child.r + child.R * l.child_point;
  e.A = l.turned ? C : P;
  e.B = l.turned ? P : C;
  e.a = l.turned ? c : p;
  e.b = l.turned ? p : c;
  e.sign = l.turned ? -1.0 : 1.0;
  return e;
}

const TreeMotion::Body& parent_of(const TreeLink& l, const std::vector<TreeMotion::Body>& bodies) {
  return l.parent < 0 ? ground() : bodies[static_cast<std::size_t>(l.parent)];
}

void fill_columns(const TreeLink& l, const TreeMotion::Body& parent, const TreeMotion::Body& c,
                  TreeColumn* column) {
  if (l.joint < 0) {
    for (const int axis : l.slides)
      *column++ = {Vector3::Unit(axis), Vector3::Zero(), c.r};
    if (l.turn == Turn::about_axis)
      *column = {Vector3::Zero(), l.axis, c.r};
    for (int k = 0; l.turn == Turn::ball && k < 3; ++k)
      *column++ = {Vector3::Zero(), c.R.col(k), c.r};
    return;
  }
  const LinkEnds e = link_ends(l, parent, c);
  for (const int axis : l.slides)
    *column++ = {e.sign * e.A.col(axis), Vector3::Zero(), e.b};
  if (l.turn == Turn::about_axis) {
    const Vector3 a = e.sign * (e.A * l.axis);
    *column = {l.advance * a, a, e.b};
  } else if (l.turn == Turn::crossed) {
    column[0] = {Vector3::Zero(), e.sign * e.A.col(0), e.b};
    column[1] = {Vector3::Zero(), e.sign * e.B.col(1), e.b};
  }
  for (int k = 0; l.turn == Turn::ball && k < 3; ++k)
    *column++ = {Vector3::Zero(), e.sign * e.B.col(k), e.b};
}

TreeMotion::TreeMotion(const system::System& s, std::size_t n_columns)
    : bodies(s.bodies.size()), columns(n_columns), sign(bodies.size(), 1.0),
      angle_offset(bodies.size(), 0.0) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].r = s.bodies[i].position;
    bodies[i].p = s.bodies[i].orientation;
    bodies[i].R = rotation_matrix<double>(bodies[i].p);
  }
}

void TreeMotion::move(const JointTree& tree, const double* x) {
  const double* u = x + tree.n_q;
  for (const TreeLink& l : tree.links) {
    const auto i = static_cast<std::size_t>(l.body);
    Body& c = bodies[i];
    const Body& parent = parent_of(l, bodies);
    if (l.joint < 0)
      place_own(l, x + l.q0, c);
    else
      place(l, x + l.q0, parent, angle_offset[i], c);
    TreeColumn* own = columns.data() + l.u0;
    fill_columns(l, parent, c, own);
    c.omega = parent.omega;
    c.v = parent.v + cross<double>(parent.omega, c.r - parent.r);
    for (int k = 0; k < l.n_u; ++k) {
      const double rate = u[l.u0 + k];
      c.v += rate * (own[k].slide + cross<double>(own[k].axis, c.r - own[k].pivot));
      c.omega += rate * own[k].axis;
    }
  }
}

// a_C = a_P + alpha_P x rho + omega_P x rho'
//       + sum_k u_k' column_k + u_k [d_k' + a_k' x (r - o) + a_k x (v - o')]
void TreeMotion::accelerate(const JointTree& tree, const double* x, const double* rates) {
  const double* u = x + tree.n_q;
  for (const TreeLink& l : tree.links) {
    Body& c = bodies[static_cast<std::size_t>(l.body)];
    const Body& parent = parent_of(l, bodies);
    c.alpha = parent.alpha;
    c.a = parent.a + cross<double>(parent.alpha, c.r - parent.r) +
          cross<double>(parent.omega, c.v - parent.v);
    const bool own = l.joint < 0;
    const Body& A = l.turned ? c : parent;
    const Body& B = own || !l.turned ? c : parent;
    for (int k = 0; k < l.n_u; ++k) {
      const TreeColumn& column = columns[static_cast<std::size_t>(l.u0 + k)];
      const double rate = u[l.u0 + k];
      const Vector3 arm = c.r - column.pivot;
      // Axes of a body's own coordinates: slides stay, turns are carried by the body.
      const Vector3 carrier = own || lies_in_b(l, k) ? B.omega : A.omega;
      const Vector3 pivot_rate = B.v + cross<double>(B.omega, column.pivot - B.r);
      const Vector3 turning = cross<double>(carrier, column.axis);
      const Vector3 sliding = own ? Vector3(Vector3::Zero()) : cross<double>(carrier, column.slide);
      c.a += rate *
             (sliding + cross<double>(turning, arm) + cross<double>(column.axis, c.v - pivot_rate));
      c.alpha += rate * turning;
      if (rates) {
        c.a += rates[l.u0 + k] * (column.slide + cross<double>(column.axis, arm));
        c.alpha += rates[l.u0 + k] * column.axis;
      }
    }
  }
}

void TreeMotion::position_rates(const JointTree& tree, const double* x, double* rates) const {
  const double* u = x + tree.n_q;
  for (const TreeLink& l : tree.links) {
    const int plain = l.turn == Turn::ball ? l.n_u - 3 : l.n_u;
    for (int k = 0; k < plain; ++k)
      rates[l.q0 + k] = u[l.u0 + k];
    if (l.turn != Turn::ball)
      continue;
    const Eigen::Map<const Vector4> p(x + l.q0 + plain);
    const Eigen::Map<const Vector3> w(u + l.u0 + plain);
    Eigen::Map<Vector4>(rates + l.q0 + plain) = 0.5 * (quaternion_rate_matrix<double>(p) * w);
  }
}

void TreeMotion::write(const system::System& s, VectorX& y) const {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    if (b.n_active == 0)
      continue;
    const Body& c = bodies[i];
    const Vector3 w = c.R.transpose() * c.omega;
    for (int k = 0; k < b.n_active; ++k) {
      const int component = b.active[static_cast<std::size_t>(k)];
      if (component < 3)
        y[b.q0 + k] = c.r[component];
      y[b.u0 + k] = component < 3 ? c.v[component] : w[component - 3];
    }
    const Index q = b.q0 + b.n_translations;
    if (b.rotation == system::BodyData::Rotation::about_axis)
      y[q] = c.angle;
    if (b.rotation == system::BodyData::Rotation::free)
      y.segment<4>(q) = sign[i] * c.p;
  }
}

} // namespace hydrodae::tree
