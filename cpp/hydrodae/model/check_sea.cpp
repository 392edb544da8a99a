#include <algorithm>

#include "hydrodae/model/check.h"

#include "hydrodae/core/text.h"
#include "hydrodae/line/line.h"

namespace hydrodae::model {
namespace {

/// Refuses rows of the current that are not heights beneath the surface, downwards.
void check_profile(const Scene& scene) {
  const std::string key = "sea.current_profile";
  const std::vector<Vector3>& rows = scene.sea.current_profile;
  if (!rows.empty() && !scene.sea.current.isZero(0.0))
    throw ModelError(key, "give either 'current' or 'current_profile'");
  const double depth = water(scene).depth;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double z = rows[i][0];
    if (z > 0.0 || z < -depth)
      throw ModelError(key, "z = " + number_text(z) + " m: expected 0 at the surface to -" +
                                number_text(depth) + " m at the bed");
    if (i > 0 && !(z < rows[i - 1][0]))
      throw ModelError(key, "z must fall from row to row: " + number_text(rows[i - 1][0]) +
                                " m, then " + number_text(z) + " m");
    if (rows[i][1] < 0.0)
      throw ModelError(key, "speed = " + number_text(rows[i][1]) +
                                " m/s: expected >= 0; turn the heading by 180 deg");
  }
}

/// Refuses second order where nothing feels it, and its keys without it.
void check_wave_order(const Scene& scene, bool slender) {
  const sea::Sea& sea = scene.sea;
  if (sea.order == 1) {
    if (sea.second_order_limit)
      throw ModelError("sea.second_order_limit", "this acts with order = 2 alone");
    if (sea.second_order_terms != sea::Sea().second_order_terms)
      throw ModelError("sea.second_order_terms", "this acts with order = 2 alone");
    return;
  }
  if (scene.waves.empty())
    throw ModelError("sea.order", "there is no [[wave]] that could have bound waves");
  if (!slender && scene.gauges.empty())
    throw ModelError("sea.order", "order = 2 acts on [[gauge]], [[morison]] and lines: add one of "
                                  "them, or leave order = 1");
}

} // namespace

void check_sea(const Scene& scene) {
  for (const sea::Wave& wave : scene.waves)
    check_own({"wave", wave->name}, wave, scene.solver.end_time);
  const bool slender = !scene.morison.empty() || !forces_of<line::Line>(scene).empty();
  const bool meshed = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                  [](const Body& body) { return body.waves_by_mesh(); });
  if (!scene.waves.empty() && !scene.hydro && !slender && !meshed)
    throw ModelError("wave." + scene.waves.front()->name,
                     "waves need a hydrodynamic database, Morison elements, lines or a body with "
                     "froude_krylov = \"mesh\" to act on: the table [hydro] is missing");
  if (!meshed && (scene.sea.bernoulli || scene.sea.stretching != "vertical"))
    throw ModelError(
        scene.sea.bernoulli ? "sea.bernoulli" : "sea.stretching",
        "this acts on bodies with froude_krylov = \"mesh\", and the case has no such body");
  if (scene.sea.phase == "moving" && (scene.waves.empty() || !scene.hydro))
    throw ModelError("sea.phase", "phase = \"moving\" is about waves on bodies of the hydrodynamic "
                                  "database, and the case lacks waves or database");
  const bool profiled = !scene.sea.current_profile.empty();
  if ((!scene.sea.current.isZero(0.0) || profiled) && !slender)
    throw ModelError(
        profiled ? "sea.current_profile" : "sea.current",
        "a current acts on [[morison]] elements and lines, and the case has no such element");
  check_profile(scene);
  check_wave_order(scene, slender);
  if (scene.sea.ramp > 0.0 && scene.waves.empty())
    throw ModelError("sea.ramp", "there is no [[wave]] to ramp up");
}

} // namespace hydrodae::model
