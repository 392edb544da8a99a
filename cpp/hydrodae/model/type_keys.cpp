#include "hydrodae/model/type_keys.h"

#include <algorithm>

#include "hydrodae/joint/types.h"
#include "hydrodae/sea/wave.h"

namespace hydrodae::model {
namespace {

using Keys = std::vector<std::string>;

void add(Keys& keys, const Keys& more) { keys.insert(keys.end(), more.begin(), more.end()); }

Keys joint_keys(const std::string& name) {
  using Row = joint::BasicRow::Kind;
  const joint::JointType* type = joint::find_joint_type(name);
  if (!type)
    return {};
  Keys keys = {"name", "type", "body_a", "body_b", "point"};
  if (type->needs_axis || type->has_row(Row::perp))
    add(keys, {"axis", "axis_x"});
  if (type->has_row(Row::distance))
    add(keys, {"point_b", "length", "one_sided", "restitution"});
  if (type->has_row(Row::screw))
    add(keys, {"pitch"});
  if (type->has_row(Row::across))
    add(keys, {"path"});
  if (!type->motions.empty())
    add(keys, {"initial"});
  return keys;
}

Keys constraint_keys(const std::string& type) {
  if (type == "coordinate")
    return {"name", "type", "joint", "body", "coordinate", "level", "drive"};
  if (type == "coupler")
    return {"name", "type", "joint", "coordinate", "joint_b", "coordinate_b", "ratio"};
  if (type == "stop")
    return {"name",  "type",      "joint",     "coordinate", "lower",
            "upper", "lower_deg", "upper_deg", "restitution"};
  return {};
}

Keys wave_keys(const std::string& type) {
  for (const Field<sea::Wave>& field : sea::Wave::fields()) {
    if (field.key != "type")
      continue;
    if (std::find(field.choices.begin(), field.choices.end(), type) == field.choices.end())
      return {};
  }
  Keys keys = {"name", "type", "heading_deg"};
  add(keys, needed_wave_keys(type));
  if (type == "regular") {
    add(keys, {"phase_deg"});
  } else if (type == "measured") {
    add(keys, {"file", "time", "elevation", "point", "start", "taper", "lost_variance",
               "frequency_range"});
  } else {
    add(keys, {"spreading", "components", "spacing", "frequency_range", "lost_variance", "seed"});
    if (type == "jonswap")
      add(keys, {"gamma"});
    if (type == "ochi_hubble")
      add(keys, {"shape"});
  }
  return keys;
}

} // namespace

std::vector<std::string> needed_wave_keys(const std::string& type) {
  if (type == "regular")
    return {"height", "period"};
  if (type == "measured")
    return {};
  if (type == "table")
    return {"frequency", "density"};
  if (type == "pierson_moskowitz")
    return {"significant_height"};
  return {"significant_height", "peak_period"};
}

std::vector<std::string> keys_of_type(const std::string& kind, const std::string& type) {
  return kind == "joint"        ? joint_keys(type)
         : kind == "constraint" ? constraint_keys(type)
         : kind == "wave"       ? wave_keys(type)
                                : Keys{};
}

} // namespace hydrodae::model
