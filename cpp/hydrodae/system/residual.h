#pragma once
/// The residual F(t, y, y') of the stabilised index-2 equations (see system.h). Pure: the Regime is
/// const, the Workspace is scratch. Templated on the scalar so that dual numbers can check the
/// Jacobian.

#include "hydrodae/system/elements.h"
#include "hydrodae/system/hydrodynamics.h"

namespace hydrodae::system {

/// Writes the two rows of a constraint in the formulation of the run (see regime.h), from its gap,
/// rate and acceleration; `mu` < 0: a row at velocity level.
template <class S>
void constraint_rows(const Regime& s, const S* y, Index lambda, Index mu, const S& gap,
                     const S& rate, const S& acceleration, S* residual) {
  if (mu >= 0)
    residual[mu] = s.formulation == Formulation::stabilised ? gap : y[mu];
  if (s.formulation == Formulation::index_3 && mu >= 0) {
    residual[lambda] = gap;
  } else if (s.formulation == Formulation::index_1) {
    const S b = S(s.baumgarte_rate);
    residual[lambda] =
        mu < 0 ? acceleration + b * rate : acceleration + S(2) * b * rate + b * b * gap;
  } else {
    residual[lambda] = rate;
  }
}

/// Acceleration of a row, gradient . u' + u . (d gradient / dt), for index 1; zero elsewhere.
/// (Index 1 is for comparisons in double; other scalars only compile.)
template <class S, class Curvature>
S row_acceleration(const Regime& s, const Workspace<S>& ws, const JointData& j,
                   const joint::Vec12<S>& gradient, const joint::Vec12<S>& u,
                   Curvature&& curvature) {
  if (s.formulation != Formulation::index_1)
    return S(0);
  const joint::Vec12<S> u_dot = joint_acceleration<S>(j, ws.bodies);
  const joint::Vec12<S> turned = curvature().template cast<S>() * u;
  return gradient.cwiseProduct(u_dot).sum() + u.cwiseProduct(turned).sum();
}

/// Poses without derivatives, as the hand-written curvature needs them.
template <class S>
joint::Geometry<double> geometry_values(const JointData& j, const Workspace<S>& ws) {
  auto plain = [](const auto& x) {
    return x.unaryExpr([](const S& v) { return joint::value_of(v); }).eval();
  };
  const Vector3 origin = Vector3::Zero();
  const Matrix3 identity = Matrix3::Identity();
  const bool a = j.A.body >= 0, b = j.B.body >= 0;
  return joint::geometry<double>(j.B, a ? Vector3(plain(ws.bodies[j.A.body].r)) : origin,
                                 a ? Matrix3(plain(ws.bodies[j.A.body].R)) : identity,
                                 b ? Vector3(plain(ws.bodies[j.B.body].r)) : origin,
                                 b ? Matrix3(plain(ws.bodies[j.B.body].R)) : identity);
}

/// Writes the constraint rows of joints; adds G^T lambda and G^T mu to the loads and shifts of the
/// bodies.
template <class S> void add_joints(const Regime& s, Workspace<S>& ws, const S* y, S* residual) {
  for (const JointData& j : s.joints) {
    const joint::Geometry<S> g = joint_geometry<S>(j, ws.bodies);
    const joint::Vec12<S> u = joint_velocity<S>(j, ws.bodies);
    joint::Vec12<S> load = joint::Vec12<S>::Zero(), shift = joint::Vec12<S>::Zero();
    for (const RowData& row : j.rows) {
      if (!s.holds(row))
        continue;
      const joint::Row<S> value = joint::basic_row<S>(row.kind, j.A, j.B, j.parameters, g);
      const S acceleration = row_acceleration<S>(s, ws, j, value.gradient, u, [&] {
        return joint::basic_curvature(row.kind, j.A, j.B, j.parameters, geometry_values(j, ws));
      });
      constraint_rows<S>(s, y, s.lambda(row), s.mu(row), value.value,
                         value.gradient.cwiseProduct(u).sum(), acceleration, residual);
      load += y[s.lambda(row)] * value.gradient;
      shift += y[s.mu(row)] * value.gradient;
    }
    add_to_bodies<S>(j, load, ws.loads);
    add_to_bodies<S>(j, shift, ws.shifts);
  }
}

/// Writes the rows of couplers: sum_k c_k s_k = offset + f(t) and its rate, or the rate only.
template <class S>
void add_couplers(const Regime& s, Workspace<S>& ws, double t, const S* y, S* residual) {
  for (const CouplerData& coupler : s.couplers) {
    if (!s.holds(coupler))
      continue;
    const std::array<double, 3> f = s.drive(coupler, t);
    const bool position = !coupler.velocity_level;
    S value = S(-s.offset(coupler) - f[0]), rate = S(position ? -f[1] : -f[0]);
    S acceleration = S(position ? -f[2] : -f[1]);
    for (const CouplerData::Term& term : coupler.terms) {
      const JointData& j = s.joints[s.motions[term.motion].joint];
      const joint::Row<S> w = motion_row<S>(s, ws, term.motion);
      const joint::Vec12<S> gradient = S(term.factor) * w.gradient;
      value += S(term.factor) * w.value;
      const joint::Vec12<S> u = joint_velocity<S>(j, ws.bodies);
      rate += gradient.cwiseProduct(u).sum();
      acceleration += row_acceleration<S>(s, ws, j, gradient, u, [&]() -> joint::Matrix12 {
        return term.factor * joint::motion_curvature(s.motions[term.motion].motion, j.A, j.B,
                                                     geometry_values(j, ws));
      });
      add_to_bodies<S>(j, y[s.lambda(coupler)] * gradient, ws.loads);
      if (position)
        add_to_bodies<S>(j, y[s.mu(coupler)] * gradient, ws.shifts);
    }
    constraint_rows<S>(s, y, s.lambda(coupler), position ? s.mu(coupler) : redundant, value, rate,
                       acceleration, residual);
  }
}

/// Momentum rows M u' - f - G^T lambda, position rows q' - E(q)(u + G^T mu) - sigma p, norm rows.
template <class S>
void body_rows(const Regime& s, const Workspace<S>& ws, const S* y, const S* yp, S* residual) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const BodyData& body = s.bodies[i];
    if (body.n_active == 0)
      continue;
    const BodyState<S>& state = ws.bodies[i];
    const Mat3<S> inertia = body.inertia.template cast<S>();
    Vec6<S> rate;
    rate << S(body.mass) * state.v_dot,
        inertia * state.w_dot + cross<S>(state.w, inertia * state.w);
    const Vec6<S>& load = ws.loads[i];
    const Vec6<S>& shift = ws.shifts[i];
    for (int k = 0; k < body.n_active; ++k) {
      const int c = body.active[k];
      residual[body.u0 + k] = rate[c] - load[c];
      if (c < 3 || body.rotation == BodyData::Rotation::about_axis)
        residual[body.q0 + k] = yp[body.q0 + k] - y[body.u0 + k] - shift[c];
    }
    if (body.rotation == BodyData::Rotation::free) {
      const Index q = body.q0 + body.n_translations;
      const Vec3<S> w = state.w + shift.template tail<3>();
      const Vec4<S> p_dot = S(0.5) * (quaternion_rate_matrix<S>(state.p) * w);
      for (int k = 0; k < 4; ++k)
        residual[q + k] = yp[q + k] - p_dot[k] - y[s.sigma(body)] * state.p[k];
      residual[s.sigma(body)] = S(0.5) * (state.p.cwiseProduct(state.p).sum() - S(1));
    }
  }
}

