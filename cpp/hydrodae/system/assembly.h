#pragma once
/// Assembly of the Jacobian: constraint rows and rigid bodies. assembly_elements.h has the laws,
/// assembly_water.h the water.

#include "hydrodae/math/dual.h"
#include "hydrodae/system/mass.h"
#include "hydrodae/system/port_gradient.h"

namespace hydrodae::system {

using joint::Matrix12;
using joint::Vector12;
using RowVector3 = Eigen::Matrix<double, 1, 3>;
using RowVector6 = Eigen::Matrix<double, 1, 6>;

/// Assembly, one template for both sinks (pattern and values). "Tangent" columns are virtual
/// displacements: translations in world axes, rotations in body axes. The map `tangent` of the body
/// turns them into columns of position unknowns.
template <class Sink> struct Assembly {
  using Rotation = BodyData::Rotation;
  /// True: all entries; false: only those that accelerations need
  static constexpr bool whole = Sink::whole;
  static constexpr bool memory = Sink::memory; ///< false: memory rows are rows of the identity
  const Regime& s;
  JacobianWorkspace& ws;
  const double t;
  const double* y;
  const double* yp;
  Sink& sink;

  const BodyState<double>& state(int body) const { return ws.state.bodies[body]; }

  /// Row `row`, derivative `d` with respect to the virtual displacement of `body`.
  void displacement_columns(Index row, int body, const RowVector6& d) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_translations; ++k)
      sink.by_y(row, b.q0 + k, d[b.active[k]]);
    rotation_columns(row, body, d.tail<3>());
  }

  /// Derivative `d` of row `row` with respect to the virtual rotation of `body` alone.
  void rotation_columns(Index row, int body, const RowVector3& d) {
    const BodyData& b = s.bodies[body];
    const Index q = b.q0 + b.n_translations;
    if (b.rotation == Rotation::about_axis)
      sink.by_y(row, q, d[b.axis]);
    if (b.rotation == Rotation::free)
      for (int k = 0; k < 4; ++k)
        sink.by_y(row, q + k, d.dot(ws.rotation[body].col(k)));
  }

  void velocity_columns(Index row, int body, const RowVector6& d) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      sink.by_y(row, b.u0 + k, d[b.active[k]]);
  }

  void acceleration_columns(Index row, int body, const RowVector6& d) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      sink.by_yp(row, b.u0 + k, d[b.active[k]]);
  }

  /// Subtracts from the momentum rows of `body` a load with the derivative `d` (tangent rows).
  void load_by_displacement(int body, int other, const Matrix6& d) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      displacement_columns(b.u0 + k, other, -d.row(b.active[k]));
  }
  void load_by_velocity(int body, int other, const Matrix6& d) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      velocity_columns(b.u0 + k, other, -d.row(b.active[k]));
  }
  void load_by_acceleration(int body, int other, const Matrix6& d) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      acceleration_columns(b.u0 + k, other, -d.row(b.active[k]));
  }

  /// Subtracts from the position rows of `body` E(q) d, for a change d of the tangent velocity,
  /// column by column: `emit(row, weights)` with weights (1, 6) of the tangent rows.
  template <class Emit> void position_rows(int body, Emit&& emit) {
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      if (b.active[k] < 3 || b.rotation == Rotation::about_axis) {
        RowVector6 weights = RowVector6::Zero();
        weights[b.active[k]] = -1.0;
        emit(b.q0 + k, weights);
      }
    if (b.rotation != Rotation::free)
      return;
    const Eigen::Matrix<double, 4, 3> l = quaternion_rate_matrix<double>(state(body).p);
    for (int k = 0; k < 4; ++k) {
      RowVector6 weights = RowVector6::Zero();
      weights.tail<3>() = -0.5 * l.row(k);
      emit(b.q0 + b.n_translations + k, weights);
    }
  }

  void constraint_row(const JointData& j, Index lambda, Index mu, const Vector12& gradient,
                      const Matrix12& curvature, const Vector12& u);
  void constraint_curvature(const JointData& j, const Matrix12& by_lambda, const Matrix12& by_mu);
  void joints();
  void couplers();
  void velocity_row(const JointData& j, Index lambda, double factor, const joint::Row<Dual>& row,
                    const Vector12& u);
  void joint_accelerations();
  void coupler_accelerations();
  void masses();
  void body_rows();
  void add(const ElementList& list);
  void add(const HydroData& hydro);
  void hydro_body(std::size_t number, const Vector6& rate, const Vector6& momentum);
  void table_columns(std::size_t number, const water::HydroLoadGradient& load);
  void partner_columns(std::size_t i, std::size_t j, const Matrix6& L, const Matrix6& Q);
  void radiation_columns(std::size_t number, const Matrix6& L);
  void radiation_rows();
  template <int w, int n>
  void law(const PortGradient<w, n>& port, const std::array<int, 2>& bodies, const double* jacobian,
           const element::Shape& shape, Index z);
  void law_of_points(const PortData& port, const double* load, const double* jacobian,
                     const element::Shape& shape, Index z);
  void law_of_coordinates(const PortData& port, const Vector12* rows, const double* load,
                          const double* jacobian, const element::Shape& shape, Index z);
  void law_by_reaction(const PortData& data, const PortGradient<1, 12>& port,
                       const double* jacobian, const element::Shape& shape, Index z);
  void sparse_law_of_points(const PortData& port, const double* load, const double* values,
                            const element::Elements& laws, Index z);
  void law_states(const double* jacobian, const element::Shape& shape, Index z);
  void law_in_water(const PortData& port, const double* jacobian, bool feels_rates);

  void run() {
    if constexpr (whole) {
      joints();
      couplers();
    } else {
      masses();
      joint_accelerations();
      coupler_accelerations();
    }
    for_each_list(s, [&](const auto& list) { add(list); });
    if constexpr (whole) {
      masses();
      body_rows();
    }
  }
};

