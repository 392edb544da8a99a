#include "hydrodae/core/text.h"
#include "hydrodae/joint/path.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

[[noreturn]] void refuse(const Joint& joint, const std::string& key, const std::string& message) {
  refuse(Entry{"joint", joint.name}, key, message);
}

void check_axes(const Joint& joint, const joint::JointType& type) {
  if (type.needs_axis && !joint.axis)
    refuse(joint, "", "a " + joint.type + " joint needs the key 'axis'");
  if (joint.axis && joint.axis->isZero(0.0))
    refuse(joint, "axis", "the axis has no length");
  if (!joint.axis_x)
    return;
  if (!joint.axis)
    refuse(joint, "axis_x", "key 'axis_x' needs the key 'axis'");
  if (joint.axis_x->normalized().cross(joint.axis->normalized()).norm() < 1e-6)
    refuse(joint, "axis_x", "axis_x must have a length and a direction other than the axis");
}

/// Checks the keys of the rows `distance`, `screw` and `across`.
void check_parameters(const Joint& joint, const joint::JointType& type) {
  const std::string kind = "a " + joint.type + " joint ";
  if (type.has_two_points()) {
    if (!joint.point_b)
      refuse(joint, "", kind + "needs the key 'point_b', the point on body B");
    if (coincide(joint.point, *joint.point_b))
      refuse(joint, "point_b", "point and point_b coincide: their distance has no direction");
  }
  if (joint.restitution && !joint.one_sided)
    refuse(joint, "restitution", "key 'restitution' needs one_sided = true");
  if (joint.contact_time && !joint.one_sided)
    refuse(joint, "contact_time", "key 'contact_time' needs one_sided = true");
  if (type.has_row<joint::ScrewRow>() && joint.pitch == 0.0)
    refuse(joint, "pitch", kind + "needs the key 'pitch' [m per turn], and not zero");
  if (!type.has_row<joint::AcrossRow>())
    return;
  if (joint.path.empty())
    refuse(joint, "", kind + "needs the key 'path', the points of the curve that body A carries");
  if (const auto flaw = joint::Path::flaw(joint.path))
    refuse(joint, "path", "the path " + *flaw);
}

/// Checks joints of point bodies: a point has no axes, so that no row can hold its rotation.
void check_points(const Scene& scene, const Joint& joint, const joint::JointType& type) {
  const auto is_point = [&](const std::string& name) {
    const Body* body = find_named(scene.bodies, name);
    return body && body->motion == std::vector<std::string>{"point"};
  };
  const bool a = is_point(joint.body_a), b = is_point(joint.body_b);
  if (!a && !b)
    return;
  const std::string head = "body " + in_quotes(a ? joint.body_a : joint.body_b) + " is a point: ";
  if (type.holds_turns() || type.turns())
    refuse(joint, a ? "body_a" : "body_b",
           head + "it has no rotation for a " + joint.type +
               " joint to hold; use spherical, distance, sliding or path");
  if (a && (type.needs_axis || type.has_row<joint::AcrossRow>()))
    refuse(joint, "body_a",
           head + "it cannot carry the " + (type.needs_axis ? "axis" : "curve") + " of a " +
               joint.type + " joint; make it body_b");
}

} // namespace

void check_joint(const Scene& scene, const Joint& joint) {
  const joint::JointType* type = joint::find_joint_type(joint.type);
  if (!type) {
    std::vector<std::string> names;
    for (std::string_view name : joint::joint_type_names())
      names.emplace_back(name);
    refuse(joint, "type", "unknown type " + in_quotes(joint.type) + suggestion(joint.type, names));
  }
  check_ends(scene, Entry{"joint", joint.name}, joint.body_a, joint.body_b);
  check_points(scene, joint, *type);
  check_axes(joint, *type);
  check_parameters(joint, *type);
}

} // namespace hydrodae::model
