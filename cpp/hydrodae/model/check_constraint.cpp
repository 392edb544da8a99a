#include "hydrodae/core/text.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/type_keys.h"

namespace hydrodae::model {

void check_joint_coordinate(const Scene& scene, const Entry& entry, const std::string& joint_key,
                            const std::string& joint, const std::string& coordinate_key,
                            const std::optional<std::string>& coordinate) {
  check_reference(entry, joint_key, joint, names_of(scene.joints), "joint");
  const std::string& type = find_named(scene.joints, joint)->type;
  const std::vector<std::string> names = joint::motion_names(*joint::find_joint_type(type));
  if (names.empty())
    refuse(entry, joint_key,
           "joint " + in_quotes(joint) + " has no coordinate: a " + type +
               " joint has no motion of its own");
  if (coordinate)
    check_reference(entry, coordinate_key, *coordinate, names,
                    "motion of joint " + in_quotes(joint));
}

namespace {

void check_body_coordinate(const Scene& scene, const Entry& entry, const std::string& name,
                           const std::optional<std::string>& coordinate) {
  check_reference(entry, "body", name, names_of(scene.bodies), "body");
  const std::array<bool, 6> free = free_coordinates(*find_named(scene.bodies, name));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 6; ++i)
    if (free[i])
      names.emplace_back(coordinate_names[i]);
  const std::string sort = "free coordinate of body " + in_quotes(name);
  if (!coordinate)
    refuse(entry, "", "needs the key 'coordinate', a " + sort + suggestion("", names));
  check_reference(entry, "coordinate", *coordinate, names, sort);
}

void check_table(const Entry& entry, const Drive& drive, double end_time) {
  const std::vector<double>& time = drive.time;
  const auto count = [](std::size_t n) {
    return std::to_string(n) + (n == 1 ? " number" : " numbers");
  };
  if (time.size() != drive.values.size())
    refuse(entry, time.empty() ? "drive.values" : "drive.time",
           "the table of drive needs as many times as values; 'time' has " + count(time.size()) +
               ", 'values' has " + count(drive.values.size()));
  if (time.empty())
    return;
  if (time.size() < 2)
    refuse(entry, "drive.time", "the table of drive needs two points or more, it has one");
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      refuse(entry, "drive.time",
             "the times of drive must ascend, but " + number_text(time[i]) + " s follows " +
                 number_text(time[i - 1]) + " s");
  if (time.front() > 0.0 || time.back() < end_time * (1.0 - 1e-12))
    refuse(entry, "drive.time",
           "the table of drive goes from " + number_text(time.front()) + " s to " +
               number_text(time.back()) + " s, but the run goes from 0 s to " +
               number_text(end_time) + " s (solver.end_time)");
}

void check_drive(const Entry& entry, const Drive& drive, double end_time) {
  if (drive.amplitude != 0.0 && !(drive.period > 0.0))
    refuse(entry, "drive.amplitude", "drive has an 'amplitude' but no 'period' of its sine");
  if (drive.amplitude != 0.0 && drive.period < 1e-10 * end_time)
    refuse(entry, "drive.period",
           "drive makes more than 1e+10 periods of " + number_text(drive.period) +
               " s until solver.end_time = " + number_text(end_time) + " s");
  check_table(entry, drive, end_time);
}

/// Refuses what only the other type of constraint has.
void refuse_if(bool given, const Entry& entry, const std::string& key, const std::string& type) {
  if (given)
    refuse(entry, key,
           "a " + type + " constraint has no " + in_quotes(key) +
               "; it has: " + joined(keys_of_type("constraint", type)));
}

void refuse_bounds(const Entry& entry, const Constraint& c) {
  refuse_if(c.lower.has_value(), entry, "lower", c.type);
  refuse_if(c.upper.has_value(), entry, "upper", c.type);
  refuse_if(c.lower_angle.has_value(), entry, "lower_deg", c.type);
  refuse_if(c.upper_angle.has_value(), entry, "upper_deg", c.type);
  refuse_if(c.restitution.has_value(), entry, "restitution", c.type);
  refuse_if(c.contact_time.has_value(), entry, "contact_time", c.type);
}

void check_coordinate(const Scene& scene, const Entry& entry, const Constraint& c) {
  if (!c.joint && !c.body)
    refuse(entry, "", "needs the key 'joint' or 'body' that has the coordinate");
  if (c.joint && c.body)
    refuse(entry, "body", "has both 'joint' and 'body'; a coordinate belongs to one of them");
  if (c.joint)
    check_joint_coordinate(scene, entry, "joint", *c.joint, "coordinate", c.coordinate);
  else
    check_body_coordinate(scene, entry, *c.body, c.coordinate);
  refuse_if(c.joint_b.has_value(), entry, "joint_b", c.type);
  refuse_if(c.coordinate_b.has_value(), entry, "coordinate_b", c.type);
  refuse_if(c.ratio != 1.0, entry, "ratio", c.type);
  refuse_bounds(entry, c);
  check_drive(entry, c.drive, scene.solver.end_time);
}

bool has_drive(const Drive& d) {
  return d.constant != 0.0 || d.rate != 0.0 || d.amplitude != 0.0 || d.python || !d.time.empty() ||
         !d.values.empty();
}

void check_coupler(const Scene& scene, const Entry& entry, const Constraint& c) {
  refuse_if(c.body.has_value(), entry, "body", c.type);
  refuse_if(c.level != "position", entry, "level", c.type);
  refuse_if(has_drive(c.drive), entry, "drive", c.type);
  refuse_bounds(entry, c);
  if (!c.joint || !c.joint_b)
    refuse(entry, "",
           std::string("a coupler needs the key ") + (c.joint ? "'joint_b'" : "'joint'"));
  check_joint_coordinate(scene, entry, "joint", *c.joint, "coordinate", c.coordinate);
  check_joint_coordinate(scene, entry, "joint_b", *c.joint_b, "coordinate_b", c.coordinate_b);
  if (*c.joint == *c.joint_b && coordinate_of(scene, *c.joint, c.coordinate) ==
                                    coordinate_of(scene, *c.joint_b, c.coordinate_b))
    refuse(entry, "joint_b", "couples a motion of " + in_quotes(*c.joint) + " with itself");
  if (c.ratio == 0.0)
    refuse(entry, "ratio", "ratio must not be zero");
}

void check_stop(const Scene& scene, const Entry& entry, const Constraint& c) {
  refuse_if(c.body.has_value(), entry, "body", c.type);
  refuse_if(c.level != "position", entry, "level", c.type);
  refuse_if(has_drive(c.drive), entry, "drive", c.type);
  refuse_if(c.joint_b.has_value(), entry, "joint_b", c.type);
  refuse_if(c.coordinate_b.has_value(), entry, "coordinate_b", c.type);
  refuse_if(c.ratio != 1.0, entry, "ratio", c.type);
  if (!c.joint)
    refuse(entry, "", "a stop needs the key 'joint' that has the coordinate");
  check_joint_coordinate(scene, entry, "joint", *c.joint, "coordinate", c.coordinate);
  const bool angle = coordinate_of(scene, *c.joint, c.coordinate).starts_with("angle");
  if (angle && (c.lower || c.upper))
    refuse(entry, c.lower ? "lower" : "upper",
           "the coordinate is an angle: write 'lower_deg' and 'upper_deg'");
  if (!angle && (c.lower_angle || c.upper_angle))
    refuse(entry, c.lower_angle ? "lower_deg" : "upper_deg",
           "the coordinate is a displacement: write 'lower' and 'upper'");
  const std::optional<double>& lower = angle ? c.lower_angle : c.lower;
  const std::optional<double>& upper = angle ? c.upper_angle : c.upper;
  if (!lower && !upper)
    refuse(entry, "",
           angle ? "a stop needs the key 'lower_deg' or 'upper_deg'"
                 : "a stop needs the key 'lower' or 'upper'");
  if (lower && upper && !(*lower < *upper))
    refuse(entry, angle ? "upper_deg" : "upper", "the upper bound must be above the lower one");
}

} // namespace

void check_constraint(const Scene& scene, const Constraint& constraint) {
  const Entry entry{"constraint", constraint.name};
  if (constraint.type == "coordinate")
    check_coordinate(scene, entry, constraint);
  else if (constraint.type == "coupler")
    check_coupler(scene, entry, constraint);
  else if (constraint.type == "stop")
    check_stop(scene, entry, constraint);
  else
    check_reference(entry, "type", constraint.type, {"coordinate", "coupler", "stop"},
                    "constraint");
}

} // namespace hydrodae::model
