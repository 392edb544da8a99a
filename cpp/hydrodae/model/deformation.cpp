#include "hydrodae/model/deformation.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

Body make_mode(const Scene& scene, std::size_t k) {
  const Mode& mode = scene.modes[k];
  const Body& carrier = *find_named(scene.bodies, mode.body);
  Body body;
  body.name = mode.body + "." + mode.name;
  body.motion = {"surge"};
  body.mass = mode.mass;
  body.center_of_gravity = carrier.center_of_gravity;
  body.hydro = carrier.hydro;
  body.initial.displacement[0] = mode.initial.amplitude;
  if (mode.initial.rate)
    body.initial.velocity = Vector3(*mode.initial.rate, 0.0, 0.0);
  body.part = DeformablePart{true, k, mode.body};
  return body;
}

/// Returns whether an attachment stays in the plane of its body.
bool is_planar(const Body& carrier, const Attachment& place) {
  const auto within = [](const Vector3& phi) { return phi[1] == 0.0; };
  const auto about_y = [](const Vector3& psi) { return psi[0] == 0.0 && psi[2] == 0.0; };
  return carrier.motion == std::vector<std::string>{"planar"} &&
         std::all_of(place.displacement.begin(), place.displacement.end(), within) &&
         std::all_of(place.rotation.begin(), place.rotation.end(), about_y);
}

Body make_attachment(const Scene& scene, std::size_t k) {
  const Attachment& place = scene.attachments[k];
  Body body;
  body.name = place.name;
  if (is_planar(*find_named(scene.bodies, place.body), place))
    body.motion = {"planar"};
  body.center_of_gravity = place.point;
  body.part = DeformablePart{false, k, place.body};
  return body;
}

/// Checks for one vector for each mode of the body.
void check_shape(const Scene& scene, const Attachment& place, const std::string& key,
                 const std::vector<Vector3>& vectors) {
  const std::size_t modes = modes_of(scene, place.body).size();
  if (vectors.size() != modes)
    refuse(Entry{"attachment", place.name}, key,
           key + " has " + std::to_string(vectors.size()) + " vectors, and body " +
               in_quotes(place.body) + " has " + std::to_string(modes) +
               (modes == 1 ? " mode" : " modes") + ": expected one vector for each mode");
}

/// Returns whether a joint, or possibly a constraint, holds a body or one of its attachments.
bool is_held(const Scene& scene, const Body& body) {
  const auto joins = [&](const std::string& name) {
    return std::any_of(scene.joints.begin(), scene.joints.end(),
                       [&](const Joint& j) { return j.body_a == name || j.body_b == name; });
  };
  return !scene.constraints.empty() || joins(body.name) ||
         std::any_of(scene.attachments.begin(), scene.attachments.end(),
                     [&](const Attachment& a) { return a.body == body.name && joins(a.name); });
}

/// Refuses mass that couples a shape with a rigid motion: it is not in the equations.
void check_participation(const Scene& scene) {
  for (const Mode& mode : scene.modes)
    for (std::size_t c = 0; c < 3; ++c)
      if (mode.participation && (*mode.participation)[static_cast<Index>(c)] != 0.0 &&
          !may_participate(scene, *find_named(scene.bodies, mode.body), c))
        refuse(Entry{"mode", mode.name}, "participation",
               "body " + in_quotes(mode.body) + " moves freely in " +
                   std::string(coordinate_names[c]) +
                   ", and a normal mode takes no part in such a motion: give zero there with the "
                   "shape of the free body, or hold the body as the program did that gave the "
                   "shape");
}

} // namespace

std::vector<std::size_t> modes_of(const Scene& scene, std::string_view body) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < scene.modes.size(); ++k)
    if (scene.modes[k].body == body)
      out.push_back(k);
  return out;
}

const Body& part_of_mode(const Scene& scene, std::size_t mode) {
  return *std::find_if(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& b) { return b.is_mode() && b.part->entry == mode; });
}

void add_parts(Scene& scene) {
  const std::vector<std::string> whole = names_of(scene.bodies);
  for (const Mode& mode : scene.modes)
    check_reference({"mode", mode.name}, "body", mode.body, whole, "body");
  for (const Attachment& place : scene.attachments) {
    const Entry entry{"attachment", place.name};
    check_reference(entry, "body", place.body, whole, "body");
    if (std::find(whole.begin(), whole.end(), place.name) != whole.end())
      refuse(entry, "name", "a body has this name too; give the attachment another one");
    check_shape(scene, place, "displacement", place.displacement);
    if (!place.rotation.empty())
      check_shape(scene, place, "rotation", place.rotation);
  }
  for (std::size_t k = 0; k < scene.modes.size(); ++k)
    scene.bodies.push_back(make_mode(scene, k));
  for (std::size_t k = 0; k < scene.attachments.size(); ++k)
    scene.bodies.push_back(make_attachment(scene, k));
}

bool may_participate(const Scene& scene, const Body& body, std::size_t c) {
  return !moving_axes(body)[c] || is_held(scene, body);
}

void check_parts(const Scene& scene) {
  check_participation(scene);
  if (!scene.hydro || !scene.database)
    return;
  for (const Mode& mode : scene.modes) {
    const Entry entry{"mode", mode.name};
    const Body& carrier = *find_named(scene.bodies, mode.body);
    if (!carrier.hydro) {
      if (mode.hydro)
        refuse(entry, "hydro",
               "body " + in_quotes(mode.body) +
                   " is dry: give it the key 'hydro', or leave this one out");
      continue;
    }
    if (scene.hydro->axes == "yaw")
      refuse(entry, "body",
             "a body with modes needs [hydro] axes = \"mean\" or \"body\": the waves on modes do "
             "not follow its yaw");
    if (!scene.waves.empty() && scene.sea.phase != "fixed")
      refuse(entry, "body",
             "a body with modes needs [sea] phase = \"fixed\": the waves on modes do not follow "
             "its place");
    if (pose_table(scene, mode.body))
      refuse(entry, "body", "a body with modes has no [[pose_table]]: its tables have no modes");
    const hydro::DatabaseBody* entry_of_body = hydro::find_body(*scene.database, *carrier.hydro);
    if (!entry_of_body)
      continue; // refused with the body
    if (std::find(entry_of_body->modes.begin(), entry_of_body->modes.end(), mode.label()) ==
        entry_of_body->modes.end())
      refuse(entry, mode.hydro ? "hydro" : "name",
             in_quotes(mode.label()) + " is no mode of " + in_quotes(*carrier.hydro) + " in " +
                 scene.database->path +
                 (entry_of_body->modes.empty() ? "; no modes of that body are in it"
                                               : suggestion(mode.label(), entry_of_body->modes)));
  }
}

std::string hydro_label(const Scene& scene, const Body& body, std::size_t c) {
  if (!body.is_mode())
    return *body.hydro + "." + std::string(coordinate_names[c]);
  return c == 0 ? *body.hydro + "." + scene.modes[body.part->entry].label() : std::string();
}

} // namespace hydrodae::model
