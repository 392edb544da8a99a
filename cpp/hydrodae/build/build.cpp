/// Builds the system of a scene: degrees of freedom, layout, start.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/build/initial_pose.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/mass.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/system/declare.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/turning.h"

namespace hydrodae::build {

namespace {

system::BodyData make_body(const model::Body& body, const Pose& pose) {
  system::BodyData b;
  b.name = body.name;
  if (body.part)
    b.kind = body.part->mode ? system::BodyData::Kind::mode : system::BodyData::Kind::attachment;
  b.mass = body.mass.value;
  b.inertia = model::inertia_tensor(body);
  b.reference = body.center_of_gravity;
  b.position = pose.r;
  b.orientation = pose.p;
  const std::array<bool, 6> free = model::free_coordinates(body);
  for (int c = 0; c < 6; ++c) {
    if (!free[c])
      continue;
    b.active[b.n_active++] = c;
    if (c < 3)
      ++b.n_translations;
  }
  const int rotations = b.n_active - b.n_translations;
  if (rotations == 1) {
    b.rotation = system::BodyData::Rotation::about_axis;
    b.axis = b.active[b.n_active - 1] - 3;
  } else if (rotations == 3) {
    b.rotation = system::BodyData::Rotation::free;
  }
  b.n_position = b.n_translations + (rotations == 3 ? 4 : rotations);
  return b;
}

/// Notes parts of the device that the case declares as missing.
void note_missing(const model::Scene& scene, system::System& s) {
  for (const std::string& part : scene.missing)
    s.notes.push_back("missing in the case: " + part);
}

/// Notes masses that follow from the displaced water.
void note_masses(const model::Scene& scene, system::System& s) {
  for (const model::Body& body : scene.bodies)
    if (!body.mass.word.empty())
      s.notes.push_back("body " + in_quotes(body.name) + ": mass " +
                        rounded_text(body.mass.value, 6) +
                        " kg, that of the water which it displaces in the reference pose");
}

/// Initial values that the case gives for its bodies.
std::vector<BodyStart> body_starts(const model::Scene& scene) {
  std::vector<BodyStart> out;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const model::BodyInitial& start = scene.bodies[i].initial;
    const bool placed = !start.displacement.isZero(0.0) || !start.rotation.isZero(0.0);
    if (placed || start.velocity || start.angular_velocity)
      out.push_back({static_cast<int>(i), placed, start.velocity, start.angular_velocity});
  }
  return out;
}

} // namespace

system::System build(const model::Scene& scene, const Sea& sea, bool with_excitation) {
  system::System s;
  s.gravity = model::water(scene).gravity;
  const std::vector<Pose> poses = initial_poses(scene);
  for (std::size_t i = 0; i < poses.size(); ++i)
    s.bodies.push_back(make_body(scene.bodies[i], poses[i]));
  note_missing(scene, s);
  note_masses(scene, s);
  for (const model::Joint& joint : scene.joints)
    add_joint(scene, joint, s);
  set_body_scales(scene, s);
  select_rows(s);
  add_hydro(scene, s);
  add_constraints(scene, s);
  add_attachments(scene, s);
  add_elements(scene, sea, s);
  add_chambers(scene, s);
  set_mode_loads(scene, s);
  note_weights(scene, s);
  add_morison(scene, sea, s);
  add_hulls(scene, sea, with_excitation, s);
  for (const model::Marker& m : scene.markers)
    s.markers.push_back({m.name, body_index(scene, m.body),
                         m.point - scene.bodies[body_index(scene, m.body)].center_of_gravity,
                         m.axes == "body"});
  add_gauges(scene, sea, s);
  set_coupler_offsets(s);
  system::find_mechanisms(s);
  set_scale_masses(s);
  system::number(s);
  assemble(s, {scene.solver.tolerance_assembly, scene.solver.end_time, scene.solver.force},
           body_starts(scene));
  find_reactions(s);
  take_mean_yaw(scene, s);
  start_laws(s);
  if (with_excitation) {
    note_axes(scene, s);
    add_sea(scene, sea, s);
    add_second_order(scene, sea, s);
  }
  return s;
}

} // namespace hydrodae::build
