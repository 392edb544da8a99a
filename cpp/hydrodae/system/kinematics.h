#pragma once
/// Poses and velocities of the bodies from the unknowns.

#include <algorithm>
#include <cmath>
#include <vector>

#include "hydrodae/system/turning.h"

namespace hydrodae::system {

using element::to_tangent;
using element::to_world;

struct Past;

/// Coordinates and rates of all motions at the last accepted step, then vectors and angular
/// velocities of the rotations (three numbers each). Angles count full turns.
struct Turns {
  double time = 0.0;
  bool known = false; ///< false: the values are near those at the start, and the rates are unknown
  std::vector<double> value, rate;
};

/// Gyroscopic derivative d (w x I w) / dw [kg m2/s]; I and w in body axes.
inline Matrix3 gyroscopic_matrix(const Matrix3& inertia, const Vector3& w) {
  return skew<double>(w) * inertia - skew<double>(inertia * w);
}

/// Inputs and outputs of the laws of one list, and the gradients `rows` of the inputs.
template <class S> struct ElementScratch {
  std::vector<S> in, out;
  std::vector<joint::Vec12<S>> rows;
  std::vector<double> held; ///< signals at the time of the call, if one of them lags

  explicit ElementScratch(const ElementList& list)
      : in(list.laws->size() * static_cast<std::size_t>(list.laws->shape.n_in())),
        out(list.laws->size() * static_cast<std::size_t>(list.laws->shape.n_out())),
        rows(element::has_rows(list.laws->shape.port)
                 ? list.laws->size() * static_cast<std::size_t>(list.laws->shape.width)
                 : 0) {}
};

/// Scratch memory of one evaluation, allocated once. Only `turns` persists between calls; it
/// belongs to the last accepted step.
template <class S> struct Workspace {
  std::vector<BodyState<S>> bodies;
  std::vector<Vec6<S>> loads;  ///< world force, body-axes moment about the centre of gravity
  std::vector<Vec6<S>> shifts; ///< G^T mu
  VecX<S> U, U_dot, momentum, inertia_force;
  VecX<S> weights, weight_slopes;   ///< weights of the pose tables, and their derivatives
  VecX<S> scratch;                  ///< scratch of the rung of radiation
  std::vector<Vec6<S>> table_loads; ///< load 1/2 U.A' U grad s of each table on its body
  const Past* past = nullptr;       ///< past at the time of this evaluation (history.h)
  std::vector<ElementScratch<S>> elements;
  double time = 0.0; ///< time of this evaluation [s]
  Turns turns;

  explicit Workspace(const Regime& s) : Workspace(s.system) { turns.value = s.nearby; }

  /// Workspace with the coordinates at the start.
  explicit Workspace(const System& s)
      : bodies(s.bodies.size()), loads(s.bodies.size()), shifts(s.bodies.size()),
        U(VecX<S>::Zero(s.hydro.n_moving)), U_dot(U), momentum(U), inertia_force(U),
        weights(VecX<S>::Zero(s.hydro.added_mass.n_weights)), weight_slopes(weights),
        scratch(VecX<S>::Zero(
            s.hydro.visit([&](const auto& rung) { return rung.n_scratch(s.hydro); }))),
        table_loads(s.hydro.added_mass.tables.size(), Vec6<S>::Zero()),
        elements(s.elements.begin(), s.elements.end()) {
    turns.value = start_turns(s);
    turns.rate.assign(turns.value.size(), 0.0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const BodyData& body = s.bodies[i];
      BodyState<S>& state = bodies[i];
      state.r = body.position.template cast<S>();
      state.p = body.orientation.template cast<S>();
      state.R = rotation_matrix<S>(state.p);
      state.v = state.w = state.v_dot = state.w_dot = Vec3<S>::Zero();
    }
  }
};

/// Poses, velocities and accelerations of all bodies from y and y'. Locked coordinates keep the
/// values that the workspace was made with.
template <class S>
void unpack(const System& s, const S* y, const S* yp, std::vector<BodyState<S>>& states) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const BodyData& body = s.bodies[i];
    BodyState<S>& state = states[i];
    for (int k = 0; k < body.n_active; ++k) {
      const int c = body.active[k];
      const S velocity = y[body.u0 + k], acceleration = yp[body.u0 + k];
      if (c < 3) {
        state.r[c] = y[body.q0 + k];
        state.v[c] = velocity;
        state.v_dot[c] = acceleration;
      } else {
        state.w[c - 3] = velocity;
        state.w_dot[c - 3] = acceleration;
      }
    }
    const Index rotation = body.q0 + body.n_translations;
    if (body.rotation == BodyData::Rotation::about_axis) {
      state.R = rotation_about_axis<S>(body.axis, y[rotation]);
    } else if (body.rotation == BodyData::Rotation::free) {
      state.p << y[rotation], y[rotation + 1], y[rotation + 2], y[rotation + 3];
      state.R = rotation_matrix<S>(state.p);
    }
  }
}

/// Rotation vector of a followed rotation [rad]. Of the equivalent vectors it is the one nearest to
/// the prediction from the rates at the last accepted step and now.
template <class S> Vec3<S> rotation_of(const System& s, const Workspace<S>& ws, int rotation) {
  const RotationData& r = s.rotations[rotation];
  const std::size_t at = s.motions.size() + 3 * static_cast<std::size_t>(rotation);
  Vector3 near = Eigen::Map<const Vector3>(ws.turns.value.data() + at);
  if (const double since = ws.time - ws.turns.time; ws.turns.known && since != 0.0)
    near += 0.5 * since *
            (Eigen::Map<const Vector3>(ws.turns.rate.data() + at) +
             values<S>(spin_of<S>(s, r, ws.bodies)));
  return nearest_rotation<S>(attitude_of<S>(s, r, ws.bodies), near);
}

