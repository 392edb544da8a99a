#pragma once
/// Inputs of the laws of System::elements from the bodies, and their loads back onto the bodies.
/// element/elements.h defines the ports.

#include <algorithm>
#include <limits>

#include "hydrodae/system/history.h"

namespace hydrodae::system {

/// Index of a list in System::elements.
inline std::size_t index_of(const Regime& s, const ElementList& list) {
  return static_cast<std::size_t>(&list - s.elements.data());
}

/// Coordinate s and rate s' of the motion of a port, with the gradient of s. A delayed law receives
/// those of the past; without a history, the present coordinate and zero rate.
template <class S>
void see_motion(const Regime& s, const Workspace<S>& ws, const PortData& port, S* x, S* v,
                joint::Vec12<S>& gradient) {
  const joint::Row<S> row = motion_row<S>(s, ws, port.motion);
  gradient = row.gradient;
  if (port.delay >= 0 && ws.past) {
    const std::array<double, 2>& then = ws.past->delayed[port.delay];
    *x = S(then[0]);
    *v = S(then[1]);
    return;
  }
  *x = row.value;
  *v = port.delay >= 0
           ? S(0)
           : row.gradient.cwiseProduct(joint_velocity<S>(s.joints[port.joint], ws.bodies)).sum();
}

/// Coordinates of several motions, their rates, and their gradients.
template <class S>
void see_motions(const Regime& s, const Workspace<S>& ws, const PortData& port, S* x, S* v,
                 joint::Vec12<S>* rows) {
  for (const int motion : port.motions) {
    const joint::Row<S> row = motion_row<S>(s, ws, motion);
    const JointData& j = s.joints[s.motions[motion].joint];
    *rows = row.gradient;
    *x++ = row.value;
    *v++ = rows->cwiseProduct(joint_velocity<S>(j, ws.bodies)).sum();
    ++rows;
  }
}

/// Rows W of the relative velocities between two markers, (d', omega) = W (v_A, w_A, v_B, w_B),
/// along the axes of marker A.
template <class S>
void relative_rows(const JointData& j, const joint::Geometry<S>& g, joint::Vec12<S>* rows) {
  for (int i = 0; i < 3; ++i) {
    rows[i] = joint::SpanRow{i}.at<S>(j.A, j.B, j.parameters, g).gradient;
    const Vec3<S> a = j.A.axes.col(i).template cast<S>();
    rows[3 + i] << Vec3<S>::Zero(), -a, Vec3<S>::Zero(), g.N.transpose() * a;
  }
}

/// Place and rotation vector of marker B relative to marker A, and their velocities.
template <class S>
void see_markers(const Regime& s, const Workspace<S>& ws, const PortData& port, S* x, S* v,
                 joint::Vec12<S>* rows) {
  const JointData& j = s.joints[port.joint];
  const joint::Geometry<S> g = joint_geometry<S>(j, ws.bodies);
  const joint::Vec12<S> u = joint_velocity<S>(j, ws.bodies);
  relative_rows<S>(j, g, rows);
  const Mat3<S> axes = j.A.axes.template cast<S>();
  const Vec3<S> place = axes.transpose() * (g.e - j.A.point.template cast<S>()),
                turn = rotation_of<S>(s, ws, port.followed);
  for (int i = 0; i < 3; ++i) {
    x[i] = place[i];
    x[3 + i] = turn[i];
  }
  for (int i = 0; i < 6; ++i)
    v[i] = rows[i].cwiseProduct(u).sum();
}

/// Places and velocities of points: r + R p, v + R (w x p).
template <class S> void see_points(const Workspace<S>& ws, const PortData& port, S* x, S* v) {
  for (const joint::Marker& point : port.points) {
    Eigen::Map<Vec3<S>> place(x), velocity(v);
    place = point.point.template cast<S>();
    velocity.setZero();
    if (point.body >= 0) {
      const BodyState<S>& b = ws.bodies[point.body];
      velocity = b.v + b.R * b.w.cross(place);
      place = b.r + b.R * place.eval();
    }
    x += 3;
    v += 3;
  }
}

/// Load of a force at a point of a body: world force, body-axes moment p x R^T f.
template <class S>
Vec6<S> load_at(const BodyState<S>& b, const joint::Marker& point, const S* force) {
  const Eigen::Map<const Vec3<S>> f(force);
  const Vec3<S> own = b.R.transpose() * f;
  Vec6<S> load;
  load << f, point.point.template cast<S>().cross(own);
  return load;
}

/// Reaction of the joint of a port on its body B: force and moment at marker B, along the axes of
/// marker A [N, N m], into (6,).
template <class S> void see_reaction(const Regime& s, const PortData& port, const S* y, S* out) {
  std::fill_n(out, 6, S(0));
  const JointData& j = s.joints[port.joint];
  for (const PortData::Pressing& p : port.reaction)
    for (int c = 0; c < 6; ++c)
      out[c] += S(p.on_b[c]) * y[s.lambda(j.rows[p.row])];
}

/// Largest load of dry friction that sticks [N, N m]; for friction with a bearing, from the joint
/// reaction in y.
inline double sticking_load(const Regime& s, const SwitchData& friction, const double* y) {
  const ElementList& list = s.elements[static_cast<std::size_t>(friction.list)];
  const PortData& port = list.ports[static_cast<std::size_t>(friction.law)];
  if (!port.bearing)
    return s.static_loads[friction.number];
  std::array<double, 6> reaction;
  see_reaction<double>(s, port, y, reaction.data());
  return s.static_loads[friction.number] * port.bearing->load(reaction.data());
}

/// Inputs of all laws of one list, into its scratch.
template <class S>
void gather(const Regime& s, const ElementList& list, const Workspace<S>& ws, const S* y,
            ElementScratch<S>& scratch) {
  const element::Shape& shape = list.laws->shape;
  S* in = scratch.in.data();
  joint::Vec12<S>* rows = scratch.rows.data();
  const S* z = y + list.z0;
  for (const PortData& port : list.ports) {
    S *x = in, *v = in + shape.width;
    if (shape.port == element::Port::on_body) {
      const BodyState<S>& state = ws.bodies[port.body];
      const Vec6<S> xi = displacement<S>(s, ws, port.body, port.turn, port.followed, y);
      const Vec6<S> velocity = twist<S>(state);
      std::copy(xi.data(), xi.data() + 6, x);
      std::copy(velocity.data(), velocity.data() + 6, v);
    } else if (shape.port == element::Port::points) {
      see_points<S>(ws, port, x, v);
    } else if (shape.port == element::Port::along_coordinates) {
      see_motions<S>(s, ws, port, x, v, rows);
      rows += shape.width;
    } else if (shape.in_water()) {
      element::write(ws.bodies[port.seen()], in);
    } else if (shape.port == element::Port::between) {
      see_markers<S>(s, ws, port, x, v, rows);
      rows += 6;
    } else {
      see_motion<S>(s, ws, port, x, v, *rows++);
    }
    if (shape.n_reaction > 0)
      see_reaction<S>(s, port, y, v + shape.width);
    std::copy(z, z + shape.n_states, in + shape.n_in() - shape.n_states);
    z += shape.n_states;
    in += shape.n_in();
  }
}

/// Adds the loads of one law to its bodies: W^T load of its rows, or its wrench.
template <class S>
void add_load(const Regime& s, const element::Shape& shape, const PortData& port, const S* load,
              const joint::Vec12<S>* rows, Workspace<S>& ws) {
  if (element::is_on_body(shape.port)) {
    const Eigen::Map<const Vec6<S>> wrench(load);
    ws.loads[port.body] +=
        shape.in_water() ? Vec6<S>(wrench) : to_tangent<S>(ws.bodies[port.body], wrench);
    return;
  }
  if (shape.port == element::Port::points) {
    for (std::size_t i = 0; i < port.points.size(); ++i)
      if (const int body = port.points[i].body; body >= 0)
        ws.loads[body] += load_at<S>(ws.bodies[body], port.points[i], load + 3 * i);
    return;
  }
  if (shape.port == element::Port::along_coordinates) {
    for (std::size_t i = 0; i < port.motions.size(); ++i)
      add_to_bodies<S>(s.joints[s.motions[port.motions[i]].joint],
                       joint::Vec12<S>(load[i] * rows[i]), ws.loads);
    return;
  }
  joint::Vec12<S> sum = load[0] * rows[0];
  for (int i = 1; i < shape.width; ++i)
    sum += load[i] * rows[i];
  add_to_bodies<S>(s.joints[port.joint], sum, ws.loads);
}

/// Returns whether a law along a distance pulls while its two points coincide at rest: the
/// direction is then undefined.
template <class S> bool pulls_nowhere(const S& x, const S& load, const joint::Vec12<S>& row) {
  return x == S(0) && !(load == S(0)) && row.cwiseProduct(row).sum() == S(0);
}

/// Adds the loads of one list to `ws.loads`, and writes the rows of its states: z' - h(x, v, z) =
/// 0, or -h = 0 for algebraic unknowns.
template <class S>
void add_loads(const Regime& s, const ElementList& list, Workspace<S>& ws, const S* y, const S* yp,
               S* residual) {
  ElementScratch<S>& scratch = ws.elements[index_of(s, list)];
  const element::Shape& shape = list.laws->shape;
  gather<S>(s, list, ws, y, scratch);
  const double* held = s.held(list, ws.time, scratch.held);
  list.laws->evaluate(ws.time, scratch.in.data(), held, scratch.out.data());
  S* out = scratch.out.data();
  const S* in = scratch.in.data();
  const joint::Vec12<S>* rows = scratch.rows.data();
  Index z = list.z0;
  for (const PortData& port : list.ports) {
    if (element::is_along(shape.port) && pulls_nowhere<S>(*in, *out, *rows))
      *out = S(std::numeric_limits<double>::quiet_NaN());
    in += shape.n_in();
    add_load<S>(s, shape, port, out, rows, ws);
    const int rates = shape.n_states - shape.n_algebraic;
    const S* z_dot = out + shape.width;
    for (int k = 0; k < rates; ++k)
      residual[z + k] = yp[z + k] - z_dot[k];
    for (int k = rates; k < shape.n_states; ++k)
      residual[z + k] = -z_dot[k];
    z += shape.n_states;
    rows += element::has_rows(shape.port) ? shape.width : 0;
    out += shape.n_out();
  }
}

} // namespace hydrodae::system
