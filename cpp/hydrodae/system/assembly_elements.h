#pragma once
/// Part of the assembly (assembly.h) for the laws of System::elements.

#include "hydrodae/system/assembly.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::system {

/// Load W^T f(x, v, z) on the bodies, and rows z' - h(x, v, z) = 0, from the Jacobian d(f, h) /
/// d(x, v, z) of the law, column by column.
template <class Sink>
template <int w, int n>
void Assembly<Sink>::law(const PortGradient<w, n>& port, const std::array<int, 2>& bodies,
                         const double* jacobian, const element::Shape& shape, Index z) {
  const int n_states = shape.n_states;
  const Eigen::Map<const MatrixX> J(jacobian, w + n_states, shape.n_in());
  const Eigen::Matrix<double, w, w> f_x = J.template topLeftCorner<w, w>(),
                                    f_v = J.template block<w, w>(0, w);
  const Eigen::Matrix<double, n, w> W_T = port.W.transpose();
  const Eigen::Matrix<double, n, n> by_xi = W_T * (f_x * port.x_xi + f_v * port.v_xi) + port.turn;
  const Eigen::Matrix<double, n, n> by_u = W_T * (f_v * port.v_u);
  constexpr int sides = n / 6;
  for (int a = 0; a < sides; ++a)
    for (int b = 0; b < sides; ++b) {
      if (bodies[a] < 0 || bodies[b] < 0)
        continue;
      load_by_displacement(bodies[a], bodies[b], by_xi.template block<6, 6>(6 * a, 6 * b));
      load_by_velocity(bodies[a], bodies[b], by_u.template block<6, 6>(6 * a, 6 * b));
    }
  for (int k = 0; k < n_states; ++k) {
    const Eigen::Matrix<double, n, 1> by_z =
        W_T * J.template block<w, 1>(0, shape.n_in() - n_states + k);
    const Eigen::Matrix<double, 1, w> h_x = J.template block<1, w>(w + k, 0),
                                      h_v = J.template block<1, w>(w + k, w);
    const Eigen::Matrix<double, 1, n> rate_by_xi = -(h_x * port.x_xi + h_v * port.v_xi),
                                      rate_by_u = -(h_v * port.v_u);
    for (int a = 0; a < sides; ++a) {
      if (bodies[a] < 0)
        continue;
      const BodyData& body = s.bodies[bodies[a]];
      for (int c = 0; c < body.n_active; ++c)
        sink.by_y(body.u0 + c, z + k, -by_z[6 * a + body.active[c]]);
      displacement_columns(z + k, bodies[a], rate_by_xi.template segment<6>(6 * a));
      velocity_columns(z + k, bodies[a], rate_by_u.template segment<6>(6 * a));
    }
  }
  law_states(jacobian, shape, z);
}

/// Derivatives of the rows of a law by its own unknowns.
template <class Sink>
void Assembly<Sink>::law_states(const double* jacobian, const element::Shape& shape, Index z) {
  const int n = shape.n_states;
  const Eigen::Map<const MatrixX> J(jacobian, shape.n_out(), shape.n_in());
  for (int k = 0; k < n; ++k) {
    if (k < n - shape.n_algebraic)
      sink.by_yp(z + k, z + k, 1.0);
    for (int m = 0; m < n; ++m)
      sink.by_y(z + k, z + m, -J(shape.width + k, shape.n_in() - n + m));
  }
}

/// Derivatives of a law by the multipliers of its joint, for laws that depend on the reaction.
template <class Sink>
void Assembly<Sink>::law_by_reaction(const PortData& data, const PortGradient<1, 12>& port,
                                     const double* jacobian, const element::Shape& shape, Index z) {
  const JointData& j = s.joints[static_cast<std::size_t>(data.joint)];
  const Eigen::Map<const MatrixX> J(jacobian, shape.n_out(), shape.n_in());
  for (const PortData::Pressing& p : data.reaction) {
    const Index lambda = s.lambda(j.rows[p.row]);
    const auto by_lambda = [&](Index row) { return J.row(row).segment<6>(2).dot(p.on_b); };
    const double load = by_lambda(0);
    for (int side = 0; side < 2; ++side) {
      const int body = side == 0 ? j.A.body : j.B.body;
      if (body < 0)
        continue;
      const BodyData& b = s.bodies[static_cast<std::size_t>(body)];
      for (int k = 0; k < b.n_active; ++k)
        sink.by_y(b.u0 + k, lambda, -load * port.W(0, 6 * side + b.active[k]));
    }
    for (int k = 0; k < shape.n_states; ++k)
      sink.by_y(z + k, lambda, -by_lambda(1 + k));
  }
}

