#include "hydrodae/core/text.h"
#include "hydrodae/line/catenary_line.h"
#include "hydrodae/line/line.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

using water::Morison;

/// Refuses keys of the other shape of element.
void refuse_keys(const Scene& scene, const Entry& entry, const std::string& shape,
                 const std::vector<std::string>& keys) {
  for (const std::string& key : keys)
    if (scene.places.contains("morison." + entry.name + "." + key))
      refuse(entry, key, "a " + shape + " element has no " + in_quotes(key));
}

void check_shape(const Scene& scene, const Morison& m) {
  const Entry entry{"morison", m.name};
  if (m.point) {
    refuse_keys(scene, entry, "point",
                {"point_a", "point_b", "drag_axial", "added_mass_axial", "segments"});
    if (m.diameter && (m.area || m.volume))
      refuse(entry, m.area ? "area" : "volume", "the diameter gives area and volume already");
    if (m.drag_coefficient > 0.0 && !m.diameter && !m.area)
      refuse(entry, "", "a point element with drag needs 'diameter' or 'area'");
    if (m.added_mass_coefficient && !m.diameter && !m.volume)
      refuse(entry, "", "a point element with inertia needs 'diameter' or 'volume'");
    return;
  }
  if (!m.point_a || !m.point_b)
    refuse(entry, "", "give 'point', or 'point_a' and 'point_b' of a member");
  refuse_keys(scene, entry, "member", {"area", "volume"});
  if (!m.diameter)
    refuse(entry, "", "a member needs its 'diameter' [m]");
  if (coincide(*m.point_a, *m.point_b))
    refuse(entry, "point_b", "point_a and point_b coincide: the member has no axis");
}

} // namespace

void check_morison(const Scene& scene) {
  const std::vector<std::string> forces = force_names(scene);
  for (const Morison& m : scene.morison) {
    const Entry entry{"morison", m.name};
    check_reference(entry, "body", m.body, names_of_bodies(scene), "body");
    check_shape(scene, m);
    for (const std::string& force : forces)
      if (force == m.name)
        refuse(entry, "name", "a [[force]] has this name too");
    if (m.drag_coefficient == 0.0 && m.drag_axial == 0.0 && !m.has_inertia())
      refuse(entry, "",
             "it has neither drag nor inertia: give drag_coefficient, drag_axial, "
             "added_mass_coefficient or added_mass_axial");
  }
  const Environment& e = scene.environment;
  if (scene.hydro && (e.water_density || e.water_depth))
    throw ModelError(e.water_density ? "environment.water_density" : "environment.water_depth",
                     "the hydrodynamic database gives density and depth of the water");
  const bool felt = !scene.morison.empty() || !forces_of<line::Line>(scene).empty() ||
                    !forces_of<line::CatenaryLine>(scene).empty() ||
                    std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                [](const Body& body) { return body.volume > 0.0 || body.mesh; });
  if (!scene.hydro && !felt && (e.water_density || e.water_depth))
    throw ModelError(e.water_density ? "environment.water_density" : "environment.water_depth",
                     "nothing in the scene feels the water");
  if (!scene.hydro && !scene.morison.empty() && !e.water_density)
    throw ModelError("morison." + scene.morison.front().name,
                     "Morison elements need the density of the water: water_density [kg/m3] in "
                     "[environment], or a hydrodynamic database");
}

} // namespace hydrodae::model