/// Writes poses at (t, y, y') into `ws`, with the weights as the only loads.
template <class S>
void begin_loads(const Regime& s, Workspace<S>& ws, double t, const S* y, const S* yp) {
  unpack<S>(s, y, yp, ws.bodies);
  ws.time = t;
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    ws.loads[i].setZero();
    ws.loads[i][2] = S(-s.bodies[i].mass * s.gravity);
    ws.shifts[i].setZero();
  }
}

/// Writes the rows of lambda and mu only; loads of reactions and weights go into `ws`.
template <class S>
void constraint_residual(const Regime& s, Workspace<S>& ws, double t, const S* y, const S* yp,
                         S* residual) {
  begin_loads<S>(s, ws, t, y, yp);
  add_joints<S>(s, ws, y, residual);
  add_couplers<S>(s, ws, t, y, residual);
}

/// Writes the rows of q, u and z without constraints: equal to F(t, y, y') for zero lambda and mu.
template <class S>
void free_residual(const Regime& s, Workspace<S>& ws, double t, const S* y, const S* yp,
                   S* residual) {
  begin_loads<S>(s, ws, t, y, yp);
  ws.past = past_at(s, t);
  for_each_list(s, [&](const auto& list) { add_loads<S>(s, list, ws, y, yp, residual); });
  body_rows<S>(s, ws, y, yp, residual);
}

/// Writes F(t, y, y') into `residual`; arrays have length system.n. Allocates nothing.
template <class S>
void residual(const Regime& s, Workspace<S>& ws, double t, const S* y, const S* yp, S* residual) {
  constraint_residual<S>(s, ws, t, y, yp, residual);
  ws.past = past_at(s, t);
  for_each_list(s, [&](const auto& list) { add_loads<S>(s, list, ws, y, yp, residual); });
  body_rows<S>(s, ws, y, yp, residual);
}

} // namespace hydrodae::system
