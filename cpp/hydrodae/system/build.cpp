/// From the scene to the system: degrees of freedom, markers, constraint rows, forces, layout.

#include <algorithm>
#include <cmath>
#include <random>

#include "hydrodae/core/error.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/build_parts.h"
#include "hydrodae/system/initial_pose.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::system {

namespace {

BodyData make_body(const model::Body& body, const Pose& pose) {
  BodyData b;
  b.name = body.name;
  b.mass = body.mass;
  b.inertia = body.inertia.asDiagonal();
  const Vector3& products = body.products_of_inertia; // Ixy, Iyz, Izx
  b.inertia(0, 1) = b.inertia(1, 0) = products[0];
  b.inertia(1, 2) = b.inertia(2, 1) = products[1];
  b.inertia(2, 0) = b.inertia(0, 2) = products[2];
  b.reference = body.center_of_gravity;
  b.position = pose.r;
  b.orientation = pose.p;
  b.velocity = pose.v;
  b.angular_velocity = rotation_matrix<double>(pose.p).transpose() * pose.w;
  const std::array<bool, 6> free = model::free_coordinates(body);
  for (int c = 0; c < 6; ++c) {
    if (!free[c])
      continue;
    b.active[b.n_active++] = c;
    if (c < 3)
      ++b.n_translations;
  }
  const int rotations = b.n_active - b.n_translations;
  if (rotations == 1) {
    b.rotation = BodyData::Rotation::about_axis;
    b.axis = b.active[b.n_active - 1] - 3;
  } else if (rotations == 3) {
    b.rotation = BodyData::Rotation::free;
  }
  b.n_position = b.n_translations + (rotations == 3 ? 4 : rotations);
  return b;
}

JointData make_joint(const model::Scene& scene, const model::Joint& joint) {
  JointData j;
  j.name = joint.name;
  j.type = joint::find_joint_type(joint.type);
  const Matrix3 axes = marker_axes(joint);
  auto marker = [&](const std::string& body) -> joint::Marker {
    const int index = body_index(scene, body);
    return {index, index < 0 ? joint.point : joint.point - scene.bodies[index].center_of_gravity,
            axes};
  };
  j.A = marker(joint.body_a);
  j.B = marker(joint.body_b);
  return j;
}

/// Poses that the free coordinates can reach, drawn at random: they tell which constraint rows can
/// change at all.
std::vector<BodyState<double>> random_states(const System& s, std::mt19937& random) {
  auto draw = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  Workspace<double> ws(s);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const BodyData& b = s.bodies[i];
    BodyState<double>& state = ws.bodies[i];
    for (int k = 0; k < b.n_translations; ++k)
      state.r[b.active[k]] += b.lever * draw();
    if (b.rotation == BodyData::Rotation::about_axis)
      state.R = rotation_about_axis<double>(b.axis, 3.0 * draw());
    if (b.rotation == BodyData::Rotation::free)
      state.R = rotation_matrix<double>(Vector4(draw(), draw(), draw(), draw()));
  }
  return ws.bodies;
}

/// Largest entry of a row's gradient over the coordinates that are free.
double free_gradient(const System& s, const JointData& j, const joint::Vector12& gradient) {
  double largest = 0.0;
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      largest = std::max(largest, std::abs(gradient[6 * side + b.active[k]]));
  }
  return largest;
}

/// Keeps the rows that restrict a free coordinate; those left over must hold as they are.
void select_rows(System& s) {
  std::mt19937 random(1);
  std::vector<std::vector<BodyState<double>>> samples;
  for (int k = 0; k < 3; ++k)
    samples.push_back(random_states(s, random));
  const Workspace<double> start(s);
  for (JointData& j : s.joints) {
    for (const joint::BasicRow& kind : j.type->rows) {
      double largest = 0.0;
      for (const auto& states : samples) {
        const auto row =
            joint::basic_row<double>(kind, j.A, j.B, joint_geometry<double>(j, states));
        largest = std::max(largest, free_gradient(s, j, row.gradient));
      }
      if (largest > 1e-12 * std::max({1.0, j.A.point.norm(), j.B.point.norm()})) {
        j.rows.push_back({kind, 0, 0});
        continue;
      }
      const double gap =
          joint::basic_row<double>(kind, j.A, j.B, joint_geometry<double>(j, start.bodies)).value;
      if (std::abs(gap) > 1e-9)
        throw ModelError("joint." + j.name, "joint '" + j.name + "' is open by " +
                                                std::to_string(gap) +
                                                " along a direction in which nothing can move");
    }
    if (j.rows.empty())
      s.notes.push_back("joint '" + j.name + "' restricts no free coordinate");
  }
}

