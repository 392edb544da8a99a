/// From the scene to the system: degrees of freedom, markers, constraint rows, forces, layout.

#include <algorithm>
#include <cmath>
#include <random>

#include "hydrodae/core/error.h"
#include "hydrodae/model/mass.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/assemble.h"
#include "hydrodae/system/build_parts.h"
#include "hydrodae/system/initial_pose.h"
#include "hydrodae/system/kinematics.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::system {

namespace {

BodyData make_body(const model::Body& body, const Pose& pose) {
  BodyData b;
  b.name = body.name;
  b.mass = body.mass;
  b.inertia = model::inertia_tensor(body);
  b.reference = body.center_of_gravity;
  b.position = pose.r;
  b.orientation = pose.p;
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

/// What the bodies of the case are given at the start.
std::vector<BodyStart> body_starts(const model::Scene& scene) {
  std::vector<BodyStart> out;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const model::BodyInitial& start = scene.bodies[i].initial;
    const bool placed = !start.displacement.isZero(0.0) || !start.rotation.isZero(0.0);
    if (placed || start.velocity || start.angular_velocity)
      out.push_back({static_cast<int>(i), placed, start.velocity, start.angular_velocity});
  }
  return out;
}

/// Coordinates of bodies are motions between the ground and the centre of gravity.
const std::array<joint::JointType, 6> body_coordinates = {{
    {"surge", {}, {joint::slides(joint::X)}, false},
    {"sway", {}, {joint::slides(joint::Y)}, false},
    {"heave", {}, {joint::slides(joint::Z)}, false},
    {"roll", {}, {joint::turns(joint::X)}, false},
    {"pitch", {}, {joint::turns(joint::Y)}, false},
    {"yaw", {}, {joint::turns(joint::Z)}, false},
}};
const joint::JointType spring_type = {"spring", {}, {joint::stretches()}, false};
const joint::JointType rope_type = {"one-sided distance", {}, {joint::stretches()}, false};

joint::Marker make_marker(const model::Scene& scene, const std::string& body, const Vector3& point,
                          const Matrix3& axes) {
  const int index = body_index(scene, body);
  return {index, index < 0 ? point : point - scene.bodies[index].center_of_gravity, axes, nullptr};
}

/// Adds a joint and its motions.
JointData& add_joint(System& s, JointData j) {
  j.first_motion = static_cast<int>(s.motions.size());
  const std::vector<std::string> names = joint::motion_names(*j.type);
  for (std::size_t k = 0; k < names.size(); ++k)
    s.motions.push_back({static_cast<int>(s.joints.size()), j.type->motions[k], names[k]});
  s.joints.push_back(std::move(j));
  return s.joints.back();
}

void add_joint(const model::Scene& scene, const model::Joint& joint, System& s) {
  JointData j;
  j.name = joint.name;
  j.type = joint.one_sided ? &rope_type : joint::find_joint_type(joint.type);
  const Matrix3 axes = marker_axes(joint);
  const Vector3 point_b = joint.point_b.value_or(joint.point);
  j.A = make_marker(scene, joint.body_a, joint.point, axes);
  j.B = make_marker(scene, joint.body_b, point_b, axes);
  j.parameters.length = joint.length.value_or((point_b - joint.point).norm());
  j.parameters.pitch = joint.pitch;
  if (!joint.path.empty()) { // its points as the marker has its own
    std::vector<Vector3> points = joint.path;
    for (Vector3& p : points)
      p = make_marker(scene, joint.body_a, p, axes).point;
    j.A.path = std::make_shared<const joint::Path>(points);
  }
  const model::JointInitial& start = joint.initial;
  for (int m = add_joint(s, std::move(j)).first_motion; m < static_cast<int>(s.motions.size());
       ++m) {
    const bool angle = s.motions[m].name == "angle";
    if (!angle && s.motions[m].name != "displacement")
      continue;
    const MotionStart given{m, angle ? start.angle : start.displacement,
                            angle ? start.angle_rate : start.displacement_rate};
    s.motions[m].start = given.value.value_or(0.0);
    if (given.value || given.rate)
      s.starts.push_back(given);
  }
}

/// Couplers hold what they find at the start.
void set_coupler_offsets(const model::Scene& scene, System& s) {
  const Workspace<double> start(s);
  for (std::size_t k = 0; k < s.couplers.size(); ++k) {
    if (k >= scene.constraints.size() || scene.constraints[k].type != "coupler")
      continue;
    s.couplers[k].offset = 0.0;
    for (const CouplerData::Term& term : s.couplers[k].terms)
      s.couplers[k].offset += term.factor * motion_row<double>(s, start, term.motion).value;
  }
}

/// The motion that stands for one coordinate of a body.
int body_motion(const model::Scene& scene, const std::string& body, const std::string& coordinate,
                System& s) {
  const auto type = std::find_if(body_coordinates.begin(), body_coordinates.end(),
                                 [&](const auto& t) { return t.name == coordinate; });
  const Vector3& point = scene.bodies[body_index(scene, body)].center_of_gravity;
  JointData j;
  j.name = body + "." + coordinate;
  j.type = &*type;
  j.A = make_marker(scene, "ground", point, Matrix3::Identity());
  j.B = make_marker(scene, body, point, Matrix3::Identity());
  j.hidden = true;
  return add_joint(s, std::move(j)).first_motion;
}

/// The motion of a joint by name, its first one without.
int joint_motion(const System& s, const std::string& joint,
                 const std::optional<std::string>& coordinate) {
  for (const JointData& j : s.joints) {
    if (j.name != joint || j.hidden)
      continue;
    for (std::size_t k = 0; k < j.type->motions.size(); ++k) {
      const int motion = j.first_motion + static_cast<int>(k);
      if (!coordinate || s.motions[motion].name == *coordinate)
        return motion;
    }
  }
  return -1;
}

/// Adds the coupler of a switch, open at first.
void add_switch(const std::string& name, SwitchData element, System& s) {
  CouplerData coupler;
  coupler.name = name;
  coupler.terms = {{element.motion, 1.0}};
  coupler.velocity_level = element.kind == SwitchData::Kind::friction;
  coupler.lambda = coupler.mu = redundant;
  element.coupler = static_cast<int>(s.couplers.size());
  s.couplers.push_back(coupler);
  s.switches.push_back(element);
}

void add_stop(const model::Constraint& c, System& s) {
  SwitchData stop;
  stop.motion = joint_motion(s, *c.joint, c.coordinate);
  stop.lower = c.lower ? *c.lower : c.lower_angle.value_or(-INFINITY);
  stop.upper = c.upper ? *c.upper : c.upper_angle.value_or(INFINITY);
  stop.restitution = c.restitution.value_or(0.0);
  add_switch(c.name, stop, s);
}

/// One-sided distances, after the constraints of the case.
void add_ropes(const model::Scene& scene, System& s) {
  for (std::size_t k = 0; k < scene.joints.size(); ++k) {
    const model::Joint& joint = scene.joints[k];
    if (!joint.one_sided)
      continue;
    SwitchData rope;
    rope.motion = s.joints[k].first_motion;
    rope.upper = s.joints[k].parameters.length;
    rope.restitution = joint.restitution.value_or(0.0);
    add_switch(joint.name, rope, s);
  }
}

void add_constraints(const model::Scene& scene, System& s) {
  for (const model::Constraint& c : scene.constraints) {
    if (c.drive.python && !c.drive.function)
      throw ModelError("constraint." + c.name + ".drive.python",
                       "constraint '" + c.name +
                           "': its drive is a Python function, which nobody gave; run the case as "
                           "hydrodae.run(case, drives={\"" +
                           c.name + "\": function})");
    if (c.type == "stop") {
      add_stop(c, s);
      continue;
    }
    CouplerData coupler;
    coupler.name = c.name;
    coupler.drive = c.drive;
    coupler.velocity_level = c.level == "velocity";
    const int first = c.joint ? joint_motion(s, *c.joint, c.coordinate)
                              : body_motion(scene, *c.body, *c.coordinate, s);
    if (c.type == "coupler") { // s_b - ratio s = what it is at the start
      coupler.terms = {{joint_motion(s, *c.joint_b, c.coordinate_b), 1.0}, {first, -c.ratio}};
    } else {
      coupler.terms = {{first, 1.0}};
    }
    s.couplers.push_back(coupler);
  }
  add_ropes(scene, s);
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
        const auto row = joint::basic_row<double>(kind, j.A, j.B, j.parameters,
                                                  joint_geometry<double>(j, states));
        largest = std::max(largest, free_gradient(s, j, row.gradient));
      }
      if (largest > 1e-12 * std::max({1.0, j.A.point.norm(), j.B.point.norm()})) {
        j.rows.push_back({kind});
        continue;
      }
      const double gap = joint::basic_row<double>(kind, j.A, j.B, j.parameters,
                                                  joint_geometry<double>(j, start.bodies))
                             .value;
      if (std::abs(gap) > 1e-9)
        throw ModelError("joint." + j.name, "joint '" + j.name + "' is open by " +
                                                std::to_string(gap) +
                                                " along a direction in which nothing can move");
    }
    if (j.rows.empty() && j.type != &rope_type)
      s.notes.push_back("joint '" + j.name + "' restricts no free coordinate");
  }
}

