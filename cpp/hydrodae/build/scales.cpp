/// Size of one unit of tolerance for each unknown. Global coordinates do not show the size of a
/// motion, so positions are measured against a length of the body.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/parts.h"
#include "hydrodae/system/declare.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::build {

namespace {

/// Distance of the farthest joint from the centre of gravity [m]; 0: all joints are there.
double farthest_joint(const system::System& s, int body) {
  double arm = 0.0;
  for (const system::JointData& j : s.joints) {
    if (j.A.body == body)
      arm = std::max(arm, j.A.point.norm());
    if (j.B.body == body)
      arm = std::max(arm, j.B.point.norm());
  }
  return arm;
}

/// Lever of the rotations of a body [m]: radius of gyration, farthest joint, or size of the
/// displaced volume.
double lever(const system::System& s, const model::Scene& scene, int body, double farthest) {
  const system::BodyData& b = s.bodies[body];
  const double gyration = b.inertia.diagonal().maxCoeff();
  double arm = b.mass > 0.0 ? std::max(std::sqrt(gyration / b.mass), farthest) : farthest;
  const std::optional<std::string>& wet = scene.bodies[body].hydro;
  if (arm == 0.0 && wet && scene.database)
    for (const hydro::DatabaseBody& d : scene.database->bodies)
      if (d.name == *wet && d.hydrostatics)
        arm = std::cbrt(d.hydrostatics->displaced_volume);
  return arm > 0.0 ? arm : 1.0;
}

} // namespace

void set_body_scales(const model::Scene& scene, system::System& s) {
  s.scales_follow = !scene.solver.length_scale;
  for (int i = 0; i < static_cast<int>(s.bodies.size()); ++i) {
    system::BodyData& b = s.bodies[i];
    const double farthest = farthest_joint(s, i);
    b.lever = lever(s, scene, i, farthest);
    b.arm = farthest > 0.0 ? farthest : b.lever;
    b.length_scale = scene.solver.length_scale.value_or(0.1 * b.lever);
    b.time_scale_known = scene.solver.time_scale.has_value() || s.gravity > 0.0;
    b.time_scale =
        scene.solver.time_scale.value_or(s.gravity > 0.0 ? std::sqrt(b.lever / s.gravity) : 1.0);
  }
}

void set_scale_masses(system::System& s) {
  std::vector<double> largest(static_cast<std::size_t>(s.n_groups), 0.0);
  for (const system::BodyData& b : s.bodies)
    if (b.group >= 0)
      largest[static_cast<std::size_t>(b.group)] =
          std::max(largest[static_cast<std::size_t>(b.group)], b.mass);
  for (system::BodyData& b : s.bodies) {
    const double all = b.group < 0 ? 0.0 : largest[static_cast<std::size_t>(b.group)];
    b.scale_mass = b.mass > 0.0 ? b.mass : all > 0.0 ? all : 1.0;
  }
}

} // namespace hydrodae::build
