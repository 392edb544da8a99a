#include "hydrodae/model/deformation.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/mass.h"
#include "hydrodae/model/motion.h"

namespace hydrodae::model {
namespace {

/// Least eigenvalue of a mass matrix that is scaled to a unit diagonal
constexpr double least_eigenvalue = 1e-10;
/// Stiffness of the water on a mode that moves no water line, as part of that of the rigid body
constexpr double no_water_line = 1e-3;

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

/// Refuses a weight on a shape without the mass that couples it with a rigid motion.
void check_participation(const Scene& scene) {
  for (const Mode& mode : scene.modes)
    for (std::size_t c = 0; c < 3; ++c)
      if (mode.participation && (*mode.participation)[static_cast<Index>(c)] != 0.0 &&
          mode.mass_with_motions.empty() &&
          !may_participate(scene, *find_named(scene.bodies, mode.body), c))
        refuse(Entry{"mode", mode.name}, "participation",
               "body " + in_quotes(mode.body) + " moves freely in " +
                   std::string(coordinate_names[c]) +
                   ", and a normal mode takes no part in such a motion: give zero there with the "
                   "shape of the free body, hold the body as the program did that gave the "
                   "shape, or give 'mass_with_motions'");
}

/// Checks lengths and meaning of the masses that a mode shares.
void check_shared_mass(const Scene& scene, const Mode& mode) {
  const Entry entry{"mode", mode.name};
  const std::vector<std::size_t> all = modes_of(scene, mode.body);
  const auto before =
      std::count_if(all.begin(), all.end(), [&](std::size_t k) { return &scene.modes[k] < &mode; });
  const std::vector<double>&with = mode.mass_with_modes, &rigid = mode.mass_with_motions;
  if (!with.empty() && std::ssize(with) != before)
    refuse(entry, "mass_with_modes",
           "has " + std::to_string(with.size()) + (with.size() == 1 ? " mass" : " masses") +
               ", and body " + in_quotes(mode.body) + " has " + std::to_string(before) +
               " modes before this one in the case: give one mass for each of them");
  if (!rigid.empty() && rigid.size() != 6)
    refuse(entry, "mass_with_motions",
           "has " + std::to_string(rigid.size()) + " numbers: expected six, surge to yaw");
  if (with.empty() && rigid.empty())
    return;
  if (!scene.hydro || !find_named(scene.bodies, mode.body)->hydro)
    refuse(entry, with.empty() ? "mass_with_motions" : "mass_with_modes",
           "body " + in_quotes(mode.body) +
               " is dry, and shared mass is in the equations of bodies in the water: give the "
               "normal modes of the dry body, which share none");
  if (!rigid.empty() && mode.participation && *mode.participation != Vector3(rigid.data()))
    refuse(entry, "participation",
           "the first three numbers of 'mass_with_motions' are the same integral: give the same "
           "numbers, or leave one of the two out");
}

/// Refuses masses of a body and its modes that are not positive definite together.
void check_definite(const Scene& scene, const Body& body) {
  const std::vector<std::size_t> modes = modes_of(scene, body.name);
  MatrixX M = shared_mass(scene, body.name);
  if (M.isZero(0.0))
    return;
  M.topLeftCorner<3, 3>().diagonal().setConstant(body.mass.value);
  M.block<3, 3>(3, 3) = inertia_tensor(body);
  for (std::size_t k = 0; k < modes.size(); ++k)
    M(6 + static_cast<Index>(k), 6 + static_cast<Index>(k)) = scene.modes[modes[k]].mass;
  const std::array<bool, 6> moving = moving_axes(body);
  std::vector<Index> at;
  for (Index i = 0; i < M.rows(); ++i)
    if (i >= 6 || moving[static_cast<std::size_t>(i)])
      at.push_back(i);
  const MatrixX part = M(at, at);
  const VectorX size = part.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixX scaled = size.asDiagonal() * part * size.asDiagonal();
  if (symmetric_eigenvalues(scaled)[0] > least_eigenvalue)
    return;
  const Mode& last = scene.modes[modes.back()];
  refuse(Entry{"mode", last.name},
         last.mass_with_modes.empty() ? "mass_with_motions" : "mass_with_modes",
         "the masses of body " + in_quotes(body.name) +
             " and its modes are not positive definite together: no mass has these shapes; of "
             "two coordinates alone the shared mass is below the root of the product of both");
}

/// Refuses a mesh whose water line a mode moves, as its linear hydrostatics show: pressure on the
/// mesh, which is that of the rigid body, would miss it.
void check_mesh_of(const Scene& scene, const Mode& mode, const hydro::DatabaseBody& known,
                   Index k) {
  if (!known.hydrostatics)
    return;
  const Matrix6& rigid = known.hydrostatics->stiffness;
  const auto index = [&](const std::string& dof) {
    const std::vector<std::string>& all = scene.database->coordinates;
    return std::find(all.begin(), all.end(), known.name + "." + dof) - all.begin();
  };
  const MatrixX& A = scene.database->added_mass_inf;
  const Index heave = index("heave"), own = index(mode.label());
  double shape = 0.0; // size of the shape, from the water that it moves
  if (heave < A.rows() && A(heave, heave) > 0.0)
    shape = std::sqrt(std::max(A(own, own), 0.0) / A(heave, heave));
  const double scale = std::sqrt(std::max(rigid(2, 2), 0.0)) * shape;
  for (Index i = 2; i < known.mode_stiffness.rows(); ++i) {
    if (i == 5)
      continue; // yaw moves no water line
    const double other = i < 6 ? std::sqrt(std::max(rigid(i, i), 0.0)) : scale;
    const double most =
        std::max(std::abs(known.mode_stiffness(i, k)), std::abs(known.mode_stiffness(k, i)));
    if (most > no_water_line * scale * other)
      refuse(Entry{"body", mode.body}, "hydrostatics",
             "mode " + in_quotes(mode.name) +
                 " moves the water line: the database gives it a stiffness of the water of " +
                 rounded_text(most, 3) +
                 ". The mesh is that of the rigid body, so its pressures would miss this; use "
                 "hydrostatics = \"linear\", or modes whose shape is zero at the water line");
  }
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

MatrixX shared_mass(const Scene& scene, std::string_view body) {
  const std::vector<std::size_t> modes = modes_of(scene, body);
  MatrixX M = MatrixX::Zero(6 + std::ssize(modes), 6 + std::ssize(modes));
  for (Index k = 0; k < std::ssize(modes); ++k) {
    const Mode& mode = scene.modes[modes[static_cast<std::size_t>(k)]];
    const auto put = [&](const std::vector<double>& masses, Index first) {
      for (Index j = 0; j < std::ssize(masses); ++j)
        M(6 + k, first + j) = M(first + j, 6 + k) = masses[static_cast<std::size_t>(j)];
    };
    put(mode.mass_with_motions, 0);
    put(mode.mass_with_modes, 6);
  }
  return M;
}

void check_parts(const Scene& scene) {
  check_participation(scene);
  for (const Mode& mode : scene.modes)
    check_shared_mass(scene, mode);
  for (const Body& body : scene.bodies)
    check_definite(scene, body);
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
    if (pose_table(scene, mode.body))
      refuse(entry, "body", "a body with modes has no [[pose_table]]: its tables have no modes");
    const hydro::DatabaseBody* entry_of_body = hydro::find_body(*scene.database, *carrier.hydro);
    if (!entry_of_body)
      continue; // refused with the body
    const auto at =
        std::find(entry_of_body->modes.begin(), entry_of_body->modes.end(), mode.label());
    if (at == entry_of_body->modes.end())
      refuse(entry, mode.hydro ? "hydro" : "name",
             in_quotes(mode.label()) + " is no mode of " + in_quotes(*carrier.hydro) + " in " +
                 scene.database->path +
                 (entry_of_body->modes.empty() ? "; no modes of that body are in it"
                                               : suggestion(mode.label(), entry_of_body->modes)));
    if (carrier.hydrostatics_by_mesh())
      check_mesh_of(scene, mode, *entry_of_body, 6 + (at - entry_of_body->modes.begin()));
  }
}

std::string hydro_label(const Scene& scene, const Body& body, std::size_t c) {
  if (!body.is_mode())
    return *body.hydro + "." + std::string(coordinate_names[c]);
  return c == 0 ? *body.hydro + "." + scene.modes[body.part->entry].label() : std::string();
}

} // namespace hydrodae::model
