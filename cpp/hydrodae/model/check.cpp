#include "hydrodae/model/check.h"

#include <algorithm>
#include <string_view>

#include "hydrodae/core/text.h"
#include "hydrodae/element/dry_friction.h"
#include "hydrodae/line/line.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

/// Checks a name, which becomes part of key paths, channel paths and coordinate labels.
void check_name(const std::string& name, const std::string& kind) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    throw ModelError(kind + "." + name + ".name",
                     kind + " name " + in_quotes(name) + " may hold letters, digits, _ and - only");
}

void check_names(const std::vector<std::string>& names, const std::string& kind) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    check_name(names[i], kind);
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(names.begin(), here, names[i]) != here)
      throw ModelError(kind + "." + names[i] + ".name",
                       "two " + kind + " entries have the name " + in_quotes(names[i]));
  }
}

/// Checks names of stops and friction, which are reported among the constraints.
void check_reaction_names(const Scene& scene) {
  const std::vector<std::string> taken = names_of(scene.constraints);
  const auto check_free = [&](const std::string& kind, const std::string& name) {
    if (std::find(taken.begin(), taken.end(), name) != taken.end())
      refuse({kind, name}, "name",
             "a constraint has this name too, and the results list both by it");
  };
  for (const Joint& joint : scene.joints)
    if (joint.one_sided)
      check_free("joint", joint.name);
  for (const element::DryFriction& f : forces_of<element::DryFriction>(scene)) {
    check_free("force", f.name);
    const Joint* joint = find_named(scene.joints, f.name);
    if (joint && joint->one_sided)
      refuse({"force", f.name}, "name",
             "a one-sided joint has this name too, and the results list both by it");
  }
}

} // namespace

void refuse(const Entry& entry, const std::string& key, const std::string& message) {
  throw ModelError(entry.kind + "." + entry.name + (key.empty() ? "" : "." + key),
                   entry.kind + " " + in_quotes(entry.name) + ": " + message);
}

std::vector<std::string> names_of_bodies(const Scene& scene) {
  std::vector<std::string> out;
  for (const Body& body : scene.bodies)
    if (!body.is_mode())
      out.push_back(body.name);
  return out;
}

void check_reference(const Entry& entry, const std::string& key, const std::string& name,
                     const std::vector<std::string>& names, const std::string& sort) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    refuse(entry, key, key + " = " + in_quotes(name) + " is no " + sort + suggestion(name, names));
}

void check_ends(const Scene& scene, const Entry& entry, const std::string& body_a,
                const std::string& body_b) {
  std::vector<std::string> names = {std::string(ground)};
  const std::vector<std::string> bodies = names_of_bodies(scene);
  names.insert(names.end(), bodies.begin(), bodies.end());
  check_reference(entry, "body_a", body_a, names, "body");
  check_reference(entry, "body_b", body_b, names, "body");
  if (body_a == body_b)
    refuse(entry, "body_b", "joins " + in_quotes(body_a) + " with itself");
}

bool coincide(const Vector3& a, const Vector3& b) {
  return (b - a).norm() <= 1e-12 * std::max(a.norm(), b.norm());
}

void check(const Scene& scene) {
  if (scene.bodies.empty() && forces_of<line::Line>(scene).empty())
    throw ModelError("body", "the case has no [[body]]");
  std::vector<std::string> bodies; // bodies of the case
  for (const Body& body : scene.bodies)
    if (!body.part)
      bodies.push_back(body.name);
  check_names(bodies, "body");
  check_names(names_of(scene.modes), "mode");
  check_names(names_of(scene.attachments), "attachment");
  check_names(names_of(scene.joints), "joint");
  check_names(names_of(scene.constraints), "constraint");
  check_reaction_names(scene);
  check_names(names_of(scene.markers), "marker");
  const std::vector<std::string> forces = force_names(scene);
  check_names(forces, "force");
  check_names(names_of(scene.morison), "morison");
  check_names(names_of(scene.chambers), "chamber");
  check_names(names_of(scene.pistons), "piston");
  check_names(names_of(scene.outlets), "outlet");
  check_names(names_of(scene.waves), "wave");
  check_names(names_of(scene.gauges), "gauge");
  check_names(names_of(scene.controllers), "controller");
  check_names(names_of(scene.pose_tables), "pose_table");

  for (const Body& body : scene.bodies) {
    if (body.name == ground)
      throw ModelError(body.part ? "attachment.ground.name" : "body.ground.name",
                       "'ground' is the name of the fixed world");
    if (!body.part)
      check_body(scene, body);
  }
  for (const Joint& joint : scene.joints)
    check_joint(scene, joint);
  for (const Constraint& constraint : scene.constraints)
    check_constraint(scene, constraint);
  for (const Marker& marker : scene.markers)
    check_marker(scene, marker);
  check_forces(scene);
  check_morison(scene);
  check_chambers(scene);
  for (const PoseTable& table : scene.pose_tables)
    check_reference({"pose_table", table.name}, "body", table.body, names_of_bodies(scene), "body");
  check_claims(scene);
  for (const Controller& controller : scene.controllers)
    check_controller(scene, controller);
  check_solver(scene);
  check_sea(scene);
  check_seabed(scene);
  for (const sea::Gauge& gauge : scene.gauges)
    check_gauge(scene, gauge);
  check_parts(scene);
  if (scene.hydro && scene.database)
    check_database(scene);
  check_second_order(scene);
  for (const PoseTable& table : scene.pose_tables)
    check_pose_table(scene, table);
}

} // namespace hydrodae::model
