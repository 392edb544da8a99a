#include "hydrodae/core/text.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/forces.h"

namespace hydrodae::model {
namespace {

/// Checks a line. Both ends may be on the ground or on one body: its weight and its tension count.
template <class Line> void check_line(const Scene& scene, const Entry& entry, const Line& line) {
  std::vector<std::string> names = names_of_bodies(scene);
  names.emplace_back(ground);
  check_reference(entry, "body_a", line.body_a, names, "body");
  check_reference(entry, "body_b", line.body_b, names, "body");
}

/// Checks the references of a force, by its members: `body` names a body, `joint` a joint, `body_a`
/// and `body_b` the two ends.
template <class Force> void check_force(const Scene& scene, const Force& force) {
  const Entry entry{"force", force.name};
  if constexpr (requires { force.body; })
    check_reference(entry, "body", force.body, names_of_bodies(scene), "body");
  if constexpr (requires { force.joint; }) {
    const bool angle = check_motion(scene, entry, force.joint, force.coordinate);
    check_bounds(entry, force, angle);
  }
  if constexpr (requires { force.fault(); })
    if (const std::optional<Fault> fault = force.fault())
      refuse(entry, fault->key, fault->message);
  if constexpr (std::is_same_v<Force, line::Line> || std::is_same_v<Force, line::CatenaryLine>) {
    check_line(scene, entry, force);
  } else if constexpr (requires { force.body_a; }) {
    check_ends(scene, entry, force.body_a, force.body_b);
    if constexpr (requires { force.point_a; })
      if (coincide(force.point_a, force.point_b)) {
        bool rests = false;
        if constexpr (requires { force.rests_at_zero(); })
          rests = force.rests_at_zero();
        if (!rests)
          refuse(entry, "point_b",
                 "point_a and point_b coincide in the reference pose: the force has no direction "
                 "there, and is not zero (a linear spring with length = 0 is)");
      }
  }
  if constexpr (requires { force.bodies; }) {
    std::vector<std::string> names = names_of_bodies(scene);
    names.emplace_back(ground);
    bool moves = false;
    for (const std::string& body : force.bodies) {
      check_reference(entry, "bodies", body, names, "body");
      moves = moves || body != ground;
    }
    if (!moves)
      refuse(entry, "bodies", "acts on the ground only");
  }
  if constexpr (requires { force.axis_x; }) {
    const Vector3 z = force.axis.value_or(Vector3::UnitZ());
    if (z.isZero(0.0))
      refuse(entry, "axis", "the axis has no length");
    if (force.axis_x && force.axis_x->normalized().cross(z.normalized()).norm() < 1e-6)
      refuse(entry, "axis_x", "axis_x must have a length and a direction other than the axis");
  }
}

} // namespace

bool check_motion(const Scene& scene, const Entry& entry, const std::string& name,
                  const std::optional<std::string>& coordinate) {
  check_joint_coordinate(scene, entry, "joint", name, "coordinate", coordinate);
  const std::string& type = find_named(scene.joints, name)->type;
  const std::vector<std::string> motions = joint::motion_names(*joint::find_joint_type(type));
  if (!coordinate && motions.size() > 1)
    refuse(entry, "joint",
           "a " + type + " joint has more than one coordinate: name one by the key 'coordinate'" +
               suggestion("", motions));
  return coordinate.value_or(motions.front()).starts_with("angle");
}

void check_forces(const Scene& scene) {
  for_each_force(scene, [&](const auto& force) { check_force(scene, force); });
}

} // namespace hydrodae::model
