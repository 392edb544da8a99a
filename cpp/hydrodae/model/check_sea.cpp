#include <algorithm>

#include "hydrodae/model/check.h"

namespace hydrodae::model {
void check_sea(const Scene& scene) {
  for (const sea::Wave& wave : scene.waves)
    check_own({"wave", wave->name}, wave, scene.solver.end_time);
  const bool slender =
      !scene.morison.empty() || !std::get<std::vector<line::Line>>(scene.forces).empty();
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
  if (!scene.sea.current.isZero(0.0) && !slender)
    throw ModelError("sea.current",
                     "a current acts on [[morison]] elements, and the case has no such element");
  if (scene.sea.ramp > 0.0 && scene.waves.empty())
    throw ModelError("sea.ramp", "there is no [[wave]] to ramp up");
}

} // namespace hydrodae::model
