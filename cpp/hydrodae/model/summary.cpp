#include <cmath>
#include <sstream>
#include <utility>

#include "hydrodae/core/text.h"
#include "hydrodae/joint/path.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

void write_body(std::ostream& out, const Scene& scene, const Body& body) {
  if (body.is_mode()) {
    const Mode& mode = scene.modes[body.part->entry];
    out << "    " << mode.name << ": mode of " << mode.body << ", " << number_text(mode.mass)
        << " kg, " << number_text(mode.stiffness) << " N/m\n";
    return;
  }
  if (body.part) {
    out << "    " << body.name << ": attachment on " << body.part->body << '\n';
    return;
  }
  out << "    " << body.name << ": " << joined(body.motion);
  if (moves(body))
    out << ", " << number_text(body.mass.value) << " kg";
  if (body.hydro)
    out << ", hydro " << in_quotes(*body.hydro);
  out << '\n';
}

void write_start(std::ostream& out, const char* what, const std::optional<double>& value,
                 double factor, const char* unit) {
  if (value)
    out << ", starts at " << what << ' ' << number_text(*value * factor) << ' ' << unit;
}

void write_joint(std::ostream& out, const Joint& joint) {
  out << "    " << joint.name << ": " << joint.type << ", " << joint.body_a << " - "
      << joint.body_b;
  if (joint.point_b)
    out << ", length " << number_text(joint.length.value_or((*joint.point_b - joint.point).norm()))
        << " m";
  if (!joint.path.empty())
    out << ", path of " << joint.path.size() << " points, "
        << number_text(joint::Path(joint.path).length()) << " m long";
  if (joint.one_sided)
    out << " at most";
  if (joint.pitch != 0.0)
    out << ", " << number_text(joint.pitch) << " m per turn";
  write_start(out, "angle", joint.initial.angle, 180.0 / pi, "deg");
  write_start(out, "angle rate", joint.initial.angle_rate, 1.0, "rad/s");
  write_start(out, "displacement", joint.initial.displacement, 1.0, "m");
  write_start(out, "displacement rate", joint.initial.displacement_rate, 1.0, "m/s");
  out << '\n';
}

void write_constraint(std::ostream& out, const Scene& scene, const Constraint& c) {
  const MotionText motion = [&](const Condition::Term& t) {
    return t.joint ? coordinate_of(scene, *t.joint, t.coordinate) + " of " + *t.joint
                   : t.coordinate.value_or("") + " of " + *t.body;
  };
  out << "    " << c->name << ": " << c.visit([&](const auto& one) { return one.text(motion); })
      << '\n';
}

void write_chamber(std::ostream& out, const Scene& scene, const air::Chamber& chamber) {
  out << "    " << chamber.name << ": " << number_text(chamber.volume) << " m3";
  for (const air::Piston& piston : scene.pistons)
    if (piston.chamber == chamber.name)
      out << ", piston " << piston.name << " (" << piston.joint.value_or(piston.mode.value_or(""))
          << ')';
  for (const air::AnyOutlet& outlet : scene.outlets)
    if (outlet->chamber == chamber.name)
      out << ", " << outlet.type() << ' ' << outlet->name
          << (outlet->to ? " to " + *outlet->to : std::string());
  out << '\n';
}

template <class Force> void write_force(std::ostream& out, const Force& force) {
  out << "    " << force.name << ": " << Force::type;
  if constexpr (requires { force.body; })
    out << " on body " << force.body;
  if constexpr (requires { force.joint; })
    out << " on joint " << force.joint;
  if constexpr (requires { force.delay; })
    if (force.delay > 0.0)
      out << ", " << number_text(force.delay) << " s late";
  if constexpr (requires { force.body_a; })
    out << " between " << force.body_a << " and " << force.body_b;
  if constexpr (requires { force.bodies; })
    out << " over " << force.bodies.size() << " points of " << joined(force.bodies);
  out << '\n';
}

void write_hydro(std::ostream& out, const Scene& scene) {
  const hydro::Database& database = *scene.database;
  out << "  hydro: " << database.path << '\n'
      << "    " << database.coordinates.size() << " coordinates, "
      << moving_coordinates(scene).size() << " move, " << scene.hydro->axes << " axes\n"
      << "    water: " << number_text(database.rho) << " kg/m3, gravity "
      << number_text(database.gravity) << " m/s2\n";
  out << "    radiation: " << scene.hydro->radiation;
  if (const hydro::MemoryFit* fit = memory_fit(scene))
    out << ", fit " << in_quotes(fit->name) << " with " << fit->states << " states for "
        << fit->inputs.size() << " coordinates" << (fit->passive ? ", passive" : ", not passive");
  if (database.kernel)
    out << ", kernel of "
        << number_text(scene.hydro->memory_length.value_or(database.kernel->length()))
        << " s in steps of " << number_text(database.kernel->step) << " s";
  out << '\n';
  for (const PoseTable& table : scene.pose_tables) {
    const double unit = table.turns() ? pi / 180.0 : 1.0;
    out << "    pose table " << in_quotes(table.name) << ": " << table.body << " by its "
        << table.coordinate << ", " << table.databases.size() << " databases from "
        << rounded_text(table.poses().front() / unit, 4) << " to "
        << rounded_text(table.poses().back() / unit, 4) << (table.turns() ? " deg" : " m") << '\n';
  }
}

void write_solver(std::ostream& out, const Scene& scene) {
  const SolverOptions& solver = scene.solver;
  out << "  solver: " << solver.method << ", " << number_text(solver.end_time) << " s, rtol "
      << number_text(solver.rtol) << ", output every " << number_text(scene.output.step) << " s\n";
}

} // namespace

std::string summary(const Scene& scene) {
  std::ostringstream out;
  out << (scene.title.empty() ? "(no title)" : scene.title) << '\n';
  out << "  bodies:\n";
  for (const Body& body : scene.bodies)
    write_body(out, scene, body);
  if (!scene.joints.empty())
    out << "  joints:\n";
  for (const Joint& joint : scene.joints)
    write_joint(out, joint);
  if (!scene.constraints.empty())
    out << "  constraints:\n";
  for (const Constraint& constraint : scene.constraints)
    write_constraint(out, scene, constraint);
  bool any_force = false;
  for_each_force(scene, [&](const auto& force) {
    if (!std::exchange(any_force, true))
      out << "  forces:\n";
    write_force(out, force);
  });
  if (!scene.morison.empty())
    out << "  morison elements:\n";
  for (const water::Morison& m : scene.morison)
    out << "    " << m.name << ": " << (m.point ? "point" : "member") << " of body " << m.body
        << '\n';
  if (!scene.chambers.empty())
    out << "  chambers:\n";
  for (const air::Chamber& chamber : scene.chambers)
    write_chamber(out, scene, chamber);
  if (scene.hydro && scene.database)
    write_hydro(out, scene);
  write_solver(out, scene);
  return out.str();
}

} // namespace hydrodae::model
