#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

[[noreturn]] void refuse(const Joint& joint, const std::string& key, const std::string& message) {
  throw ModelError("joint." + joint.name + (key.empty() ? "" : "." + key),
                   "joint " + in_quotes(joint.name) + ": " + message);
}

void check_end(const Scene& scene, const Joint& joint, const std::string& key,
               const std::string& name) {
  std::vector<std::string> names = {"ground"};
  for (const Body& body : scene.bodies)
    names.push_back(body.name);
  if (std::find(names.begin(), names.end(), name) == names.end())
    refuse(joint, key, key + " = " + in_quotes(name) + " is no body" + suggestion(name, names));
}

void check_axes(const Joint& joint, const joint::JointType& type) {
  const bool directed =
      std::any_of(type.rows.begin(), type.rows.end(), [](const joint::BasicRow& row) {
        return row.kind == joint::BasicRow::Kind::perp;
      });
  if (type.needs_axis && !joint.axis)
    refuse(joint, "", "a " + joint.type + " joint needs the key 'axis'");
  if (!directed && (joint.axis || joint.axis_x))
    refuse(joint, joint.axis ? "axis" : "axis_x", "a " + joint.type + " joint has no axis");
  if (joint.axis && joint.axis->isZero(0.0))
    refuse(joint, "axis", "the axis has no length");
  if (!joint.axis_x)
    return;
  if (!joint.axis)
    refuse(joint, "axis_x", "key 'axis_x' needs the key 'axis'");
  if (joint.axis_x->normalized().cross(joint.axis->normalized()).norm() < 1e-6)
    refuse(joint, "axis_x", "axis_x must have a length and a direction other than the axis");
}

void check_initial(const Joint& joint, const joint::JointType& type) {
  const JointInitial& start = joint.initial;
  const auto refuse_key = [&](const char* key, const char* motion) {
    refuse(joint, std::string("initial.") + key,
           std::string("initial ") + key + ": a " + joint.type + " joint does not " + motion);
  };
  if (start.angle && !type.turns())
    refuse_key("angle_deg", "turn");
  if (start.angle_rate && !type.turns())
    refuse_key("angle_rate", "turn");
  if (start.displacement && !type.slides())
    refuse_key("displacement", "slide");
  if (start.displacement_rate && !type.slides())
    refuse_key("displacement_rate", "slide");
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
  check_end(scene, joint, "body_a", joint.body_a);
  check_end(scene, joint, "body_b", joint.body_b);
  if (joint.body_a == joint.body_b)
    refuse(joint, "body_b", "joins " + in_quotes(joint.body_a) + " with itself");
  check_axes(joint, *type);
  check_initial(joint, *type);
}

} // namespace hydrodae::model