/// Law along several motions: load W_b^T f_b(x, v, z), differentiated by each motion a,
///
///   dx_a = W_a dxi,   dv_a = W_a du + (T_a^T u) dxi,   d(W_a^T f_a) = f_a T_a dxi
template <class Sink>
void Assembly<Sink>::law_of_coordinates(const PortData& port, const Vector12* rows,
                                        const double* load, const double* jacobian,
                                        const element::Shape& shape, Index z) {
  const Index w = shape.width, n_states = shape.n_states;
  const Eigen::Map<const MatrixX> J(jacobian, shape.n_out(), shape.n_in());
  law_states(jacobian, shape, z);
  const auto joined = [&](Index a) -> const JointData& {
    return joint_of(s.system, port.motions[static_cast<std::size_t>(a)]);
  };
  const auto each_side = [&](const JointData& j, auto&& visit) {
    for (const auto& [body, first] : {std::pair{j.A.body, 0}, std::pair{j.B.body, 6}})
      if (body >= 0)
        visit(body, first);
  };
  for (Index a = 0; a < w; ++a) {
    const JointData& j = joined(a);
    const auto motion = static_cast<std::size_t>(port.motions[static_cast<std::size_t>(a)]);
    const Matrix12 T = joint::motion_curvature(s.motions[motion].motion, j.A, j.B,
                                               joint_geometry<double>(j, ws.state.bodies));
    const Vector12 turned = T.transpose() * joint_velocity<double>(j, ws.state.bodies);
    each_side(j, [&](int body, int at) {
      const RowVector6 by_u = rows[a].segment<6>(at).transpose(),
                       turns = turned.segment<6>(at).transpose();
      each_side(j, [&](int other, int from) {
        load_by_displacement(other, body, load[a] * T.block<6, 6>(from, at));
      });
      for (Index b = 0; b < w; ++b)
        each_side(joined(b), [&](int other, int from) {
          const Vector6 arm = rows[b].segment<6>(from);
          load_by_displacement(other, body, arm * (J(b, a) * by_u + J(b, w + a) * turns));
          load_by_velocity(other, body, arm * (J(b, w + a) * by_u));
        });
      const BodyData& moved = s.bodies[static_cast<std::size_t>(body)];
      for (Index k = 0; k < n_states; ++k) {
        displacement_columns(z + k, body, -(J(w + k, a) * by_u + J(w + k, w + a) * turns));
        velocity_columns(z + k, body, -J(w + k, w + a) * by_u);
        for (int c = 0; c < moved.n_active; ++c)
          sink.by_y(moved.u0 + c, z + k, -J(a, 2 * w + k) * by_u[moved.active[c]]);
      }
    });
  }
}

/// Law on points of bodies, with a full Jacobian.
template <class Sink>
void Assembly<Sink>::law_of_points(const PortData& port, const double* load, const double* jacobian,
                                   const element::Shape& shape, Index z) {
  using Matrix36 = Eigen::Matrix<double, 3, 6>;
  const auto n = static_cast<Index>(port.points.size()), w = 3 * n;
  const int n_states = shape.n_states;
  const Eigen::Map<const MatrixX> J(jacobian, w + n_states, 2 * w + n_states);
  law_states(jacobian, shape, z);
  for (Index a = 0; a < n; ++a) {
    const joint::Marker& point = port.points[static_cast<std::size_t>(a)];
    if (point.body < 0)
      continue;
    const PointGradient seen = point_gradient(state(point.body), point.point, load + 3 * a);
    const Matrix36 &A = seen.A, &V = seen.V;
    load_by_displacement(point.body, point.body, seen.turn);
    for (Index b = 0; b < n; ++b) { // derivatives of all loads by the motion of this point
      const joint::Marker& other = port.points[static_cast<std::size_t>(b)];
      if (other.body < 0)
        continue;
      const Matrix3 f_x = J.block<3, 3>(3 * b, 3 * a), f_v = J.block<3, 3>(3 * b, w + 3 * a);
      const BodyState<double>& o = state(other.body);
      Matrix36 arm;
      arm << Matrix3::Identity(), -o.R * skew<double>(other.point);
      load_by_displacement(other.body, point.body, arm.transpose() * (f_x * A + f_v * V));
      load_by_velocity(other.body, point.body, arm.transpose() * (f_v * A));
    }
    const BodyData& body = s.bodies[point.body];
    for (Index k = 0; k < n_states; ++k) {
      const Eigen::Matrix<double, 1, 3> h_x = J.block<1, 3>(w + k, 3 * a),
                                        h_v = J.block<1, 3>(w + k, w + 3 * a);
      displacement_columns(z + k, point.body, -(h_x * A + h_v * V));
      velocity_columns(z + k, point.body, -(h_v * A));
      const Vector6 by_z = A.transpose() * J.block<3, 1>(3 * a, 2 * w + k);
      for (int c = 0; c < body.n_active; ++c)
        sink.by_y(body.u0 + c, z + k, -by_z[body.active[c]]);
    }
  }
}