/// Columns of one constraint: its two rows, and its reaction in the momentum rows of the bodies.
/// Index 1 omits the derivative of u . T u by the pose: it is of order h^2 u^2 relative to the rest
/// and only slows Newton's iteration.
template <class Sink>
void Assembly<Sink>::constraint_row(const JointData& j, Index lambda, Index mu,
                                    const Vector12& gradient, const Matrix12& curvature,
                                    const Vector12& u) {
  const bool level_1 = s.formulation == Formulation::index_1;
  const bool level_3 = s.formulation == Formulation::index_3 && mu >= 0;
  Vector12 by_pose = level_3 ? gradient : Vector12(curvature.transpose() * u);
  Vector12 by_velocity = gradient;
  if (level_1) {
    const double b = s.baumgarte_rate;
    const double rate = mu < 0 ? b : 2.0 * b, gap = mu < 0 ? 0.0 : b * b;
    const Vector12 u_dot = joint_acceleration<double>(j, ws.state.bodies);
    by_velocity = curvature * u + by_pose + rate * gradient;
    by_pose = (curvature.transpose() * u_dot + rate * by_pose + gap * gradient).eval();
  }
  if (mu >= 0 && s.formulation != Formulation::stabilised)
    sink.by_y(mu, mu, 1.0);
  for (int side = 0; side < 2; ++side) {
    const int b = side == 0 ? j.A.body : j.B.body;
    if (b < 0 || s.bodies[b].n_active == 0)
      continue;
    const RowVector6 G = gradient.segment<6>(6 * side).transpose();
    if (!level_3)
      velocity_columns(lambda, b, by_velocity.segment<6>(6 * side).transpose());
    if (level_1)
      acceleration_columns(lambda, b, G);
    displacement_columns(lambda, b, by_pose.segment<6>(6 * side).transpose());
    for (int k = 0; k < s.bodies[b].n_active; ++k)
      sink.by_y(s.bodies[b].u0 + k, lambda, -G[s.bodies[b].active[k]]);
    if (mu < 0)
      continue;
    if (s.formulation == Formulation::stabilised)
      displacement_columns(mu, b, G);
    position_rows(b, [&](Index r, const RowVector6& weights) { sink.by_y(r, mu, weights.dot(G)); });
  }
}