void add_forces(const model::Scene& scene, System& s) {
  auto& wrenches = std::get<0>(s.body_forces);
  for (const force::MooringMatrix& m : std::get<std::vector<force::MooringMatrix>>(scene.forces))
    wrenches.push_back({m.name, body_index(scene, m.body), m.law()});
  for (const force::ConstantLoad& c : std::get<std::vector<force::ConstantLoad>>(scene.forces))
    wrenches.push_back({c.name, body_index(scene, c.body), c.law()});
  for (const force::ViscousDamping& v : std::get<std::vector<force::ViscousDamping>>(scene.forces))
    std::get<1>(s.body_forces).push_back({v.name, body_index(scene, v.body), v.law()});
  for (const force::PtoLinear& p : std::get<std::vector<force::PtoLinear>>(scene.forces)) {
    const int motion = joint_motion(s, p.joint, {});
    int delay = -1;
    if (p.delay > 0.0) {
      delay = static_cast<int>(s.delays.size());
      s.delays.push_back({motion, p.delay});
    }
    std::get<0>(s.motion_forces).push_back({p.name, motion, p.law(), delay});
  }
  for (const force::DryFriction& f : std::get<std::vector<force::DryFriction>>(scene.forces)) {
    auto& laws = std::get<2>(s.motion_forces);
    SwitchData friction;
    friction.kind = SwitchData::Kind::friction;
    friction.motion = joint_motion(s, f.joint, {});
    friction.static_load = f.static_load;
    friction.kinetic_load = f.kinetic_load.value_or(f.static_load);
    friction.force = static_cast<int>(laws.size());
    laws.push_back({f.name, friction.motion, {}});
    add_switch(f.name, friction, s);
  }
  for (const force::SpringDamper& d : std::get<std::vector<force::SpringDamper>>(scene.forces)) {
    JointData j;
    j.name = d.name;
    j.type = &spring_type;
    j.A = make_marker(scene, d.body_a, d.point_a, Matrix3::Identity());
    j.B = make_marker(scene, d.body_b, d.point_b, Matrix3::Identity());
    j.hidden = true;
    const int motion = add_joint(s, std::move(j)).first_motion;
    std::get<1>(s.motion_forces).push_back({d.name, motion, d.law()});
  }
}

