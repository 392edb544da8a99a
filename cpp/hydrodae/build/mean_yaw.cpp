/// Mean yaw of hydrodynamic bodies: added mass, radiation, excitation and hydrostatics belong to
/// the pose of the database turned by it. See docs/axes.md.

#include <algorithm>
#include <cmath>

#include "hydrodae/build/parts.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/rotation.h"

namespace hydrodae::build {

namespace {

constexpr double rounding = 1e-9; ///< [rad]
/// Largest difference of yaws within one device [rad]
constexpr double together = 5.0 * pi / 180.0;

/// Yaw of a body at its start [rad]: rotation about z that remains without the shortest rotation
/// that sets its z axis upright. It is zero for any pitch or roll below 180 degrees. Yaw axes use
/// the angle of the body's x axis seen from above.
double start_yaw(system::HydroAxes axes, const system::BodyData& body) {
  if (axes == system::HydroAxes::yaw) {
    const Vector3 ahead = rotation_matrix<double>(body.orientation).col(0);
    return std::atan2(ahead[1], ahead[0]);
  }
  const double sign = body.orientation[0] < 0.0 ? -1.0 : 1.0;
  return 2.0 * std::atan2(sign * body.orientation[3], sign * body.orientation[0]);
}

} // namespace

bool take_mean_yaw(const model::Scene& scene, system::System& s) {
  bool changed = false;
  for (system::HydroBody& hb : s.hydro.bodies) {
    const double yaw = start_yaw(s.hydro.axes, s.bodies[static_cast<std::size_t>(hb.body)]);
    if (std::abs(std::remainder(yaw - hb.yaw, 2.0 * pi)) <= rounding)
      continue;
    changed = true;
    hb.yaw = std::abs(yaw) > rounding ? yaw : 0.0;
    hb.cos_yaw = std::cos(hb.yaw);
    hb.sin_yaw = std::sin(hb.yaw);
    hb.turned = hb.yaw != 0.0;
    if (hb.turned && (hb.moving[0] >= 0) != (hb.moving[1] >= 0))
      throw ModelError("body." + s.bodies[static_cast<std::size_t>(hb.body)].name + ".motion",
                       "body " + in_quotes(s.bodies[static_cast<std::size_t>(hb.body)].name) +
                           " starts turned by " + number_text(hb.yaw * 180.0 / pi) +
                           " deg of yaw, and moves along surge or sway alone: surge and sway are "
                           "along world axes, and the axes of its hydrodynamics are turned; free "
                           "both, or hold one by a joint");
  }
  // loads in yaw axes follow the yaw themselves
  if (changed && s.hydro.axes != system::HydroAxes::yaw) {
    set_hydrostatics(scene, s);
    set_mode_loads(scene, s);
  }
  return changed;
}

void note_axes(const model::Scene& scene, system::System& s) {
  const std::vector<system::HydroBody>& bodies = s.hydro.bodies;
  for (const system::HydroBody& hb : bodies)
    if (std::abs(std::remainder(hb.yaw - bodies.front().yaw, 2.0 * pi)) > together) {
      s.notes.push_back(
          "the yaws of bodies " + in_quotes(s.bodies[static_cast<std::size_t>(hb.body)].name) +
          " and " + in_quotes(s.bodies[static_cast<std::size_t>(bodies.front().body)].name) +
          " differ by " +
          number_text(std::round(1800.0 / pi * (hb.yaw - bodies.front().yaw)) / 10.0) +
          " deg: what the database says of the waves between them was computed for bodies that "
          "stand as they do there");
      break;
    }
  if (s.hydro.axes == system::HydroAxes::body && s.hydro.n_moving > 0 && !scene.waves.empty())
    s.notes.push_back(
        "axes = \"body\" in waves is incomplete at second order (docs/axes.md): do not trust "
        "drift, or motion that grows by itself; compare with axes = \"mean\"");
}

} // namespace hydrodae::build