/// Derivatives of G^T lambda and G^T mu of a joint by the poses of its bodies.
template <class Sink>
void Assembly<Sink>::constraint_curvature(const JointData& j, const Matrix12& by_lambda,
                                          const Matrix12& by_mu) {
  const std::array<int, 2> body{j.A.body, j.B.body};
  for (int m = 0; m < 2; ++m)
    for (int n = 0; n < 2; ++n) {
      if (body[m] < 0 || body[n] < 0)
        continue;
      load_by_displacement(body[m], body[n], by_lambda.block<6, 6>(6 * m, 6 * n));
      const Matrix6 d_shift = by_mu.block<6, 6>(6 * m, 6 * n);
      position_rows(body[m], [&](Index r, const RowVector6& weights) {
        displacement_columns(r, body[n], weights * d_shift);
      });
    }
}

template <class Sink> void Assembly<Sink>::joints() {
  for (const JointData& j : s.joints) {
    const joint::Geometry<double> g = joint_geometry<double>(j, ws.state.bodies);
    const Vector12 u = joint_velocity<double>(j, ws.state.bodies);
    Matrix12 by_lambda = Matrix12::Zero(), by_mu = Matrix12::Zero();
    Vector12 shift = Vector12::Zero();
    for (const RowData& row : j.rows) {
      if (!s.holds(row))
        continue;
      const Vector12 gradient =
          joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient;
      const Matrix12 curvature = joint::basic_curvature(row.kind, j.A, j.B, j.parameters, g);
      by_lambda += y[s.lambda(row)] * curvature;
      by_mu += y[s.mu(row)] * curvature;
      shift += y[s.mu(row)] * gradient;
      constraint_row(j, s.lambda(row), s.mu(row), gradient, curvature, u);
    }
    if (j.rows.empty())
      continue;
    constraint_curvature(j, by_lambda, by_mu);
    add_to_bodies<double>(j, shift, ws.state.shifts);
  }
}

template <class Sink> void Assembly<Sink>::couplers() {
  for (const CouplerData& coupler : s.couplers) {
    if (!s.holds(coupler))
      continue;
    const double mu = coupler.velocity_level ? 0.0 : y[s.mu(coupler)];
    for (const CouplerData::Term& term : coupler.terms) {
      const MotionData& motion = s.motions[term.motion];
      const JointData& j = s.joints[motion.joint];
      const joint::Geometry<double> g = joint_geometry<double>(j, ws.state.bodies);
      const Vector12 gradient =
          term.factor * joint::motion_row<double>(motion.motion, j.A, j.B, g).gradient;
      const Matrix12 curvature = term.factor * joint::motion_curvature(motion.motion, j.A, j.B, g);
      constraint_row(j, s.lambda(coupler), coupler.velocity_level ? -1 : s.mu(coupler), gradient,
                     curvature, joint_velocity<double>(j, ws.state.bodies));
      constraint_curvature(j, y[s.lambda(coupler)] * curvature, mu * curvature);
      add_to_bodies<double>(j, mu * gradient, ws.state.shifts);
    }
  }
}

/// Poses of the bodies of a joint, with their rates as dual parts.
inline joint::Geometry<Dual> moving_geometry(const JointData& j,
                                             const std::vector<BodyState<double>>& bodies) {
  Vec3<Dual> r[2];
  Mat3<Dual> R[2];
  const int body[2] = {j.A.body, j.B.body};
  for (int side = 0; side < 2; ++side) {
    if (body[side] < 0) {
      r[side].setZero();
      R[side].setIdentity();
      continue;
    }
    const BodyState<double>& state = bodies[static_cast<std::size_t>(body[side])];
    const Matrix3 rate = state.R * skew<double>(state.w);
    for (int k = 0; k < 3; ++k)
      r[side][k] = {state.r[k], state.v[k]};
    for (int k = 0; k < 9; ++k)
      R[side].data()[k] = {state.R.data()[k], rate.data()[k]};
  }
  return joint::geometry<Dual>(j.B, r[0], R[0], r[1], R[1]);
}