/// Offsets of y = [q | u | z | lambda | mu | sigma].
void set_offsets(System& s) {
  s.n = s.n_q = s.n_u = s.n_lambda = s.n_mu = 0;
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
  for_each_row(s, [&](Index& lambda, Index&, bool) {
    if (lambda != redundant)
      lambda = s.lambda0 + s.n_lambda++;
  });
  s.mu0 = s.lambda0 + s.n_lambda;
  for_each_row(s, [&](Index& lambda, Index& mu, bool velocity_level) {
    if (lambda != redundant && !velocity_level)
      mu = s.mu0 + s.n_mu++;
  });
  s.sigma0 = s.mu0 + s.n_mu;
  s.n = s.sigma0;
  for (BodyData& b : s.bodies)
    if (b.rotation == BodyData::Rotation::free)
      b.sigma = s.n++;
}

} // namespace

void lay_out(System& s) {
  set_offsets(s);
  set_groups(s);
  set_scales(s);
  set_names(s);
}

void set_state(System& s, SwitchData& element, SwitchData::State state) {
  using State = SwitchData::State;
  element.state = state;
  CouplerData& coupler = s.couplers[static_cast<std::size_t>(element.coupler)];
  coupler.lambda = coupler.mu = element.holds() ? 0 : redundant;
  if (element.kind == SwitchData::Kind::stop) {
    coupler.offset = state == State::lower ? element.lower : element.upper;
    return;
  }
  force::DryFriction::Law& law =
      std::get<2>(s.motion_forces)[static_cast<std::size_t>(element.force)].law;
  law.load = state == State::forward    ? -element.kinetic_load
             : state == State::backward ? element.kinetic_load
                                        : 0.0;
}

System build(const model::Scene& scene, bool with_excitation) {
  System s;
  s.gravity = scene.environment.gravity;
  const std::vector<Pose> poses = initial_poses(scene);
  for (std::size_t i = 0; i < poses.size(); ++i)
    s.bodies.push_back(make_body(scene.bodies[i], poses[i]));
  for (const model::Joint& joint : scene.joints)
    add_joint(scene, joint, s);
  set_body_scales(scene, s);
  select_rows(s);
  add_hydro(scene, s);
  add_morison(scene, s);
  add_constraints(scene, s);
  add_forces(scene, s);
  for (const model::Marker& m : scene.markers)
    s.markers.push_back({m.name, body_index(scene, m.body),
                         m.point - scene.bodies[body_index(scene, m.body)].center_of_gravity,
                         m.axes == "body"});
  set_coupler_offsets(scene, s);
  find_mechanisms(s);
  lay_out(s);
  if (s.n_u == 0)
    throw ModelError("body", "nothing can move: every body of the scene is fixed");
  assemble(s, {scene.solver.tolerance_assembly, scene.solver.end_time, scene.solver.force},
           body_starts(scene));
  take_mean_yaw(scene, s);
  if (with_excitation) {
    note_axes(scene, s);
    add_sea(scene, s);
  }
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
