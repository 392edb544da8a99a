#include "hydrodae/system/jacobian.h"

#include <algorithm>
#include <utility>

#include "hydrodae/system/hydro_gradient.h"
#include "hydrodae/system/morison_gradient.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::system {

namespace {
using Rotation = BodyData::Rotation;
using joint::Matrix12;
using joint::Vector12;
using RowVector3 = Eigen::Matrix<double, 1, 3>;
using RowVector6 = Eigen::Matrix<double, 1, 6>;

/// Collects the places that the assembly visits.
template <Part made> struct PatternSink {
  static constexpr bool whole = made == Part::whole;
  Visits visits, rates; ///< (column, row); rates: those of dF/dy'
  void by_y(Index row, Index column, double) { visits.emplace_back(column, row); }
  void by_yp(Index row, Index column, double) {
    visits.emplace_back(column, row);
    rates.emplace_back(column, row);
  }
};

/// Adds the values into the slots found before.
template <Part made> struct ValueSink {
  static constexpr bool whole = made == Part::whole;
  const Index* slot;
  JacobianParts& out;
  void by_y(Index, Index, double value) { out.by_y[*slot++] += value; }
  void by_yp(Index, Index, double value) { out.by_yp[*slot++] += value; }
};

/// The assembly, written once for both sinks. "Tangent" columns are virtual displacements
/// (translations in world axes, rotations in body axes); they become columns of position unknowns
/// through `tangent` of the body.
template <class Sink> struct Assembly {
  static constexpr bool whole = Sink::whole; ///< else what accelerations need
  const System& s;
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

  /// The same for a derivative `d` with respect to the virtual rotation alone.
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

  /// Momentum rows of `body` lose a load whose derivative is `d` (tangent rows).
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

  /// Position rows of `body` lose E(q) d for a change d of the tangent velocity, column by column:
  /// `emit(row, weights)` with weights (1, 6) of the tangent rows.
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
  void body_rows();
  void hydrodynamics();
  void hydro_body(const HydroBody& i, const Vector6& rate, const Vector6& momentum);
  void hydro_masses();
  void hydro_pair(const HydroBody& i, const HydroBody& j, const Matrix6& L, const Matrix6& Q);
  void memory_columns(const HydroBody& i, const Matrix6& L);
  void phase_columns(const HydroBody& i, const Matrix6& L);
  void memory_rows();
  void morison();
  template <class Law> void force(const BodyForce<Law>& f);
  template <class Law> void force(const MotionForce<Law>& f);

  void run() {
    joints();
    couplers();
    if constexpr (whole) {
      for_each_element(s.body_forces, [&](const auto& f) { force(f); });
      for_each_element(s.motion_forces, [&](const auto& f) { force(f); });
    }
    hydrodynamics();
    morison();
    body_rows();
  }
};

/// What one constraint row adds: its own two rows, and its columns in the rows of the bodies.
/// In index 1 the derivative of u . T u by the pose is left out: it is of the order h^2 u^2 beside
/// the rest, and only slows Newton's iteration.
template <class Sink>
void Assembly<Sink>::constraint_row(const JointData& j, Index lambda, Index mu,
                                    const Vector12& gradient, const Matrix12& curvature,
                                    const Vector12& u) {
  const bool level_1 = whole && s.formulation == Formulation::index_1;
  const bool level_3 = whole && s.formulation == Formulation::index_3 && mu >= 0;
  Vector12 by_pose = level_3 ? gradient : Vector12(curvature.transpose() * u);
  Vector12 by_velocity = gradient;
  if (level_1) {
    const double b = s.baumgarte_rate;
    const double rate = mu < 0 ? b : 2.0 * b, gap = mu < 0 ? 0.0 : b * b;
    const Vector12 u_dot = joint_acceleration<double>(j, ws.state.bodies);
    by_velocity = curvature * u + by_pose + rate * gradient;
    by_pose = (curvature.transpose() * u_dot + rate * by_pose + gap * gradient).eval();
  }
  if (whole && mu >= 0 && s.formulation != Formulation::stabilised)
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
    if (!whole || mu < 0)
      continue;
    if (s.formulation == Formulation::stabilised)
      displacement_columns(mu, b, G);
    position_rows(b, [&](Index r, const RowVector6& weights) { sink.by_y(r, mu, weights.dot(G)); });
  }
}

