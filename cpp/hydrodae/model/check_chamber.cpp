#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/deformation.h"

namespace hydrodae::model {
namespace {

/// Vapour pressure of water at 17.5 C [Pa]: below it the sea boils. Values in bar, kPa and hPa are
/// below it, too.
constexpr double boils = 2000.0;

/// Largest relative difference between the stiffness of the water and rho g times the area of its
/// piston.
constexpr double same_area = 0.02;

void check_air(const Scene& scene) {
  const Environment& e = scene.environment;
  if (scene.chambers.empty() && (e.air_pressure || e.air_density))
    throw ModelError(e.air_pressure ? "environment.air_pressure" : "environment.air_density",
                     "nothing in the scene feels the air: there is no [[chamber]]");
  if (e.air_pressure && *e.air_pressure < boils)
    throw ModelError("environment.air_pressure",
                     "air_pressure = " + number_text(*e.air_pressure) +
                         " Pa is below the pressure at which water boils: give the absolute "
                         "pressure of the atmosphere in Pa, such as 101325");
}

void check_chamber(const Scene& scene, const air::Chamber& chamber) {
  const Entry entry{"chamber", chamber.name};
  const double outside = scene.environment.air_pressure.value_or(air::Atmosphere().pressure);
  if (!(chamber.pressure > -outside))
    refuse(entry, "pressure",
           "is a gauge pressure, and must be above minus that of the atmosphere");
  std::vector<std::string> taken = force_names(scene);
  append_names(scene.morison, taken);
  if (std::find(taken.begin(), taken.end(), chamber.name) != taken.end())
    refuse(entry, "name", "a [[force]] or [[morison]] has this name too");
  const bool pressed = std::any_of(scene.pistons.begin(), scene.pistons.end(),
                                   [&](const auto& p) { return p.chamber == chamber.name; });
  const bool opened = std::any_of(scene.outlets.begin(), scene.outlets.end(), [&](const auto& o) {
    return o->chamber == chamber.name || o->to == chamber.name;
  });
  if (!pressed && !opened)
    refuse(entry, "",
           "has neither pistons nor outlets: give a [[piston]] or an [[outlet]] with chamber = " +
               in_quotes(chamber.name));
}

/// Stiffness of the water along a mode, by the database.
std::optional<WaterOfPiston> water_of_mode(const Scene& scene, const Mode& mode) {
  const Body* body = find_named(scene.bodies, mode.body);
  const hydro::DatabaseBody* known =
      body && body->hydro ? hydro::find_body(*scene.database, *body->hydro) : nullptr;
  if (!known)
    return {}; // dry, or refused with the body
  const auto at = std::find(known->modes.begin(), known->modes.end(), mode.label());
  if (at == known->modes.end())
    return {}; // refused with the mode
  const Index k = 6 + (at - known->modes.begin());
  return WaterOfPiston{"mode " + in_quotes(mode.name), known->mode_stiffness(k, k)};
}

/// Heave stiffness of the water column that a joint moves. The area of a float is not that of its
/// pump, so hulls are not judged.
std::optional<WaterOfPiston> water_of_joint(const Scene& scene, const Joint& joint) {
  for (const std::string& name : {joint.body_b, joint.body_a}) {
    const Body* body = find_named(scene.bodies, name);
    const hydro::DatabaseBody* known =
        body && body->hydro ? hydro::find_body(*scene.database, *body->hydro) : nullptr;
    if (known && known->column && known->hydrostatics)
      return WaterOfPiston{"body " + in_quotes(name), known->hydrostatics->stiffness(2, 2)};
  }
  return {};
}

/// Checks the area of a piston against the stiffness of its water, rho g S without the air.
void check_area(const Scene& scene, const Entry& entry, const air::Piston& piston) {
  const std::optional<WaterOfPiston> water = water_of_piston(scene, piston);
  if (!water)
    return;
  const double weight = scene.database->rho * scene.database->gravity,
               piston_has = weight * piston.area;
  if (std::abs(water->stiffness - piston_has) > same_area * piston_has)
    refuse(
        entry, "area",
        "the database gives " + water->name + " the stiffness " +
            rounded_text(water->stiffness, 4) + " N/m, that of " +
            rounded_text(water->stiffness / weight, 4) +
            " m2 of water, and a piston of this area has rho g S = " + rounded_text(piston_has, 4) +
            " N/m: correct the area, " + (piston.mode ? "scale the mode to a rise of 1 m, " : "") +
            "or take the stiffness of the air out of the database");
}

void check_piston(const Scene& scene, const air::Piston& piston) {
  const Entry entry{"piston", piston.name};
  check_reference(entry, "chamber", piston.chamber, names_of(scene.chambers), "chamber");
  if (piston.joint.has_value() == piston.mode.has_value())
    refuse(entry, piston.mode ? "mode" : "", "needs either 'joint' or 'mode'");
  if (piston.joint) {
    const bool angle = check_motion(scene, entry, *piston.joint, piston.coordinate);
    if (angle && piston.roof)
      refuse(entry, "roof", "is a height in m, and the coordinate is an angle");
    check_area(scene, entry, piston);
    return;
  }
  if (piston.coordinate)
    refuse(entry, "coordinate", "a mode has one coordinate only: leave this key out");
  check_reference(entry, "mode", *piston.mode, names_of(scene.modes), "mode");
  for (const air::Piston& other : scene.pistons)
    if (&other != &piston && other.mode == piston.mode)
      refuse(entry, "mode", "piston " + in_quotes(other.name) + " has this mode already");
  check_area(scene, entry, piston);
}

void check_outlet(const Scene& scene, const air::AnyOutlet& outlet) {
  const Entry entry{"outlet", outlet->name};
  const std::vector<std::string> chambers = names_of(scene.chambers);
  check_reference(entry, "chamber", outlet->chamber, chambers, "chamber");
  check_own(entry, outlet);
  if (!outlet->to)
    return;
  check_reference(entry, "to", *outlet->to, chambers, "chamber");
  if (*outlet->to == outlet->chamber)
    refuse(entry, "to", "leads back to its own chamber");
  if (find_named(scene.chambers, outlet->chamber)->exponent !=
      find_named(scene.chambers, *outlet->to)->exponent)
    refuse(entry, "to", "joins chambers of different 'exponent', between which the same air flows");
}

} // namespace

std::optional<WaterOfPiston> water_of_piston(const Scene& scene, const air::Piston& piston) {
  if (!scene.database)
    return {};
  return piston.mode ? water_of_mode(scene, *find_named(scene.modes, *piston.mode))
                     : water_of_joint(scene, *find_named(scene.joints, *piston.joint));
}

void check_chambers(const Scene& scene) {
  check_air(scene);
  for (const air::Chamber& chamber : scene.chambers)
    check_chamber(scene, chamber);
  for (const air::Piston& piston : scene.pistons)
    check_piston(scene, piston);
  for (const air::AnyOutlet& outlet : scene.outlets)
    check_outlet(scene, outlet);
}

} // namespace hydrodae::model
