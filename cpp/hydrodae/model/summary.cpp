#include <cmath>
#include <sstream>

#include "hydrodae/core/text.h"
#include "hydrodae/joint/path.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

void write_body(std::ostream& out, const Body& body) {
  out << "    " << body.name << ": " << joined(body.motion);
  if (moves(body))
    out << ", " << number_text(body.mass) << " kg";
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

/// "0.1 + 0.2 sin(2 pi t / 5 - 30 deg) + a table of 12 points"
std::string function_text(const Drive& drive) {
  std::string text;
  const auto add = [&](double factor, const std::string& what) {
    const bool minus = factor < 0.0;
    text += text.empty() ? (minus ? "-" : "") : (minus ? " - " : " + ");
    text += number_text(std::abs(factor)) + (what.empty() ? "" : " " + what);
  };
  if (drive.constant != 0.0)
    add(drive.constant, "");
  if (drive.rate != 0.0)
    add(drive.rate, "t");
  if (drive.amplitude != 0.0) {
    std::string sine = "sin(2 pi t / " + number_text(drive.period);
    if (drive.phase != 0.0)
      sine += (drive.phase < 0.0 ? " - " : " + ") +
              number_text(std::abs(drive.phase) * 180.0 / pi) + " deg";
    sine += drive.ramp > 0.0 ? ") grown over " + number_text(drive.ramp) + " s" : ")";
    add(drive.amplitude, sine);
  }
  if (!drive.time.empty())
    text += std::string(text.empty() ? "" : " + ") + "a table of " +
            std::to_string(drive.time.size()) + " points";
  if (drive.python)
    text += std::string(text.empty() ? "" : " + ") + "a Python function";
  return text.empty() ? "0" : text;
}

void write_constraint(std::ostream& out, const Scene& scene, const Constraint& c) {
  const auto motion = [&](const std::string& joint, const std::optional<std::string>& coordinate) {
    return coordinate_of(scene, joint, coordinate) + " of " + joint;
  };
  out << "    " << c.name << ": ";
  if (c.type == "coupler") {
    out << motion(*c.joint_b, c.coordinate_b) << " moves " << number_text(c.ratio) << " x "
        << motion(*c.joint, c.coordinate) << '\n';
    return;
  }
  if (c.type == "stop") {
    out << motion(*c.joint, c.coordinate) << " stays";
    const auto bound = [&](const char* word, const std::optional<double>& length,
                           const std::optional<double>& angle) {
      if (length)
        out << ' ' << word << ' ' << number_text(*length) << " m";
      if (angle)
        out << ' ' << word << ' ' << number_text(*angle * 180.0 / pi) << " deg";
    };
    bound("above", c.lower, c.lower_angle);
    bound("below", c.upper, c.upper_angle);
    out << ", restitution " << number_text(c.restitution.value_or(0.0)) << '\n';
    return;
  }
  const Drive& drive = c.drive;
  const bool steady =
      drive.rate == 0.0 && drive.amplitude == 0.0 && !drive.python && drive.time.empty();
  out << (c.level == "velocity" ? "rate of " : "")
      << (c.joint ? motion(*c.joint, c.coordinate) : *c.coordinate + " of " + *c.body)
      << (steady ? " stays " : " follows ") << function_text(drive) << '\n';
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
      << moving_coordinates(scene).size() << " move, " << scene.hydro->axes << " axes\n";
  out << "    radiation: " << scene.hydro->radiation;
  if (const hydro::MemoryFit* fit = memory_fit(scene))
    out << ", fit " << in_quotes(fit->name) << " with " << fit->states << " states for "
        << fit->inputs.size() << " coordinates" << (fit->passive ? ", passive" : ", not passive");
  if (database.kernel)
    out << ", kernel of "
        << number_text(scene.hydro->memory_length.value_or(database.kernel->length()))
        << " s in steps of " << number_text(database.kernel->step) << " s";
  out << '\n';
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
    write_body(out, body);
  if (!scene.joints.empty())
    out << "  joints:\n";
  for (const Joint& joint : scene.joints)
    write_joint(out, joint);
  if (!scene.constraints.empty())
    out << "  constraints:\n";
  for (const Constraint& constraint : scene.constraints)
    write_constraint(out, scene, constraint);
  bool any_force = false;
  const auto write_list = [&](const auto& list) {
    if (!list.empty() && !any_force)
      out << "  forces:\n";
    any_force = any_force || !list.empty();
    for (const auto& force : list)
      write_force(out, force);
  };
  std::apply([&](const auto&... list) { (write_list(list), ...); }, scene.forces);
  if (!scene.morison.empty())
    out << "  morison elements:\n";
  for (const water::Morison& m : scene.morison)
    out << "    " << m.name << ": " << (m.point ? "point" : "member") << " of body " << m.body
        << '\n';
  if (scene.hydro && scene.database)
    write_hydro(out, scene);
  write_solver(out, scene);
  return out.str();
}

} // namespace hydrodae::model