/// Row of G of one velocity constraint, and its (dG/dt) u.
template <class Sink>
void Assembly<Sink>::velocity_row(const JointData& j, Index lambda, double factor,
                                  const joint::Row<Dual>& row, const Vector12& u) {
  double rate = 0.0;
  for (int k = 0; k < 12; ++k)
    rate += row.gradient[k].b * u[k];
  sink.row_rate(lambda - s.lambda0, factor * rate);
  for (int side = 0; side < 2; ++side) {
    const int b = side == 0 ? j.A.body : j.B.body;
    if (b < 0)
      continue;
    const BodyData& data = s.bodies[b];
    for (int k = 0; k < data.n_active; ++k) {
      const double G = factor * row.gradient[6 * side + data.active[k]].a;
      sink.by_y(lambda, data.u0 + k, G);
      sink.by_y(data.u0 + k, lambda, -G);
    }
  }
}

template <class Sink> void Assembly<Sink>::joint_accelerations() {
  for (const JointData& j : s.joints) {
    if (std::none_of(j.rows.begin(), j.rows.end(),
                     [this](const RowData& row) { return s.holds(row); }))
      continue;
    const joint::Geometry<Dual> g = moving_geometry(j, ws.state.bodies);
    const Vector12 u = joint_velocity<double>(j, ws.state.bodies);
    for (const RowData& row : j.rows)
      if (s.holds(row))
        velocity_row(j, s.lambda(row), 1.0,
                     joint::basic_row<Dual>(row.kind, j.A, j.B, j.parameters, g), u);
  }
}

template <class Sink> void Assembly<Sink>::coupler_accelerations() {
  for (const CouplerData& coupler : s.couplers) {
    if (!s.holds(coupler))
      continue;
    for (const CouplerData::Term& term : coupler.terms) {
      const MotionData& motion = s.motions[term.motion];
      const JointData& j = s.joints[motion.joint];
      velocity_row(
          j, s.lambda(coupler), term.factor,
          joint::motion_row<Dual>(motion.motion, j.A, j.B, moving_geometry(j, ws.state.bodies)),
          joint_velocity<double>(j, ws.state.bodies));
    }
  }
}

/// Mass matrix times accelerations, (M + D A_inf D^T) u'.
template <class Sink> void Assembly<Sink>::masses() {
  find_water_axes(s, ws);
  if (sink.take_mass(ws))
    return;
  mass(s, ws, [this](int i, int j, const Matrix6& block) {
    const BodyData& b = s.bodies[i];
    for (int k = 0; k < b.n_active; ++k)
      acceleration_columns(b.u0 + k, j, block.row(b.active[k]));
  });
  sink.keep_mass(ws, s.hydro.added_mass.tables.empty() && !ws.state.past);
}

// Gyroscopic moments in the momentum rows; position rows q' - E(q) (u + G^T mu) - sigma p.
template <class Sink> void Assembly<Sink>::body_rows() {
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
    const BodyData& b = s.bodies[i];
    if (b.n_active == 0)
      continue;
    const BodyState<double>& body = state(i);
    Matrix6 gyroscopic = Matrix6::Zero();
    gyroscopic.bottomRightCorner<3, 3>() = gyroscopic_matrix(b.inertia, body.w);
    for (int k = 0; k < b.n_active; ++k)
      velocity_columns(b.u0 + k, i, gyroscopic.row(b.active[k]));
    position_rows(i, [&](Index row, const RowVector6& weights) {
      sink.by_yp(row, row, 1.0);
      velocity_columns(row, i, weights);
    });
    if (b.rotation != Rotation::free)
      continue;
    const Index q = b.q0 + b.n_translations;
    const Eigen::Matrix4d rate =
        0.5 * quaternion_right_matrix(body.w + ws.state.shifts[i].tail<3>());
    for (int k = 0; k < 4; ++k) {
      for (int m = 0; m < 4; ++m)
        sink.by_y(q + k, q + m, -rate(k, m) - (k == m ? y[s.sigma(b)] : 0.0));
      sink.by_y(q + k, s.sigma(b), -body.p[k]);
      sink.by_y(s.sigma(b), q + k, body.p[k]);
    }
  }
}

} // namespace hydrodae::system
