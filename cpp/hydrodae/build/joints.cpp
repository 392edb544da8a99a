/// Joints with their motions and the rows that matter.

#include <algorithm>
#include <cmath>
#include <random>

#include "hydrodae/build/initial_pose.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::build {

namespace {

/// Coordinates of bodies are motions between the ground and the centre of gravity.
const std::array<joint::JointType, 6> body_coordinates = {{
    {"surge", {}, {joint::slides(joint::X)}, false},
    {"sway", {}, {joint::slides(joint::Y)}, false},
    {"heave", {}, {joint::slides(joint::Z)}, false},
    {"roll", {}, {joint::turns(joint::X)}, false},
    {"pitch", {}, {joint::turns(joint::Y)}, false},
    {"yaw", {}, {joint::turns(joint::Z)}, false},
}};
const joint::JointType rope_type = {"one-sided distance", {}, {joint::stretches()}, false};

/// Random poses along the free coordinates: they show which constraint rows can change.
std::vector<system::BodyState<double>> random_states(const system::System& s,
                                                     std::mt19937& random) {
  auto draw = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  system::Workspace<double> ws(s);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    system::BodyState<double>& state = ws.bodies[i];
    for (int k = 0; k < b.n_translations; ++k)
      state.r[b.active[k]] += b.lever * draw();
    if (b.rotation == system::BodyData::Rotation::about_axis)
      state.R = rotation_about_axis<double>(b.axis, 3.0 * draw());
    if (b.rotation == system::BodyData::Rotation::free)
      state.R = rotation_matrix<double>(Vector4(draw(), draw(), draw(), draw()));
  }
  return ws.bodies;
}

/// Largest entry of a row's gradient over the free coordinates.
double free_gradient(const system::System& s, const system::JointData& j,
                     const joint::Vector12& gradient) {
  double largest = 0.0;
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const system::BodyData& b = s.bodies[body];
    for (int k = 0; k < b.n_active; ++k)
      largest = std::max(largest, std::abs(gradient[6 * side + b.active[k]]));
  }
  return largest;
}

} // namespace

joint::Marker make_marker(const model::Scene& scene, const std::string& body, const Vector3& point,
                          const Matrix3& axes) {
  const int index = body_index(scene, body);
  return {index, index < 0 ? point : point - scene.bodies[index].center_of_gravity, axes, nullptr};
}

system::JointData& add_joint(system::System& s, system::JointData j) {
  j.first_motion = static_cast<int>(s.motions.size());
  const std::vector<std::string> names = joint::motion_names(*j.type);
  for (std::size_t k = 0; k < names.size(); ++k)
    s.motions.push_back({static_cast<int>(s.joints.size()), j.type->motions[k], names[k]});
  s.joints.push_back(std::move(j));
  return s.joints.back();
}

void add_joint(const model::Scene& scene, const model::Joint& joint, system::System& s) {
  system::JointData j;
  j.name = joint.name;
  j.type = joint.one_sided ? &rope_type : joint::find_joint_type(joint.type);
  const Matrix3 axes = marker_axes(joint.axis, joint.axis_x);
  const Vector3 point_b = joint.point_b.value_or(joint.point);
  j.A = make_marker(scene, joint.body_a, joint.point, axes);
  j.B = make_marker(scene, joint.body_b, point_b, axes);
  j.parameters.length = joint.length.value_or((point_b - joint.point).norm());
  j.parameters.pitch = joint.pitch;
  if (!joint.path.empty()) { // points of the path are given like the point of the marker
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
    const system::MotionStart given{m, angle ? start.angle : start.displacement,
                                    angle ? start.angle_rate : start.displacement_rate};
    s.motions[m].start = given.value.value_or(0.0);
    if (given.value || given.rate)
      s.starts.push_back(given);
  }
}

int body_motion(const model::Scene& scene, const std::string& body, const std::string& coordinate,
                system::System& s) {
  const auto type = std::find_if(body_coordinates.begin(), body_coordinates.end(),
                                 [&](const auto& t) { return t.name == coordinate; });
  const Vector3& point = scene.bodies[body_index(scene, body)].center_of_gravity;
  system::JointData j;
  j.name = body + "." + coordinate;
  j.type = &*type;
  j.A = make_marker(scene, "ground", point, Matrix3::Identity());
  j.B = make_marker(scene, body, point, Matrix3::Identity());
  j.hidden = true;
  return add_joint(s, std::move(j)).first_motion;
}

int joint_motion(const system::System& s, const std::string& joint,
                 const std::optional<std::string>& coordinate) {
  for (const system::JointData& j : s.joints) {
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

void select_rows(system::System& s) {
  std::mt19937 random(1);
  std::vector<std::vector<system::BodyState<double>>> samples;
  for (int k = 0; k < 3; ++k)
    samples.push_back(random_states(s, random));
  const system::Workspace<double> start(s);
  for (system::JointData& j : s.joints) {
    for (const joint::BasicRow& kind : j.type->rows) {
      double largest = 0.0;
      for (const auto& states : samples) {
        const auto row = joint::basic_row<double>(kind, j.A, j.B, j.parameters,
                                                  system::joint_geometry<double>(j, states));
        largest = std::max(largest, free_gradient(s, j, row.gradient));
      }
      if (largest > 1e-12 * std::max({1.0, j.A.point.norm(), j.B.point.norm()})) {
        j.rows.emplace_back(kind);
        continue;
      }
      const double gap = joint::basic_row<double>(kind, j.A, j.B, j.parameters,
                                                  system::joint_geometry<double>(j, start.bodies))
                             .value;
      if (std::abs(gap) > 1e-9)
        throw ModelError("joint." + j.name, "joint '" + j.name + "' is open by " +
                                                std::to_string(gap) +
                                                " along a direction in which nothing can move");
    }
    if (j.rows.empty() && !j.type->rows.empty())
      s.notes.push_back("joint '" + j.name + "' restricts no free coordinate");
  }
}

} // namespace hydrodae::build
