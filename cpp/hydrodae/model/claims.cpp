#include "hydrodae/model/claims.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

using enum Effect;

/// Number of pieces of an element, and of those with the centre inside the mesh of its body.
struct Pieces {
  int count = 0, inside = 0;
  bool all_inside() const { return inside == count; }
};

Pieces pieces_of(const Body& body, const water::Morison& m) {
  Pieces out{m.point ? 1 : m.segments, 0};
  if (!body.hull)
    return out;
  for (int k = 0; k < out.count; ++k) {
    const Vector3 center =
        m.point ? *m.point : *m.point_a + (k + 0.5) / out.count * (*m.point_b - *m.point_a);
    out.inside += hull::encloses(*body.hull, center - body.center_of_gravity);
  }
  return out;
}

/// Claims of database, mesh and volume of a body: effects of the mesh are not taken from the
/// database.
void claim_body(const Scene& scene, const Body& body, std::vector<Claim>& out) {
  const std::string key = "body." + body.name + ".";
  if (body.hydro) {
    std::vector<Effect> effects;
    if (!body.hydrostatics_by_mesh())
      effects.push_back(buoyancy);
    if (!pose_table(scene, body.name)) {
      if (!body.waves_by_mesh())
        effects.push_back(froude_krylov);
      effects.insert(effects.end(), {diffraction, added_mass, radiation});
    }
    out.push_back(
        {body.name, effects, key + "hydro", "the database (key 'hydro')", "leave out 'hydro'"});
  }
  if (body.hydrostatics_by_mesh())
    out.push_back({body.name,
                   {buoyancy},
                   key + "hydrostatics",
                   "its mesh (key 'hydrostatics')",
                   "use hydrostatics = \"linear\""});
  if (body.waves_by_mesh())
    out.push_back({body.name,
                   {froude_krylov},
                   key + "froude_krylov",
                   "its mesh (key 'froude_krylov')",
                   "use froude_krylov = \"linear\""});
  if (body.volume > 0.0)
    out.push_back({body.name, {buoyancy}, key + "volume", "its 'volume'", "leave out 'volume'"});
}

/// Claims of a pose table, which replaces the main database.
void claim_table(const Scene& scene, const PoseTable& table, std::vector<Claim>& out) {
  std::vector<Effect> effects = {diffraction, added_mass, radiation};
  if (!find_named(scene.bodies, table.body)->waves_by_mesh())
    effects.insert(effects.begin(), froude_krylov);
  out.push_back({table.body, effects, "pose_table." + table.name + ".body",
                 "the pose table " + in_quotes(table.name), "use one table with all poses"});
}

/// Loads of second order: a mesh in waves, and axes that the body carries, hold a part of each.
void claim_second_order(const Scene& scene, const Body& body, std::vector<Claim>& out) {
  const std::vector<Effect> all = {mean_drift, slow_drift, sum_force};
  const std::string key = "second_order.loads";
  if (body.waves_by_mesh())
    out.push_back({body.name, all, "body." + body.name + ".froude_krylov",
                   "its mesh (key 'froude_krylov')", "use froude_krylov = \"linear\"", true});
  if (scene.hydro && scene.hydro->axes_kind() == water::HydroAxes::body)
    out.push_back({body.name, all, "hydro.axes", "axes = \"body\"", "use axes = \"mean\"", true});
  std::vector<Effect> own;
  if (scene.second_order->has("sum"))
    own.push_back(sum_force);
  if (scene.second_order->loads != std::vector<std::string>{"sum"})
    own.push_back(mean_drift);
  if (scene.second_order->has("newman") || scene.second_order->has("difference"))
    own.push_back(slow_drift);
  out.push_back({body.name, own, key, "the tables of [second_order]",
                 body.waves_by_mesh()
                     ? "use froude_krylov = \"linear\", or leave out [second_order]"
                     : "use axes = \"mean\", or leave out [second_order]"});
}

/// An element that is half inside a mesh with the load of the undisturbed waves has it twice there.
/// Whether the panels of a database left the element out, no one here knows: a note names it.
void claim_inertia(const Scene& scene, const water::Morison& m, std::vector<Claim>& out) {
  const Body& body = *find_named(scene.bodies, m.body);
  if (!body.waves_by_mesh() || !m.added_mass_coefficient)
    return;
  const Pieces pieces = pieces_of(body, m);
  if (pieces.inside > 0 && !pieces.all_inside())
    out.push_back({m.body,
                   {froude_krylov},
                   "morison." + m.name,
                   "morison " + in_quotes(m.name) + " (" + std::to_string(pieces.inside) +
                       " of its " + std::to_string(pieces.count) + " pieces lie inside the mesh)",
                   "end the member at the hull, or make it two elements",
                   true});
}

} // namespace

std::string_view name_of(Effect effect) {
  switch (effect) {
  case buoyancy:
    return "buoyancy";
  case froude_krylov:
    return "Froude-Krylov load";
  case diffraction:
    return "diffraction";
  case added_mass:
    return "added mass";
  case radiation:
    return "radiation damping";
  case mean_drift:
    return "mean drift";
  case slow_drift:
    return "slow drift";
  case sum_force:
    return "sum force";
  }
  return "";
}

std::vector<Claim> claims(const Scene& scene) {
  std::vector<Claim> out;
  for (const Body& body : scene.bodies)
    claim_body(scene, body, out);
  for (const PoseTable& table : scene.pose_tables)
    claim_table(scene, table, out);
  for (const water::Morison& m : scene.morison)
    claim_inertia(scene, m, out);
  for (const Body& body : scene.bodies)
    if (scene.second_order && body.hydro && !body.part)
      claim_second_order(scene, body, out);
  return out;
}

bool leaves_waves_to_mesh(const Body& body, const water::Morison& m) {
  return body.waves_by_mesh() && m.added_mass_coefficient && pieces_of(body, m).all_inside();
}

void check_claims(const Scene& scene) {
  const std::vector<Claim> all = claims(scene);
  for (auto second = all.begin(); second != all.end(); ++second)
    for (auto first = all.begin(); first != second; ++first) {
      if (first->body != second->body || (first->part && second->part))
        continue;
      std::vector<std::string> twice;
      for (const Effect effect : second->effects)
        if (std::find(first->effects.begin(), first->effects.end(), effect) != first->effects.end())
          twice.emplace_back(name_of(effect));
      if (!twice.empty())
        throw ModelError(second->key, joined(twice, " and ") + " of body " +
                                          in_quotes(second->body) + " would count twice, by " +
                                          first->by + " and by " + second->by + "; " +
                                          second->instead);
    }
}

} // namespace hydrodae::model