/// Displacement of a body from its reference pose, which the quaternion `turn` rotates: [r - r_ref;
/// rotation vector], earth axes [m; rad]. `rotation`: index in System::rotations, or -1.
template <class S>
Vec6<S> displacement(const System& s, const Workspace<S>& ws, int body, const Vector4& turn,
                     int rotation, const S* y) {
  const BodyData& b = s.bodies[body];
  Vec6<S> xi;
  xi.template head<3>() = ws.bodies[body].r - b.reference.template cast<S>();
  if (rotation >= 0) {
    xi.template tail<3>() = rotation_of<S>(s, ws, rotation);
  } else if (b.rotation == BodyData::Rotation::about_axis) {
    xi.template tail<3>().setZero();
    xi[3 + b.axis] = y[b.q0 + b.n_translations] - S(2.0 * std::atan2(turn[1 + b.axis], turn[0]));
  } else {
    xi.template tail<3>() = rotation_vector<S>(over<S>(ws.bodies[body].p, turn.template cast<S>()));
  }
  return xi;
}
template <class S>
Vec6<S> displacement(const System& s, const Workspace<S>& ws, int body, const S* y) {
  return displacement<S>(s, ws, body, {1, 0, 0, 0}, s.bodies[body].followed, y);
}

/// Twist [v; w] in world axes.
template <class S> Vec6<S> twist(const BodyState<S>& state) {
  Vec6<S> out;
  out << state.v, state.R * state.w;
  return out;
}

/// Acceleration (v_A, w_A, v_B, w_B)' of the bodies of a joint.
template <class S>
joint::Vec12<S> joint_acceleration(const JointData& j, const std::vector<BodyState<S>>& states) {
  joint::Vec12<S> a = joint::Vec12<S>::Zero();
  if (j.A.body >= 0)
    a.template head<6>() << states[j.A.body].v_dot, states[j.A.body].w_dot;
  if (j.B.body >= 0)
    a.template tail<6>() << states[j.B.body].v_dot, states[j.B.body].w_dot;
  return a;
}

/// Coordinate of a motion with its gradient. An angle lies on the turn nearest to the prediction
/// from the rates at the last accepted step and now, however many turns a step takes.
template <class S> joint::Row<S> motion_row(const System& s, const Workspace<S>& ws, int motion) {
  const MotionData& m = s.motions[motion];
  const JointData& j = s.joints[m.joint];
  const joint::Geometry<S> g = joint_geometry<S>(j, ws.bodies);
  joint::Row<S> row = joint::motion_row<S>(m.motion, j.A, j.B, g);
  if (m.motion.kind == joint::FreeMotion::Kind::stretches && joint::value_of(row.value) == 0.0)
    row.gradient = joint::parting_gradient<S>(j.A, j.B, g, joint_velocity<S>(j, ws.bodies));
  if (!m.motion.is_angle())
    return row;
  const auto k = static_cast<std::size_t>(motion);
  double reference = ws.turns.value[k];
  if (const double since = ws.time - ws.turns.time; ws.turns.known && since != 0.0) {
    const S rate = row.gradient.cwiseProduct(joint_velocity<S>(j, ws.bodies)).sum();
    reference += 0.5 * since * (ws.turns.rate[k] + joint::value_of(rate));
  }
  if (std::isfinite(reference))
    row.value = joint::nearest_turn<S>(row.value, reference);
  return row;
}

/// Coordinates and rates of all motions and rotations, after `unpack` at time `ws.time`.
inline void read_turns(const System& s, const Workspace<double>& ws, Turns& out) {
  out.value.clear();
  out.rate.clear();
  for (std::size_t m = 0; m < s.motions.size(); ++m) {
    const joint::Row<double> row = motion_row<double>(s, ws, static_cast<int>(m));
    const JointData& j = s.joints[static_cast<std::size_t>(s.motions[m].joint)];
    out.value.push_back(row.value);
    out.rate.push_back(row.gradient.dot(joint_velocity<double>(j, ws.bodies)));
  }
  for (std::size_t r = 0; r < s.rotations.size(); ++r) {
    const Vector3 vector = rotation_of<double>(s, ws, static_cast<int>(r)),
                  spin = spin_of<double>(s, s.rotations[r], ws.bodies);
    out.value.insert(out.value.end(), vector.begin(), vector.end());
    out.rate.insert(out.rate.end(), spin.begin(), spin.end());
  }
  out.time = ws.time;
  out.known = true;
}

/// Updates `turns` to an accepted state at time t.
inline void accept_turns(const System& s, double t, const double* y, const double* yp,
                         Workspace<double>& ws) {
  unpack<double>(s, y, yp, ws.bodies);
  ws.time = t;
  Turns now;
  read_turns(s, ws, now);
  ws.turns = std::move(now);
}

/// Adds a load or shift of a joint (12 numbers) to its two bodies.
template <class S>
void add_to_bodies(const JointData& j, const joint::Vec12<S>& load, std::vector<Vec6<S>>& bodies) {
  if (j.A.body >= 0)
    bodies[j.A.body] += load.template head<6>();
  if (j.B.body >= 0)
    bodies[j.B.body] += load.template tail<6>();
}

} // namespace hydrodae::system