/// How G^T lambda and G^T mu of a joint turn with the poses of its bodies.
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
      if (!row.kept())
        continue;
      const Vector12 gradient =
          joint::basic_row<double>(row.kind, j.A, j.B, j.parameters, g).gradient;
      const Matrix12 curvature = joint::basic_curvature(row.kind, j.A, j.B, j.parameters, g);
      if constexpr (whole) {
        by_lambda += y[row.lambda] * curvature;
        by_mu += y[row.mu] * curvature;
        shift += y[row.mu] * gradient;
      }
      constraint_row(j, row.lambda, row.mu, gradient, curvature, u);
    }
    if (!whole || j.rows.empty())
      continue;
    constraint_curvature(j, by_lambda, by_mu);
    add_to_bodies<double>(j, shift, ws.state.shifts);
  }
}

template <class Sink> void Assembly<Sink>::couplers() {
  for (const CouplerData& coupler : s.couplers) {
    if (!coupler.kept())
      continue;
    const double mu = coupler.velocity_level ? 0.0 : y[coupler.mu];
    for (const CouplerData::Term& term : coupler.terms) {
      const MotionData& motion = s.motions[term.motion];
      const JointData& j = s.joints[motion.joint];
      const joint::Geometry<double> g = joint_geometry<double>(j, ws.state.bodies);
      const Vector12 gradient =
          term.factor * joint::motion_row<double>(motion.motion, j.A, j.B, g).gradient;
      const Matrix12 curvature = term.factor * joint::motion_curvature(motion.motion, j.A, j.B, g);
      constraint_row(j, coupler.lambda, coupler.velocity_level ? -1 : coupler.mu, gradient,
                     curvature, joint_velocity<double>(j, ws.state.bodies));
      if (!whole)
        continue;
      constraint_curvature(j, y[coupler.lambda] * curvature, mu * curvature);
      add_to_bodies<double>(j, mu * gradient, ws.state.shifts);
    }
  }
}

// Wrench W(xi, twist) in earth axes; load = (W_f, R^T W_m):
//   d xi = (dr, J R_turn dphi), d twist = (dv, -R [w]x dphi + R dw), d(R^T m) = [R^T m]x dphi + R^T
//   dm.
template <class Sink> template <class Law> void Assembly<Sink>::force(const BodyForce<Law>& f) {
  const BodyState<double>& b = state(f.body);
  const Vector6 xi = system::displacement<double>(f, s.bodies[f.body], b, y);
  const Vector6 velocity = twist<double>(b);
  Matrix6 by_xi, by_twist;
  f.law.gradient(xi, velocity, by_xi, by_twist);
  const Vector6 wrench = f.law.template apply<double>(xi, velocity);
  Matrix6 xi_map = Matrix6::Identity(), velocity_map = Matrix6::Identity();
  xi_map.bottomRightCorner<3, 3>() =
      rotation_vector_gradient(xi.tail<3>()) * rotation_matrix<double>(f.turn);
  velocity_map.bottomRightCorner<3, 3>() = b.R;
  Matrix6 d = by_xi * xi_map;
  d.rightCols<3>() -= by_twist.rightCols<3>() * (b.R * skew<double>(b.w));
  Matrix6 d_velocity = by_twist * velocity_map;
  d.bottomRows<3>() = (b.R.transpose() * d.bottomRows<3>()).eval();
  d_velocity.bottomRows<3>() = (b.R.transpose() * d_velocity.bottomRows<3>()).eval();
  d.bottomRightCorner<3, 3>() += skew<double>(b.R.transpose() * wrench.tail<3>());
  load_by_displacement(f.body, f.body, d);
  load_by_velocity(f.body, f.body, d_velocity);
}

