#include "hydrodae/session/linear_limits.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/text.h"
#include "hydrodae/model/waves.h"

namespace hydrodae::session {

namespace {

/// Mean wave length [m]: sum a^2 L / sum a^2 over the wave components, L = 2 pi / k.
double wave_length(const model::Scene& scene) {
  double energy = 0.0, sum = 0.0;
  for (const sea::Component& c : model::wave_components(scene)) {
    energy += c.amplitude * c.amplitude;
    sum += c.amplitude * c.amplitude * 2.0 * pi / c.wavenumber;
  }
  return energy > 0.0 ? sum / energy : INFINITY;
}

void take(std::optional<Crossing>& crossing, double t, double value, double limit) {
  if (!crossing && value > limit)
    crossing = Crossing{t, value, value};
  if (crossing)
    crossing->largest = std::max(crossing->largest, value);
}

/// Text "15.3 deg", "0.72 m", with two more digits than matter.
std::string rounded(double value, const std::string& unit) {
  const double step = value >= 100.0 ? 1.0 : value >= 1.0 ? 0.1 : 0.001;
  return number_text(std::round(value / step) * step) + " " + unit;
}

std::string sentence(const std::string& body, const std::string& what, const Crossing& c,
                     double factor, const std::string& unit, const std::string& limit) {
  return "beyond linear theory: body " + in_quotes(body) + " " + what + " by " +
         rounded(factor * c.value, unit) + " at t = " + rounded(c.time, "s") + ", at most " +
         rounded(factor * c.largest, unit) + " (limit " + limit + ")";
}

/// Draught V / A_w of a wall-sided body [m], with the waterplane A_w = C_33 / (rho g); for a small
/// waterplane (spars, submerged bodies) the cube root of V.
double draught(const hydro::Database& database, const hydro::Hydrostatics& h) {
  const double plane = h.stiffness(2, 2) / (database.rho * database.gravity);
  const double cube = std::cbrt(h.displaced_volume);
  return plane > 0.0 ? std::min(h.displaced_volume / plane, cube) : cube;
}

} // namespace

LinearLimits linear_limits(const model::Scene& scene, const system::System& s) {
  LinearLimits out;
  for (const model::Mode& mode : scene.modes) {
    if (mode.stiffness == 0.0)
      continue;
    const auto body = std::find_if(s.bodies.begin(), s.bodies.end(),
                                   [&](const system::BodyData& b) { return b.name == mode.body; });
    out.modes.push_back({static_cast<int>(body - s.bodies.begin()),
                         in_quotes(mode.body) + ", mode " + mode.name,
                         std::sqrt(LinearLimits::softening * mode.stiffness / mode.mass)});
    out.state.spins.emplace_back();
  }
  if (!scene.hydro || !scene.database)
    return out;
  if (scene.sea.phase == "fixed" && !scene.waves.empty())
    out.tenth_wave = 0.1 * wave_length(scene);
  for (const system::HydroBody& hb : s.hydro.bodies) {
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(hb.body)];
    if (!hb.moves || b.is_mode())
      continue;
    LinearLimits::Body watched;
    watched.body = hb.body;
    watched.name = b.name;
    watched.mean = rotation_about_axis<double>(2, hb.yaw);
    watched.place << b.position[0], b.position[1], b.reference[2];
    watched.free_yaw = s.hydro.axes == system::HydroAxes::yaw;
    const model::Body& body = scene.bodies[static_cast<std::size_t>(hb.body)];
    const bool follows_rise =
        body.hydrostatics_by_mesh() && hb.table >= 0 &&
        s.hydro.added_mass.tables[static_cast<std::size_t>(hb.table)].axis.component == 2;
    for (const hydro::DatabaseBody& entry : scene.database->bodies)
      if (entry.name == *body.hydro && !follows_rise && entry.hydrostatics &&
          entry.hydrostatics->displaced_volume > 0.0)
        watched.half_draught = 0.5 * draught(*scene.database, *entry.hydrostatics);
    out.bodies.push_back(watched);
    out.state.bodies.emplace_back();
  }
  return out;
}

void watch(LinearLimits& limits, double t, const std::vector<system::BodyState<double>>& states) {
  for (std::size_t k = 0; k < limits.bodies.size(); ++k) {
    const LinearLimits::Body& b = limits.bodies[k];
    LinearLimits::OfBody& found = limits.state.bodies[k];
    const system::BodyState<double>& state = states[static_cast<std::size_t>(b.body)];
    // Cosine of the total rotation from the mean pose, or of the tilt of the z axis.
    const double cosine =
        b.free_yaw ? state.R(2, 2) : 0.5 * (b.mean.cwiseProduct(state.R).sum() - 1.0);
    take(found.turn, t, std::acos(std::clamp(cosine, -1.0, 1.0)), LinearLimits::largest_turn);
    const Vector3 moved = state.r - b.place;
    take(found.rise, t, std::abs(moved[2]), b.half_draught);
    take(found.drift, t, moved.head<2>().norm(), limits.tenth_wave);
  }
  for (std::size_t k = 0; k < limits.modes.size(); ++k) {
    const LinearLimits::Mode& m = limits.modes[k];
    take(limits.state.spins[k], t, states[static_cast<std::size_t>(m.body)].w.norm(),
         m.largest_rate);
  }
}

std::vector<std::string> notes(const LinearLimits& limits) {
  std::vector<std::string> out;
  constexpr double degrees = 180.0 / pi;
  for (std::size_t k = 0; k < limits.bodies.size(); ++k) {
    const LinearLimits::Body& b = limits.bodies[k];
    const LinearLimits::OfBody& found = limits.state.bodies[k];
    if (found.turn)
      out.push_back(sentence(b.name, "turns", *found.turn, degrees, "deg", "15 deg"));
    if (found.rise)
      out.push_back(sentence(b.name, "rises or sinks", *found.rise, 1.0, "m",
                             "half the draught, taken as the cube root of the displaced volume: " +
                                 rounded(b.half_draught, "m")));
    if (found.drift)
      out.push_back(sentence(b.name, "moves off its place in the waves", *found.drift, 1.0, "m",
                             "a tenth of the wave length: " + rounded(limits.tenth_wave, "m")));
  }
  for (std::size_t k = 0; k < limits.modes.size(); ++k) {
    const LinearLimits::Mode& m = limits.modes[k];
    if (const std::optional<Crossing>& spin = limits.state.spins[k])
      out.push_back("body " + m.name + ": turns at " + rounded(spin->value, "rad/s") + " at t = " +
                    rounded(spin->time, "s") + ", at most " + rounded(spin->largest, "rad/s") +
                    "; beyond " + rounded(m.largest_rate, "rad/s") +
                    " the centrifugal loads that it lacks are more than 1 % of its stiffness");
  }
  return out;
}

} // namespace hydrodae::session
