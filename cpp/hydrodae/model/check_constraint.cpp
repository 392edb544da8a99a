#include "hydrodae/core/text.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"

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
  check_reference(entry, "body", name, names_of_bodies(scene), "body");
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

void check_term(const Scene& scene, const Entry& entry, const Condition::Term& term) {
  if (term.joint)
    check_joint_coordinate(scene, entry, term.joint_key, *term.joint, term.coordinate_key,
                           term.coordinate);
  else
    check_body_coordinate(scene, entry, *term.body, term.coordinate);
}

/// Refuses two terms on one motion of a joint.
void check_apart(const Scene& scene, const Entry& entry, const Condition& condition) {
  if (condition.terms.size() < 2)
    return;
  const Condition::Term &a = condition.terms[0], &b = condition.terms[1];
  if (a.joint && a.joint == b.joint &&
      coordinate_of(scene, *a.joint, a.coordinate) == coordinate_of(scene, *b.joint, b.coordinate))
    refuse(entry, a.joint_key, "couples a motion of " + in_quotes(*a.joint) + " with itself");
}

} // namespace

void check_constraint(const Scene& scene, const Constraint& constraint) {
  const Entry entry{"constraint", constraint->name};
  check_own(entry, constraint);
  const Condition condition = constraint.visit([](const auto& one) { return one.condition(); });
  for (auto term = condition.terms.rbegin(); term != condition.terms.rend(); ++term)
    check_term(scene, entry, *term);
  check_apart(scene, entry, condition);
  check_drive(entry, condition.drive, scene.solver.end_time);
  if (condition.bounds) {
    const Condition::Term& term = condition.terms.front();
    const bool angle = coordinate_of(scene, *term.joint, term.coordinate).starts_with("angle");
    constraint.visit([&](const auto& one) { check_bounds(entry, one, angle); });
  }
}

} // namespace hydrodae::model
