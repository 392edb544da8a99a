/// Parts of `examine` on the method of a run and on likely errors.

#include <algorithm>
#include <cmath>
#include <ostream>

#include "hydrodae/check/examine.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/run/simulation.h"
#include "hydrodae/sanity/sanity.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/statics/fit_at_waves.h"

namespace hydrodae::check {

namespace {

using sanity::Finding;
using system::System;

/// Offset at rest, as part of the size of the body
constexpr double seen = 0.01, large = 0.15;
constexpr double seen_turn = 0.02, large_turn = 0.2; ///< [rad]
constexpr Index most_coordinates = 600;              ///< the statics are dense

std::string rounded(double value, double digits) {
  return number_text(std::round(value * digits) / digits);
}

/// Findings on the rest of the scene in still water, compared with its reference pose.
std::vector<Finding> look_at_rest(const model::Scene& scene, const System& given) {
  std::vector<Finding> out;
  const bool wet = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                               [](const model::Body& b) { return b.hydro.has_value(); });
  const auto moves = [](const system::CouplerData& c) {
    return c.velocity_level || c.drive.rate != 0.0 || c.drive.amplitude != 0.0 ||
           !c.drive.time.empty() || c.drive.python;
  };
  const bool driven =
      std::any_of(scene.constraints.begin(), scene.constraints.end(),
                  [](const model::Constraint& c) { return c.as<model::DrivenCoordinate>(); });
  if (driven && std::any_of(given.couplers.begin(), given.couplers.end(), moves))
    return out; // a driven scene never rests
  if (!wet || given.n_u + system::Regime(given).n_lambda > most_coordinates)
    return out;
  System s = given;
  s.notes.clear();
  s.starts.clear();
  for (system::BodyData& b : s.bodies)
    b.velocity = b.angular_velocity = Vector3::Zero();
  std::string instability;
  try {
    instability = statics::move_to_equilibrium(s).instability;
  } catch (const Error& error) {
    return {{false, error.what()}};
  }
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    if (b.kind != system::BodyData::Kind::whole)
      continue;
    const Vector3 moved = b.position - b.reference;
    const Matrix3 R = rotation_matrix<double>(b.orientation);
    const double turn = std::acos(std::clamp(0.5 * (R.trace() - 1.0), -1.0, 1.0));
    const double size = std::max(b.lever, 1e-300);
    if (moved.norm() < seen * size && turn < seen_turn)
      continue;
    out.push_back({moved.norm() > large * size || turn > large_turn,
                   "at rest in still water body " + in_quotes(b.name) + " is at (" +
                       rounded(moved[0], 1e3) + ", " + rounded(moved[1], 1e3) + ", " +
                       rounded(moved[2], 1e3) + ") m and " + rounded(turn * 180.0 / pi, 1e2) +
                       " deg from its reference pose"});
  }
  for (const std::string& note : s.notes)
    out.push_back({note == instability, "at rest: " + note});
  return out;
}

} // namespace

void write_method(std::ostream& out, const model::Scene& scene) {
  if (find_method(scene.solver.method))
    return;
  try {
    model::Scene alone = scene; // without other programs
    alone.controllers.clear();
    const run::Simulation start(alone);
    const run::MethodOrder& order = start.methods().order();
    out << "  method: auto begins with " << order.methods.front() << ", as " << order.reason;
    for (std::size_t k = 1; k < order.methods.size(); ++k)
      out << (k == 1 ? "; where that cannot go on follows " : ", then ") << order.methods[k];
    out << '\n';
  } catch (const Error&) { // a run reports it
  }
}

void write_sanity(std::ostream& out, const model::Scene& scene, const System& s) {
  for (const sanity::FloatingGroup& group : sanity::floating_groups(s))
    if (group.wet)
      out << "  " << sanity::describe(s, group) << '\n';
  std::vector<Finding> findings = sanity::look_over(scene, s);
  for (const std::vector<Finding>& more : {look_at_rest(scene, s), statics::look_at_fit(scene, s)})
    findings.insert(findings.end(), more.begin(), more.end());
  for (const Finding& finding : findings)
    out << (finding.serious ? "  looks wrong: " : "  look at: ") << finding.text << '\n';
}

} // namespace hydrodae::check
