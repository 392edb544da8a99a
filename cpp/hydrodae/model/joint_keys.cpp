#include "hydrodae/model/joint_keys.h"

namespace hydrodae::model {

JointKeys joint_keys(const joint::JointType& type) {
  JointKeys keys{{"name", "type", "body_a", "body_b", "point"}, {}, {}};
  const auto has = [&](const std::vector<std::string>& more) {
    keys.own.insert(keys.own.end(), more.begin(), more.end());
  };
  const auto needs = [&](const std::string& key) {
    has({key});
    keys.needed.push_back(key);
  };
  if (type.needs_axis)
    needs("axis");
  else if (type.has_row<joint::PerpRow>())
    has({"axis"});
  if (type.needs_axis || type.has_row<joint::PerpRow>())
    has({"axis_x"});
  if (type.has_two_points())
    needs("point_b");
  if (type.has_row<joint::DistanceRow>())
    has({"length", "one_sided", "restitution", "contact_time"});
  if (type.has_row<joint::ScrewRow>())
    needs("pitch");
  if (type.has_row<joint::AcrossRow>())
    needs("path");
  if (!type.motions.empty())
    has({"initial"});
  if (type.turns())
    keys.initial = {"angle_deg", "angle_rate"};
  if (type.slides())
    keys.initial.insert(keys.initial.end(), {"displacement", "displacement_rate"});
  return keys;
}

} // namespace hydrodae::model