// load = f(s, s') W, s' = W.u: d load = f T + W (f_s W + f_s' T^T u)^T, by velocity W f_s' W^T.
template <class Sink> template <class Law> void Assembly<Sink>::force(const MotionForce<Law>& f) {
  const MotionData& motion = s.motions[f.motion];
  const JointData& j = s.joints[motion.joint];
  const joint::Geometry<double> g = joint_geometry<double>(j, ws.state.bodies);
  const joint::Row<double> w = motion_row<double>(s, ws.state, f.motion);
  const Vector12 u = joint_velocity<double>(j, ws.state.bodies);
  const double rate = w.gradient.dot(u);
  const auto [by_s, by_rate] = motion_force_gradient(f, ws.state.past, w.value, rate);
  const Matrix12 curvature = joint::motion_curvature(motion.motion, j.A, j.B, g);
  const Matrix12 d =
      motion_force<double>(f, ws.state.past, w.value, rate) * curvature +
      w.gradient * (by_s * w.gradient + by_rate * curvature.transpose() * u).transpose();
  const Matrix12 d_velocity = by_rate * w.gradient * w.gradient.transpose();
  const std::array<int, 2> body{j.A.body, j.B.body};
  for (int m = 0; m < 2; ++m)
    for (int n = 0; n < 2; ++n) {
      if (body[m] < 0 || body[n] < 0)
        continue;
      load_by_displacement(body[m], body[n], d.block<6, 6>(6 * m, 6 * n));
      load_by_velocity(body[m], body[n], d_velocity.block<6, 6>(6 * m, 6 * n));
    }
}

// Rigid inertia M u' + gyroscopic moment, and the position rows q' - E(q) (u + G^T mu) - sigma p.
template <class Sink> void Assembly<Sink>::body_rows() {
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
    const BodyData& b = s.bodies[i];
    if (b.n_active == 0)
      continue;
    const BodyState<double>& body = state(i);
    Matrix6 mass = Matrix6::Zero(), gyroscopic = Matrix6::Zero();
    mass.topLeftCorner<3, 3>() = b.mass * Matrix3::Identity();
    mass.bottomRightCorner<3, 3>() = b.inertia;
    gyroscopic.bottomRightCorner<3, 3>() =
        skew<double>(body.w) * b.inertia - skew<double>(b.inertia * body.w);
    for (int k = 0; k < b.n_active; ++k) {
      acceleration_columns(b.u0 + k, i, mass.row(b.active[k]));
      if constexpr (whole)
        velocity_columns(b.u0 + k, i, gyroscopic.row(b.active[k]));
    }
    if (!whole)
      continue;
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
        sink.by_y(q + k, q + m, -rate(k, m) - (k == m ? y[b.sigma] : 0.0));
      sink.by_y(q + k, b.sigma, -body.p[k]);
      sink.by_y(b.sigma, q + k, body.p[k]);
    }
  }
}

template <class Sink>
void Assembly<Sink>::hydro_pair(const HydroBody& i, const HydroBody& j, const Matrix6& L,
                                const Matrix6& Q) {
  const Matrix6 A = hydro_block(s.hydro.added_mass, i, j);
  Matrix6 LA = L * A, QA = Q * A; // what multiplies dU' and dU
  if (s.hydro.damped)
    QA += L * hydro_block(s.hydro.damping, i, j);
  if (!s.hydro.convolution.empty() && ws.state.past) {
    LA += L * hydro_block(ws.state.past->by_U_dot, i, j);
    QA += L * hydro_block(ws.state.past->by_U, i, j);
  }
  const HydroMotionGradient d = hydro_motion_gradient(s.hydro.axes, j, state(j.body));
  Matrix6 by_velocity;
  by_velocity << LA * d.a_v + QA * d.U_v, LA * d.a_w + QA * d.U_w;
  const Matrix6 by_acceleration = LA * d.a_acc;
  const Matrix63 by_rotation = LA * d.a_phi + QA * d.U_phi;
  const BodyData& b = s.bodies[i.body];
  for (int k = 0; k < b.n_active; ++k) {
    const Index row = b.u0 + k;
    const int c = b.active[k];
    rotation_columns(row, j.body, by_rotation.row(c));
    velocity_columns(row, j.body, by_velocity.row(c));
    acceleration_columns(row, j.body, by_acceleration.row(c));
  }
}

