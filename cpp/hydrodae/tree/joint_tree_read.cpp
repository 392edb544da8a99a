/// From poses and velocities of the bodies to joint coordinates.

#include <algorithm>
#include <cmath>

#include "hydrodae/tree/joint_tree_link.h"

namespace hydrodae::tree {

using Turn = TreeLink::Turn;

namespace {

/// Coordinates of a link from the poses of its bodies.
void read_link(const TreeLink& l, const TreeMotion::Body& parent, const TreeMotion::Body& c,
               double* q) {
  const LinkEnds e = link_ends(l, parent, c);
  const Vector3 x = e.A.transpose() * (e.b - e.a);
  for (std::size_t k = 0; k < l.slides.size(); ++k)
    *q++ = x[l.slides[k]];
  const Matrix3 N = e.A.transpose() * e.B;
  const Vector4 p = quaternion_of<double>(N).normalized();
  if (l.turn == Turn::about_axis) {
    *q = 2.0 * std::atan2(l.axis.dot(p.tail<3>()), p[0]);
    if (l.advance != 0.0)
      *q += 2.0 * pi * std::round((x.dot(l.axis) / l.advance - *q) / (2.0 * pi));
  } else if (l.turn == Turn::crossed) {
    q[0] = std::atan2(N(2, 1), N(1, 1));
    q[1] = std::atan2(N(0, 2), N(0, 0));
  } else if (l.turn == Turn::ball) {
    std::copy_n(p.data(), 4, q);
  }
}

/// Its rates: the columns of one link are at right angles to each other.
void read_rates(const TreeLink& l, const TreeMotion::Body& parent, const TreeMotion::Body& c,
                const TreeColumn* column, double* u) {
  const Vector3 omega = c.omega - parent.omega;
  Vector3 v = c.v - parent.v - cross<double>(parent.omega, c.r - parent.r);
  const int slides = static_cast<int>(l.slides.size());
  for (int k = slides; k < l.n_u; ++k) {
    u[k] = column[k].axis.dot(omega);
    v -= u[k] * (column[k].slide + cross<double>(column[k].axis, c.r - column[k].pivot));
  }
  for (int k = 0; k < slides; ++k)
    u[k] = column[k].slide.dot(v);
}

} // namespace

std::pair<double, int> TreeMotion::read(const system::System& s, const JointTree& tree,
                                        const VectorX& y, VectorX& x) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(y.size());
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  std::fill(sign.begin(), sign.end(), 1.0);
  std::fill(angle_offset.begin(), angle_offset.end(), 0.0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const system::BodyState<double>& state = ws.bodies[i];
    bodies[i].r = state.r;
    bodies[i].R = state.R;
    bodies[i].p = quaternion_of<double>(state.R).normalized();
    bodies[i].v = state.v;
    bodies[i].omega = state.R * state.w;
  }
  for (const TreeLink& l : tree.links) {
    const Body& c = bodies[static_cast<std::size_t>(l.body)];
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(l.body)];
    const Body& parent = parent_of(l, bodies);
    if (l.joint < 0) {
      std::copy_n(y.data() + b.q0, l.n_q, x.data() + l.q0);
      std::copy_n(y.data() + b.u0, l.n_u, x.data() + tree.n_q + l.u0);
      continue;
    }
    read_link(l, parent, c, x.data() + l.q0);
    fill_columns(l, parent, c, columns.data() + l.u0);
    read_rates(l, parent, c, columns.data() + l.u0, x.data() + tree.n_q + l.u0);
  }
  normalise(tree, x);
  move(tree, x.data());
  std::pair<double, int> worst{0.0, -1};
  for (const TreeLink& l : tree.links) {
    const auto i = static_cast<std::size_t>(l.body);
    const system::BodyState<double>& state = ws.bodies[i];
    const double misfit = std::max((bodies[i].r - state.r).cwiseAbs().maxCoeff(),
                                   (bodies[i].R - state.R).cwiseAbs().maxCoeff());
    if (!(misfit <= worst.first))
      worst = {misfit, l.body};
    const system::BodyData& b = s.bodies[i];
    if (b.rotation == system::BodyData::Rotation::free && bodies[i].p.dot(state.p) < 0.0)
      sign[i] = -1.0;
    if (b.rotation == system::BodyData::Rotation::about_axis && l.joint >= 0) {
      const double turn = l.turn == Turn::about_axis
                              ? l.angle_factor * x[l.q0 + static_cast<Index>(l.slides.size())]
                              : 0.0;
      const double angle = y[b.q0 + b.n_translations]; // with all its turns
      angle_offset[i] = angle - parent_of(l, bodies).angle - turn;
      bodies[i].angle = angle;
    }
  }
  move(tree, x.data());
  return worst;
}

void normalise(const JointTree& tree, VectorX& x) {
  for (const TreeLink& l : tree.links)
    if (l.turn == Turn::ball)
      x.segment<4>(l.q0 + l.n_u - 3).normalize();
}

void retract(const JointTree& tree, const VectorX& step, VectorX& x) {
  for (const TreeLink& l : tree.links) {
    const int plain = l.turn == Turn::ball ? l.n_u - 3 : l.n_u;
    for (int k = 0; k < plain; ++k)
      x[l.q0 + k] += step[l.u0 + k];
    if (l.turn != Turn::ball)
      continue;
    const Vector4 p = x.segment<4>(l.q0 + plain);
    x.segment<4>(l.q0 + plain) =
        product(p, quaternion_from_rotation_vector(step.segment<3>(l.u0 + plain)));
  }
}

} // namespace hydrodae::tree