/// Law on points of bodies, with the nonzeros of its Jacobian listed in `sparsity`.
template <class Sink>
void Assembly<Sink>::sparse_law_of_points(const PortData& port, const double* load,
                                          const double* values, const element::Elements& laws,
                                          Index z) {
  using Matrix36 = Eigen::Matrix<double, 3, 6>;
  const element::Shape& shape = laws.shape;
  const int w = shape.width;
  std::array<PointGradient, element::most_sparse_points> seen;
  for (std::size_t a = 0; a < port.points.size(); ++a)
    if (const joint::Marker& point = port.points[a]; point.body >= 0) {
      seen[a] = point_gradient(state(point.body), point.point, load + 3 * a);
      load_by_displacement(point.body, point.body, seen[a].turn);
    }
  for (int k = 0; k < shape.n_states - shape.n_algebraic; ++k)
    sink.by_yp(z + k, z + k, 1.0);
  // Derivatives by the motion of one body: rows (1, 6) by its displacement and its velocity.
  const auto of_motion = [&](int column, double value, auto&& emit) {
    const bool rate = column >= w;
    const int at = rate ? column - w : column;
    const auto a = static_cast<std::size_t>(at / 3);
    if (const int body = port.points[a].body; body >= 0) {
      const RowVector6 by_x = value * (rate ? seen[a].V : seen[a].A).row(at % 3);
      emit(body, by_x,
           RowVector6(rate ? RowVector6(value * seen[a].A.row(at % 3))
                           : RowVector6(RowVector6::Zero())));
    }
  };
  for (const auto& place : laws.sparsity) {
    const int row = place[0], column = place[1];
    const double value = *values++;
    if (row >= w) {
      if (column >= 2 * w)
        sink.by_y(z + row - w, z + column - 2 * w, -value);
      else
        of_motion(column, -value, [&](int body, const RowVector6& by_x, const RowVector6& by_v) {
          displacement_columns(z + row - w, body, by_x);
          velocity_columns(z + row - w, body, by_v);
        });
      continue;
    }
    const joint::Marker& loaded = port.points[static_cast<std::size_t>(row / 3)];
    if (loaded.body < 0)
      continue;
    const BodyData& body = s.bodies[loaded.body];
    const Matrix36& arm = seen[static_cast<std::size_t>(row / 3)].A;
    for (int c = 0; c < body.n_active; ++c) {
      const double lost = -value * arm(row % 3, body.active[c]);
      if (column >= 2 * w)
        sink.by_y(body.u0 + c, z + column - 2 * w, lost);
      else
        of_motion(column, lost, [&](int other, const RowVector6& by_x, const RowVector6& by_v) {
          displacement_columns(body.u0 + c, other, by_x);
          velocity_columns(body.u0 + c, other, by_v);
        });
    }
  }
}

/// Load in the water; the Jacobian is by the tangent coordinates of the body that the law reads.
template <class Sink>
void Assembly<Sink>::law_in_water(const PortData& port, const double* jacobian, bool feels_rates) {
  const int body = port.body, seen = port.seen();
  const Eigen::Map<const Eigen::Matrix<double, 6, 18>> J(jacobian);
  if constexpr (whole)
    load_by_displacement(body, seen, J.template leftCols<6>());
  if (!feels_rates)
    return;
  if constexpr (whole)
    load_by_velocity(body, seen, J.template middleCols<6>(6));
  load_by_acceleration(body, seen, J.template rightCols<6>());
}

template <class Sink> void Assembly<Sink>::add(const ElementList& list) {
  using element::Port;
  const element::Shape& shape = list.laws->shape;
  if (!whole && !(shape.in_water() && shape.feels_rates))
    return;
  ElementScratch<double>& scratch = ws.state.elements[index_of(s, list)];
  gather<double>(s, list, ws.state, y, scratch);
  const double* in = scratch.in.data();
  const double* signals = s.held(list, t, scratch.held);
  if (!shape.in_water()) // laws in water: the Jacobian already contains the rotation of the load
    list.laws->evaluate(t, in, signals, scratch.out.data());
  list.laws->jacobian(t, in, signals, ws.element_jacobian.data());
  const double *load = scratch.out.data(), *J = ws.element_jacobian.data();
  const Vector12* rows = scratch.rows.data();
  Index z = list.z0;
  for (const PortData& port : list.ports) {
    if (!list.laws->sparsity.empty()) {
      sparse_law_of_points(port, load, J, *list.laws, z);
    } else if (shape.port == Port::points) {
      law_of_points(port, load, J, shape, z);
    } else if (shape.port == Port::along_coordinates) {
      law_of_coordinates(port, rows, load, J, shape, z);
      rows += shape.width;
    } else if (shape.in_water()) {
      law_in_water(port, J, shape.feels_rates);
    } else if (shape.port == Port::on_body) {
      PortGradient<6, 6> d;
      body_gradient(state(port.body), port, in, load, d);
      law<6, 6>(d, {port.body, -1}, J, shape, z);
    } else {
      const JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
      const std::array<int, 2> bodies{j.A.body, j.B.body};
      if (shape.port == Port::between) {
        PortGradient<6, 12> d;
        marker_gradient(s, ws.state, port, in, rows, load, d);
        law<6, 12>(d, bodies, J, shape, z);
      } else {
        PortGradient<1, 12> d;
        motion_gradient(s, ws.state, port, *rows, *load, *J, d);
        law<1, 12>(d, bodies, J, shape, z);
        if (shape.n_reaction > 0)
          law_by_reaction(port, d, J, shape, z);
      }
      rows += shape.width;
    }
    in += shape.n_in();
    load += shape.n_out();
    J += list.laws->jacobian_size();
    z += shape.n_states;
  }
}

} // namespace hydrodae::system