template <class Sink> void Assembly<Sink>::memory_columns(const HydroBody& i, const Matrix6& L) {
  const BodyData& b = s.bodies[i.body];
  for (int z = 0; z < s.hydro.n_states; ++z) {
    Vector6 column = Vector6::Zero();
    for (int c = 0; c < 6; ++c)
      if (i.moving[c] >= 0)
        column[c] = s.hydro.output(i.moving[c], z);
    if (column.isZero(0.0))
      continue; // constant data: the same entries at every call
    const Vector6 load = L * column;
    for (int k = 0; k < b.n_active; ++k)
      sink.by_y(b.u0 + k, s.hydro.z0 + z, load[b.active[k]]);
  }
}

// load_i = L (A U' + C z) + Q A U with the poses inside L and Q differentiated as well.
template <class Sink>
void Assembly<Sink>::hydro_body(const HydroBody& i, const Vector6& rate, const Vector6& momentum) {
  const HydroLoadGradient d = hydro_load_gradient(s.hydro.axes, i, state(i.body), rate, momentum);
  const BodyData& data = s.bodies[i.body];
  for (int k = 0; k < data.n_active; ++k) {
    rotation_columns(data.u0 + k, i.body, d.by_rotation.row(data.active[k]));
    velocity_columns(data.u0 + k, i.body, d.by_velocity.row(data.active[k]));
  }
  if (!s.hydro.drifting.empty())
    phase_columns(i, d.L);
  for (const HydroBody& j : s.hydro.bodies)
    if (j.moves)
      hydro_pair(i, j, d.L, d.Q);
  memory_columns(i, d.L);
}

/// How the excitation changes with the horizontal displacement of its body.
template <class Sink> void Assembly<Sink>::phase_columns(const HydroBody& i, const Matrix6& L) {
  const BodyData& b = s.bodies[i.body];
  const Eigen::Matrix<double, 6, 2> d = L * excitation_gradient(s, i, state(i.body), t);
  for (int n = 0; n < b.n_translations && b.active[n] < 2; ++n)
    for (int k = 0; k < b.n_active; ++k)
      sink.by_y(b.u0 + k, b.q0 + n, -d(b.active[k], b.active[n]));
}

template <class Sink> void Assembly<Sink>::memory_rows() {
  const HydroData& h = s.hydro;
  for (const HydroData::Block& b : h.blocks) {
    const Index k = h.z0 + b.state;
    sink.by_yp(k, k, 1.0);
    sink.by_y(k, k, -b.a);
    if (!b.pair)
      continue;
    sink.by_yp(k + 1, k + 1, 1.0);
    sink.by_y(k + 1, k + 1, -b.a);
    sink.by_y(k, k + 1, b.b);
    sink.by_y(k + 1, k, -b.b);
  }
  for (std::size_t i = 0; i < h.bodies.size(); ++i) {
    const HydroBody& hb = h.bodies[i];
    const int body = hb.body;
    const BodyData& b = s.bodies[body];
    const HydroMotionGradient d = hydro_motion_gradient(h.axes, hb, state(body));
    for (const HydroData::Input& in : h.inputs) {
      const HydroData::Coordinate& u = h.coordinates[in.coordinate];
      if (u.hydro_body != static_cast<int>(i))
        continue;
      const int c = u.component;
      const Index row = h.z0 + in.state;
      if (h.axes == HydroAxes::yaw || (c < 3) == (h.axes == HydroAxes::body))
        rotation_columns(row, body, -in.value * d.U_phi.row(c));
      for (int k = 0; k < b.n_active; ++k)
        if (const int a = b.active[k]; (a < 3) == (c < 3))
          sink.by_y(row, b.u0 + k, -in.value * (a < 3 ? d.U_v(c, a) : d.U_w(c, a - 3)));
    }
  }
}

/// L A L^T of each pair, all that the accelerations feel of the water at once.
template <class Sink> void Assembly<Sink>::hydro_masses() {
  for (const HydroBody& i : s.hydro.bodies)
    for (const HydroBody& j : s.hydro.bodies) {
      if (!i.moves || !j.moves)
        continue;
      Matrix6 A = hydro_block(s.hydro.added_mass, i, j);
      if (!s.hydro.convolution.empty() && ws.state.past)
        A += hydro_block(ws.state.past->by_U_dot, i, j);
      const Matrix6 mass = hydro_axes(s.hydro.axes, i, state(i.body)) * A *
                           hydro_axes(s.hydro.axes, j, state(j.body)).transpose();
      const BodyData& b = s.bodies[i.body];
      for (int k = 0; k < b.n_active; ++k)
        acceleration_columns(b.u0 + k, j.body, mass.row(b.active[k]));
    }
}

