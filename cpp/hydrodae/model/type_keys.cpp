#include "hydrodae/model/type_keys.h"

#include <algorithm>
#include <map>

#include "hydrodae/joint/types.h"
#include "hydrodae/model/controller.h"
#include "hydrodae/sea/wave.h"

namespace hydrodae::model {
namespace {

using Keys = std::vector<std::string>;
using RowKind = joint::BasicRow::Kind;

void add(Keys& keys, const Keys& more) { keys.insert(keys.end(), more.begin(), more.end()); }

Keys joint_keys(const std::string& name) {
  const joint::JointType* type = joint::find_joint_type(name);
  if (!type)
    return {};
  Keys keys = {"name", "type", "body_a", "body_b", "point"};
  if (type->needs_axis || type->has_row(RowKind::perp))
    add(keys, {"axis", "axis_x"});
  if (type->has_two_points())
    add(keys, {"point_b"});
  if (type->has_row(RowKind::distance))
    add(keys, {"length", "one_sided", "restitution", "contact_time"});
  if (type->has_row(RowKind::screw))
    add(keys, {"pitch"});
  if (type->has_row(RowKind::across))
    add(keys, {"path"});
  if (!type->motions.empty())
    add(keys, {"initial"});
  return keys;
}

Keys joint_initial_keys(const std::string& name) {
  const joint::JointType* type = joint::find_joint_type(name);
  Keys keys;
  if (type && type->turns())
    add(keys, {"angle_deg", "angle_rate"});
  if (type && type->slides())
    add(keys, {"displacement", "displacement_rate"});
  return keys;
}

Keys needed_joint_keys(const std::string& name) {
  const joint::JointType* type = joint::find_joint_type(name);
  Keys keys;
  if (!type)
    return keys;
  if (type->needs_axis)
    add(keys, {"axis"});
  if (type->has_two_points())
    add(keys, {"point_b"});
  if (type->has_row(RowKind::screw))
    add(keys, {"pitch"});
  if (type->has_row(RowKind::across))
    add(keys, {"path"});
  return keys;
}

Keys constraint_keys(const std::string& type) {
  if (type == "coordinate")
    return {"name", "type", "joint", "body", "coordinate", "level", "drive"};
  if (type == "coupler")
    return {"name", "type", "joint", "coordinate", "joint_b", "coordinate_b", "ratio"};
  if (type == "stop")
    return {"name",  "type",      "joint",     "coordinate",  "lower",
            "upper", "lower_deg", "upper_deg", "restitution", "contact_time"};
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
  add(keys, needed_keys("wave", type));
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

Keys needed_wave_keys(const std::string& type) {
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

Keys needed_constraint_keys(const std::string& type) {
  if (type == "coupler")
    return {"joint", "joint_b"};
  return type == "stop" ? Keys{"joint"} : Keys{};
}

const std::map<std::string, std::string> type_docs = {
    {"constraint.coordinate", "One coordinate of a joint or a body follows a function of time."},
    {"constraint.coupler", "Two joint coordinates keep a ratio, as gears, racks and belts do: "
                           "s_b - s_b(0) = ratio (s - s(0))."},
    {"constraint.stop", "A joint coordinate stays within bounds, with impacts."},
    {"controller.pid", "u = Kp e + Ki int e + Kd e' with e = target - input; within limits."},
    {"controller.reactive", "u = -K (s - s0) - C s' of a coordinate and its rate."},
    {"controller.resistive", "u = -C s' of a rate."},
    {"controller.bang_bang",
     "u = upper or lower by the sign of e = target - input, with hysteresis."},
    {"controller.declutching",
     "Frees a machine from each standstill of a joint on, for some time; else it works."},
    {"controller.latching",
     "Holds a joint by its dry friction from a standstill on, for some time."},
    {"controller.table", "u as a function of one channel, straight lines between points."},
    {"controller.python", "A Python function or object, given to the run."},
    {"controller.fmu", "An FMU for co-simulation (fmi-standard.org)."},
    {"controller.tcp", "Another program, over TCP/IP in lock-step."},
    {"wave.regular", "One wave of one period: H/2 cos(w t - k.x + phase)."},
    {"wave.jonswap", "JONSWAP spectrum (Hasselmann et al. 1973)."},
    {"wave.bretschneider", "JONSWAP spectrum with gamma = 1."},
    {"wave.pierson_moskowitz", "Spectrum of a fully grown wind sea; its period follows from Hs."},
    {"wave.ochi_hubble", "One part of the spectrum of Ochi and Hubble (1976); the other part is a "
                         "wave system of its own."},
    {"wave.table", "Spectrum given point by point, straight lines between."},
    {"wave.measured", "Elevation over time at a point: the harmonics of the record."},
};

} // namespace

std::vector<std::string> keys_of_type(const std::string& kind, const std::string& type) {
  return kind == "joint"           ? joint_keys(type)
         : kind == "joint.initial" ? joint_initial_keys(type)
         : kind == "constraint"    ? constraint_keys(type)
         : kind == "wave"          ? wave_keys(type)
         : kind == "controller"    ? controller_keys(type)
                                   : Keys{};
}

std::vector<std::string> needed_keys(const std::string& kind, const std::string& type) {
  return kind == "joint"        ? needed_joint_keys(type)
         : kind == "constraint" ? needed_constraint_keys(type)
         : kind == "wave"       ? needed_wave_keys(type)
         : kind == "controller" ? needed_controller_keys(type)
                                : Keys{};
}

std::string doc_of_type(const std::string& kind, const std::string& type) {
  if (kind == "joint") {
    const joint::JointType* row = joint::find_joint_type(type);
    return row ? std::string(row->doc) : "";
  }
  const auto found = type_docs.find(kind + "." + type);
  return found == type_docs.end() ? "" : found->second;
}

} // namespace hydrodae::model
