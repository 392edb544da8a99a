#include "hydrodae/build/initial_pose.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/joint/path.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::build {

namespace {

Vector4 quaternion_product(const Vector4& a, const Vector4& b) {
  const Eigen::Quaterniond c =
      Eigen::Quaterniond(a[0], a[1], a[2], a[3]) * Eigen::Quaterniond(b[0], b[1], b[2], b[3]);
  return {c.w(), c.x(), c.y(), c.z()};
}

/// Bodies connected to `start` without the joint `without`, `start` included; the search stops at
/// the ground (-1) and at fixed bodies.
std::vector<int> hanging_bodies(const model::Scene& scene, int start, std::size_t without) {
  std::vector<int> found{start};
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k] < 0 || !model::moves(scene.bodies[found[k]]))
      continue;
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
      if (j == without)
        continue;
      const int a = body_index(scene, scene.joints[j].body_a);
      const int b = body_index(scene, scene.joints[j].body_b);
      if (a != found[k] && b != found[k])
        continue;
      const int other = a == found[k] ? b : a;
      if (std::find(found.begin(), found.end(), other) == found.end())
        found.push_back(other);
    }
  }
  return found;
}

/// Returns whether all these bodies can move as one.
bool movable(const model::Scene& scene, const std::vector<int>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(),
                     [&](int b) { return b >= 0 && model::moves(scene.bodies[b]); });
}

/// Returns whether a rigid motion between two poses of a body keeps its locked coordinates.
bool may_go(const model::Body& body, const Pose& from, const Pose& to) {
  const std::array<bool, 6> free = model::free_coordinates(body);
  const auto rotations = std::count(free.begin() + 3, free.end(), true);
  const double length = 1e-9 * std::max(1.0, (to.r - from.r).norm());
  for (std::size_t c = 0; c < 3; ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    if (!free[c] && std::abs(to.r[i] - from.r[i]) > length)
      return false;
    if (rotations == 1 && !free[3 + c] && std::abs(to.p[1 + i]) > 1e-9)
      return false;
  }
  return rotations > 0 || (to.p - from.p).norm() < 1e-9;
}

/// Moves a set of bodies rigidly: a rotation about an axis through `point`, then a translation.
/// Points, which have no rotation, only translate. If a body locks the motion, all stay: the
/// assembly finds their poses.
void move(const model::Scene& scene, std::vector<Pose>& poses, const std::vector<int>& bodies,
          const Vector3& point, const Vector3& rotation, const Vector3& slide) {
  const Vector4 turn = quaternion_from_rotation_vector(rotation);
  const Matrix3 R = rotation_matrix<double>(turn);
  std::vector<Pose> moved = poses;
  for (int b : bodies) {
    const model::Body& body = scene.bodies[static_cast<std::size_t>(b)];
    const std::array<bool, 6> free = model::free_coordinates(body);
    const bool is_point = free == std::array<bool, 6>{true, true, true, false, false, false};
    Pose& pose = moved[static_cast<std::size_t>(b)];
    pose.r = point + R * (pose.r - point) + slide;
    if (!is_point)
      pose.p = quaternion_product(turn, pose.p);
    if (!may_go(body, poses[static_cast<std::size_t>(b)], pose))
      return;
  }
  poses = moved;
}

