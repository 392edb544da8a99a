/// Chambers of air: each network has a port along the coordinates of its pistons.

#include <algorithm>

#include "hydrodae/air/network.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/model/check.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::build {

namespace {

int motion_of(const model::Scene& scene, const air::Piston& piston, system::System& s) {
  if (piston.joint)
    return joint_motion(s, *piston.joint, piston.coordinate);
  const std::vector<std::string> modes = model::names_of(scene.modes);
  const auto mode = std::find(modes.begin(), modes.end(), *piston.mode) - modes.begin();
  const model::Body& part = model::part_of_mode(scene, static_cast<std::size_t>(mode));
  return body_motion(scene, part.name, "surge", s);
}

} // namespace

void add_chambers(const model::Scene& scene, system::System& s) {
  const model::Environment& e = scene.environment;
  air::Atmosphere outside;
  outside.pressure = e.air_pressure.value_or(outside.pressure);
  outside.density = e.air_density.value_or(outside.density);
  for (air::Parts& parts : air::networks({outside, scene.chambers, scene.pistons, scene.outlets})) {
    system::PortData port;
    port.component = parts.chambers.front().name;
    for (const air::Piston& piston : parts.pistons) {
      port.motions.push_back(motion_of(scene, piston, s));
      const system::JointData& j = system::joint_of(s, port.motions.back());
      for (const int body : {j.A.body, j.B.body})
        if (std::find(port.bodies.begin(), port.bodies.end(), body) == port.bodies.end())
          port.bodies.push_back(body);
    }
    s.elements.push_back(
        {std::make_shared<const air::Network>(std::move(parts)), {std::move(port)}, 0});
  }
}

} // namespace hydrodae::build
