#pragma once
#include <vector>

#include "hydrodae/model/scene.h"

namespace hydrodae::build {

/// Start of one body: centre of gravity and quaternion in world axes.
struct Pose {
  Vector3 r = Vector3::Zero();
  Vector4 p{1, 0, 0, 0};
};

/// Initial poses of all bodies: the reference pose, displaced by `body.initial`, then moved joint
/// by joint by `joint.initial`. A joint moves its body B and everything connected to it; if that
/// includes the ground or a fixed body, it moves the other side in the opposite direction. The
/// assembly solves for joints in closed loops, and those that would move a locked coordinate.
/// Throws ModelError if a body starts turned about a locked axis.
std::vector<Pose> initial_poses(const model::Scene& scene);

/// Index of a body in the scene, -1 for "ground".
int body_index(const model::Scene& scene, const std::string& name);

/// Marker axes in the reference pose (columns x, y, z; z along `axis`, by default that of the
/// world; x along the part of `axis_x` across it), world axes.
Matrix3 marker_axes(const std::optional<Vector3>& axis, const std::optional<Vector3>& axis_x);

} // namespace hydrodae::build