template <class Sink> void Assembly<Sink>::hydrodynamics() {
  const HydroData& h = s.hydro;
  if (h.n_moving == 0)
    return;
  if (!whole)
    return hydro_masses();
  Workspace<double>& w = ws.state;
  hydro_loads<double>(s, w, t, y + h.z0);
  for (const HydroBody& i : h.bodies) {
    if (!i.moves)
      continue;
    Vector6 rate = Vector6::Zero(), momentum = Vector6::Zero();
    for (int c = 0; c < 6; ++c) {
      if (i.moving[c] < 0)
        continue;
      rate[c] = w.inertia_force[i.moving[c]];
      momentum[c] = w.momentum[i.moving[c]];
    }
    hydro_body(i, rate, momentum);
  }
  memory_rows();
}

template <class Sink> void Assembly<Sink>::morison() {
  for (const MorisonData& m : s.morison) {
    const BodyData& b = s.bodies[m.body];
    if (b.n_active == 0)
      continue;
    const LoadGradient d = morison_gradient(s.water, m, state(m.body), t, ws.state.fluid, ws.fluid);
    if constexpr (whole) {
      load_by_displacement(m.body, m.body, d.by_displacement);
      load_by_velocity(m.body, m.body, d.by_velocity);
    }
    for (int k = 0; k < b.n_active; ++k)
      acceleration_columns(b.u0 + k, m.body, -d.by_acceleration.row(b.active[k]));
  }
}

/// Kinematics, past and tangent maps at (t, y, y'): d phi = 2 L(p)^T dp / |p|^2.
void prepare(const System& s, JacobianWorkspace& ws, double t, const double* y, const double* yp) {
  unpack<double>(s, y, yp, ws.state.bodies);
  ws.state.time = t;
  ws.state.past = past_at(s, t);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    ws.state.shifts[i].setZero();
    const Vector4& p = ws.state.bodies[i].p;
    if (s.bodies[i].rotation == Rotation::free)
      ws.rotation[i] = 2.0 / p.squaredNorm() * quaternion_rate_matrix<double>(p).transpose();
  }
}

template <Part made> Pattern pattern_of(const System& system) {
  JacobianWorkspace ws(system);
  const VectorX y = initial_state(system), yp = VectorX::Zero(system.n);
  prepare(system, ws, 0.0, y.data(), yp.data());
  PatternSink<made> sink;
  Assembly<PatternSink<made>>{system, ws, 0.0, y.data(), yp.data(), sink}.run();
  Pattern pattern = make_pattern(system.n, sink.visits, sink.rates);
  pattern.part = made;
  return pattern;
}

template <Part made>
void fill(const System& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
          const double* y, const double* yp, JacobianParts& out) {
  ValueSink<made> sink{pattern.slots.data(), out};
  Assembly<ValueSink<made>>{system, ws, t, y, yp, sink}.run();
}

} // namespace

JacobianWorkspace::JacobianWorkspace(const System& system)
    : state(system), rotation(system.bodies.size(), Eigen::Matrix<double, 3, 4>::Zero()),
      fluid(state.fluid.size()) {}

Pattern find_pattern(const System& system, Part part) {
  return part == Part::whole ? pattern_of<Part::whole>(system)
                             : pattern_of<Part::accelerations>(system);
}

void jacobian(const System& system, const Pattern& pattern, JacobianWorkspace& ws, double t,
              const double* y, const double* yp, JacobianParts& out) {
  std::fill(out.by_y.begin(), out.by_y.end(), 0.0);
  std::fill(out.by_yp.begin(), out.by_yp.end(), 0.0);
  prepare(system, ws, t, y, yp);
  if (pattern.part == Part::whole)
    fill<Part::whole>(system, pattern, ws, t, y, yp, out);
  else
    fill<Part::accelerations>(system, pattern, ws, t, y, yp, out);
}

} // namespace hydrodae::system