void apply_joint_start(const model::Scene& scene, std::size_t index, std::vector<Pose>& poses) {
  const model::Joint& joint = scene.joints[index];
  const model::JointInitial& start = joint.initial;
  if (!start.angle && !start.displacement)
    return;
  const int a = body_index(scene, joint.body_a), b = body_index(scene, joint.body_b);
  std::vector<int> side = hanging_bodies(scene, b, index);
  double sign = 1.0;
  const bool loop = std::find(side.begin(), side.end(), a) != side.end();
  if (!loop && !movable(scene, side)) {
    side = hanging_bodies(scene, a, index);
    sign = -1.0;
  }
  if (loop || !movable(scene, side))
    return; // the assembly finds a pose that has this coordinate
  // Point and axis of the joint at the present pose of body A, which may have moved before.
  const Pose ground;
  const Pose& base = a >= 0 ? poses[a] : ground;
  const Vector3 reference = a >= 0 ? scene.bodies[a].center_of_gravity : Vector3::Zero();
  const Matrix3 R = rotation_matrix<double>(base.p);
  const Vector3 point = base.r + R * (joint.point - reference);
  const Vector3 axis = sign * (R * marker_axes(joint.axis, joint.axis_x).col(2));
  if (!joint.path.empty()) { // moves the point of B to its place on the curve, along the curve
    const Vector3 place = joint::Path(joint.path).at_arc(start.displacement.value_or(0.0))[0];
    const Vector3 slide =
        start.displacement ? Vector3(sign * (R * (place - joint.point))) : Vector3::Zero();
    move(scene, poses, side, point, Vector3::Zero(), slide);
    return;
  }
  move(scene, poses, side, point, start.angle.value_or(0.0) * axis,
       start.displacement.value_or(0.0) * axis);
}

/// Refuses a body with one rotation axis that starts turned about another.
void check_locked(const model::Body& body, const Pose& pose) {
  const std::array<bool, 6> free = model::free_coordinates(body);
  if (std::count(free.begin() + 3, free.end(), true) != 1)
    return;
  for (std::size_t c = 3; c < 6; ++c)
    if (!free[c] && std::abs(pose.p[static_cast<Eigen::Index>(c) - 2]) > 1e-9)
      throw ModelError("body." + body.name + ".motion",
                       "body '" + body.name + "': the start has a rotation in " +
                           std::string(model::coordinate_names[c]) + ", which its motion locks");
}

/// Pose of an attachment on its body; rotations by modes are small.
Pose attached(const model::Scene& scene, const model::Attachment& place,
              const std::vector<Pose>& poses) {
  const auto body = static_cast<std::size_t>(body_index(scene, place.body));
  Vector3 arm = place.point - scene.bodies[body].center_of_gravity, turn = Vector3::Zero();
  const std::vector<std::size_t> modes = model::modes_of(scene, place.body);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double amplitude = scene.modes[modes[k]].initial.amplitude;
    arm += amplitude * place.displacement[k];
    if (!place.rotation.empty())
      turn += amplitude * place.rotation[k];
  }
  const Pose& base = poses[body];
  return {base.r + rotation_matrix<double>(base.p) * arm,
          quaternion_product(base.p, quaternion_from_rotation_vector(turn))};
}

} // namespace

int body_index(const model::Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].name == name)
      return static_cast<int>(i);
  return -1;
}

Matrix3 marker_axes(const std::optional<Vector3>& axis, const std::optional<Vector3>& axis_x) {
  const Vector3 z = axis ? axis->normalized() : Vector3::UnitZ();
  Vector3 x = axis_x.value_or(Vector3::UnitX());
  x -= x.dot(z) * z;
  if (!axis_x && x.norm() < 1e-6) // the default x is along the axis: take world y
    x = Vector3::UnitY() - z[1] * z;
  x.normalize();
  Matrix3 axes;
  axes << x, z.cross(x), z;
  return axes;
}

std::vector<Pose> initial_poses(const model::Scene& scene) {
  std::vector<Pose> poses(scene.bodies.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const model::BodyInitial& start = scene.bodies[i].initial;
    poses[i] = {scene.bodies[i].center_of_gravity + start.displacement,
                quaternion_from_rotation_vector(start.rotation)};
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    apply_joint_start(scene, j, poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    check_locked(scene.bodies[i], poses[i]);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (const auto& part = scene.bodies[i].part; part && !part->mode)
      poses[i] = attached(scene, scene.attachments[part->entry], poses);
  return poses;
}

} // namespace hydrodae::build