void add_forces(const model::Scene& scene, System& s) {
  for (const force::MooringMatrix& m : std::get<std::vector<force::MooringMatrix>>(scene.forces))
    std::get<0>(s.body_forces).push_back({m.name, body_index(scene, m.body), m.law()});
  for (const force::PtoLinear& p : std::get<std::vector<force::PtoLinear>>(scene.forces)) {
    const auto found = std::find_if(s.joints.begin(), s.joints.end(),
                                    [&](const JointData& j) { return j.name == p.joint; });
    if (found->type->motions.size() != 1)
      throw ModelError("force." + p.name + ".joint",
                       "joint '" + p.joint + "' (" + std::string(found->type->name) +
                           ") has no single free motion for '" + p.name + "' to act along");
    std::get<0>(s.motion_forces)
        .push_back(
            {p.name, static_cast<int>(found - s.joints.begin()), found->type->motions[0], p.law()});
  }
}

/// Offsets of y = [q | u | z | lambda | mu | sigma].
void lay_out(System& s) {
  for (BodyData& b : s.bodies) {
    b.q0 = s.n_q;
    s.n_q += b.n_position;
  }
  s.u0 = s.n_q;
  for (BodyData& b : s.bodies) {
    b.u0 = s.u0 + s.n_u;
    s.n_u += b.n_active;
  }
  s.z0 = s.u0 + s.n_u;
  s.n_z = s.hydro.n_states;
  s.hydro.z0 = s.z0;
  s.lambda0 = s.z0 + s.n_z;
  for (JointData& j : s.joints)
    for (RowData& row : j.rows)
      row.lambda = s.lambda0 + s.n_rows++;
  s.mu0 = s.lambda0 + s.n_rows;
  for (JointData& j : s.joints)
    for (RowData& row : j.rows)
      row.mu = row.lambda + s.n_rows;
  s.sigma0 = s.mu0 + s.n_rows;
  s.n = s.sigma0;
  for (BodyData& b : s.bodies)
    if (b.rotation == BodyData::Rotation::free)
      b.sigma = s.n++;
}

} // namespace

System build(const model::Scene& scene) {
  System s;
  s.gravity = scene.environment.gravity;
  const std::vector<Pose> poses = initial_poses(scene);
  for (std::size_t i = 0; i < poses.size(); ++i)
    s.bodies.push_back(make_body(scene.bodies[i], poses[i]));
  for (const model::Joint& joint : scene.joints)
    s.joints.push_back(make_joint(scene, joint));
  set_body_scales(scene, s);
  select_rows(s);
  add_hydro(scene, s);
  add_forces(scene, s);
  lay_out(s);
  if (s.n_u == 0)
    throw ModelError("body", "nothing can move: every body of the scene is fixed");
  set_scales(s);
  set_names(s);
  return s;
}

VectorX initial_state(const System& s) {
  VectorX y = VectorX::Zero(s.n);
  for (const BodyData& b : s.bodies) {
    for (int k = 0; k < b.n_active; ++k) {
      const int c = b.active[k];
      y[b.u0 + k] = c < 3 ? b.velocity[c] : b.angular_velocity[c - 3];
      if (c < 3)
        y[b.q0 + k] = b.position[c];
    }
    const Index q = b.q0 + b.n_translations;
    if (b.rotation == BodyData::Rotation::about_axis)
      y[q] = 2.0 * std::atan2(b.orientation[1 + b.axis], b.orientation[0]);
    if (b.rotation == BodyData::Rotation::free)
      y.segment<4>(q) = b.orientation;
  }
  return y;
}

} // namespace hydrodae::system
