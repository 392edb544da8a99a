#include "hydrodae/system/initial_pose.h"

#include <algorithm>

#include "hydrodae/core/error.h"
#include "hydrodae/joint/path.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::system {

namespace {

Vector4 quaternion_product(const Vector4& a, const Vector4& b) {
  const Eigen::Quaterniond c =
      Eigen::Quaterniond(a[0], a[1], a[2], a[3]) * Eigen::Quaterniond(b[0], b[1], b[2], b[3]);
  return {c.w(), c.x(), c.y(), c.z()};
}

/// Bodies that hang on `start` when `without` is taken away, start included; the search does not go
/// on through the ground (-1) or a fixed body.
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

/// Can all these bodies be moved as one?
bool movable(const model::Scene& scene, const std::vector<int>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(),
                     [&](int b) { return b >= 0 && model::moves(scene.bodies[b]); });
}

/// Rigid motion of a set of bodies: turn about an axis through `point`, then slide, with rates.
void move(std::vector<Pose>& poses, const std::vector<int>& bodies, const Vector3& point,
          const Vector3& rotation, const Vector3& slide, const Vector3& rate,
          const Vector3& slide_rate) {
  const Vector4 turn = quaternion_from_rotation_vector(rotation);
  const Matrix3 R = rotation_matrix<double>(turn);
  for (int b : bodies) {
    Pose& pose = poses[b];
    pose.r = point + R * (pose.r - point) + slide;
    pose.p = quaternion_product(turn, pose.p);
    pose.v = R * pose.v + rate.cross(pose.r - point - slide) + slide_rate;
    pose.w = R * pose.w + rate;
  }
}

void apply_joint_start(const model::Scene& scene, std::size_t index, std::vector<Pose>& poses) {
  const model::Joint& joint = scene.joints[index];
  const model::JointInitial& start = joint.initial;
  if (!start.angle && !start.angle_rate && !start.displacement && !start.displacement_rate)
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
  // The joint's point and axis as they stand now on body A (the side that may have moved before).
  const Pose ground;
  const Pose& base = a >= 0 ? poses[a] : ground;
  const Vector3 reference = a >= 0 ? scene.bodies[a].center_of_gravity : Vector3::Zero();
  const Matrix3 R = rotation_matrix<double>(base.p);
  const Vector3 point = base.r + R * (joint.point - reference);
  const Vector3 axis = sign * (R * marker_axes(joint).col(2));
  if (!joint.path.empty()) { // the point of B to its place on the curve, along the curve
    const auto [place, tangent] = joint::Path(joint.path).at_arc(start.displacement.value_or(0.0));
    const Vector3 slide =
        start.displacement ? Vector3(sign * (R * (place - joint.point))) : Vector3::Zero();
    move(poses, side, point, Vector3::Zero(), slide, Vector3::Zero(),
         sign * start.displacement_rate.value_or(0.0) * (R * tangent));
    return;
  }
  move(poses, side, point, start.angle.value_or(0.0) * axis,
       start.displacement.value_or(0.0) * axis, start.angle_rate.value_or(0.0) * axis,
       start.displacement_rate.value_or(0.0) * axis);
}

[[noreturn]] void refuse(const model::Body& body, const std::string& what, std::size_t c) {
  throw ModelError("body." + body.name + ".motion",
                   "body '" + body.name + "': the start has " + what + " in " +
                       std::string(model::coordinate_names[c]) + ", which its motion locks");
}

/// Velocities along locked coordinates and turns about locked axes are contradictions.
void check_locked(const model::Body& body, const Pose& pose) {
  const std::array<bool, 6> free = model::free_coordinates(body);
  const auto rotations = std::count(free.begin() + 3, free.end(), true);
  const double speed = 1e-9 * std::max(1.0, pose.v.norm()),
               rate = 1e-9 * std::max(1.0, pose.w.norm());
  for (std::size_t c = 0; c < 3; ++c) {
    const auto i = static_cast<Eigen::Index>(c);
    if (!free[c] && std::abs(pose.v[i]) > speed)
      refuse(body, "a velocity", c);
    if (rotations == 3)
      continue;
    if (!free[3 + c] && std::abs(pose.w[i]) > rate)
      refuse(body, "an angular velocity", 3 + c);
    if (rotations == 1 && !free[3 + c] && std::abs(pose.p[1 + i]) > 1e-9)
      refuse(body, "a rotation", 3 + c);
  }
}

} // namespace

int body_index(const model::Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].name == name)
      return static_cast<int>(i);
  return -1;
}

Matrix3 marker_axes(const model::Joint& joint) {
  const Vector3 z = joint.axis ? joint.axis->normalized() : Vector3::UnitZ();
  Vector3 x = joint.axis_x.value_or(Vector3::UnitX());
  x -= x.dot(z) * z;
  if (x.norm() < 1e-6) { // the default x lies along the axis: take world y
    if (joint.axis_x)
      throw ModelError("joint." + joint.name + ".axis_x",
                       "joint '" + joint.name + "': axis_x is parallel to axis");
    x = Vector3::UnitY() - z[1] * z;
  }
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
                quaternion_from_rotation_vector(start.rotation), start.velocity,
                start.angular_velocity};
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    apply_joint_start(scene, j, poses);
  for (std::size_t i = 0; i < poses.size(); ++i)
    check_locked(scene.bodies[i], poses[i]);
  return poses;
}

} // namespace hydrodae::system
