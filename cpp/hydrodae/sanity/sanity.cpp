/// Findings on places and coordinates of the mechanism and lengths of ropes; all findings together.

#include "hydrodae/sanity/sanity.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "hydrodae/build/assemble.h"
#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/line/catenary_line.h"
#include "hydrodae/line/line.h"
#include "hydrodae/line/rope.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::sanity {

namespace {

constexpr double far = 3.0, very_far = 10.0; ///< distance of a joint, in sizes of the body

/// Largest radius of gyration about the rotation axes of a body [m]; about all for a fixed body.
double gyration(const system::BodyData& b) {
  double largest = 0.0;
  for (int k = b.n_translations; k < b.n_active; ++k) {
    const int axis = b.active[static_cast<std::size_t>(k)] - 3;
    largest = std::max(largest, b.inertia(axis, axis));
  }
  if (b.n_active == b.n_translations)
    largest = b.inertia.diagonal().maxCoeff();
  return b.mass > 0.0 ? std::sqrt(largest / b.mass) : 0.0;
}

/// Size of a body [m]: side of a cube of its displaced or mesh volume, or radius of gyration if
/// larger; for dry bodies at least the extent of the scene. 0: unknown.
double size_of(const model::Scene& scene, const system::System& s, std::size_t i) {
  const system::BodyData& b = s.bodies[i];
  const double size = gyration(b);
  if (const std::optional<std::string>& name = scene.bodies[i].hydro; name && scene.database) {
    const hydro::DatabaseBody* wet = hydro::find_body(*scene.database, *name);
    if (wet && wet->hydrostatics)
      return std::max(size, std::cbrt(wet->hydrostatics->displaced_volume));
  }
  if (scene.bodies[i].hull)
    return std::max(size, std::cbrt(scene.bodies[i].hull->volume));
  double extent = 0.0;
  for (const system::BodyData& other : s.bodies)
    extent = std::max(extent, (other.reference - b.reference).norm());
  return extent > 0.0 ? std::max(size, extent) : 0.0;
}

/// Distance of a marker from the centre of gravity of its body; for a sliding joint, distance of
/// its axis.
double distance(const system::JointData& j, const joint::Marker& marker) {
  const auto slides = [&](int axis) {
    return std::any_of(j.type->motions.begin(), j.type->motions.end(),
                       [&](const joint::FreeMotion& m) {
                         return m.kind == joint::FreeMotion::Kind::slides && m.axis == axis;
                       });
  };
  Vector3 away = marker.point;
  if (slides(joint::X) && slides(joint::Y)) // a point anywhere in the plane
    away = marker.axes.col(joint::Z) * marker.axes.col(joint::Z).dot(away);
  else if (slides(joint::Z))
    away -= marker.axes.col(joint::Z) * marker.axes.col(joint::Z).dot(away);
  return away.norm();
}

void judge_joints(const model::Scene& scene, const system::System& s, std::vector<Finding>& out) {
  for (const system::JointData& j : s.joints) {
    if (j.hidden || j.A.path)
      continue;
    for (const joint::Marker* marker : {&j.A, &j.B}) {
      if (marker->body < 0)
        continue;
      const auto body = static_cast<std::size_t>(marker->body);
      const double size = size_of(scene, s, body), away = distance(j, *marker);
      if (size > 0.0 && away > far * size)
        out.push_back({scene.bodies[body].hydro && away > very_far * size,
                       "joint " + in_quotes(j.name) + " is " + rounded_text(away, 3) +
                           " m from the centre of gravity of body " +
                           in_quotes(s.bodies[body].name) + ", " + rounded_text(away / size, 3) +
                           " times the size of that body (" + rounded_text(size, 3) +
                           " m); points are in world axes, in the reference pose"});
    }
  }
}

void judge_depth(const model::Scene& scene, std::vector<Finding>& out) {
  const double depth = model::water(scene).depth;
  const auto judge = [&](const std::string& what, double z) {
    if (z < -depth)
      out.push_back({true, what + " is at z = " + rounded_text(z, 3) + " m, below the sea bed at " +
                               rounded_text(-depth, 3) + " m"});
  };
  if (!std::isfinite(depth))
    return;
  for (const model::Body& body : scene.bodies)
    judge("the centre of gravity of body " + in_quotes(body.name), body.center_of_gravity[2]);
  for (const model::Joint& joint : scene.joints)
    if (joint.path.empty() && joint.point[2] < 0.0)
      judge("the point of joint " + in_quotes(joint.name), joint.point[2] + 1e-9 * depth);
}

/// Rate of a motion at velocities u (n_u,), and the largest rate for velocities of that size.
std::pair<double, double> motion_rate(const system::System& s, const system::Workspace<double>& ws,
                                      int motion, const VectorX& u) {
  const system::JointData& j = system::joint_of(s, motion);
  const joint::Vector12 gradient = system::motion_row<double>(s, ws, motion).gradient;
  double rate = 0.0, most = 0.0;
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
    for (int k = 0; k < b.n_active; ++k) {
      const double part =
          gradient[6 * side + b.active[static_cast<std::size_t>(k)]] * u[b.u0 - s.u0 + k];
      rate += part;
      most += std::abs(part);
    }
  }
  return {rate, most};
}

/// Random velocities that the constraints allow, including those that a drive moves: a random
/// vector without its part in the constraint rows, in units of the scales.
VectorX allowed_velocities(const system::Regime& s, const VectorX& y, std::mt19937& random) {
  VectorX u(s.n_u);
  for (Index k = 0; k < s.n_u; ++k)
    u[k] = 2.0 * (random() / 4294967296.0) - 1.0;
  if (s.n_lambda == 0)
    return u;
  VectorX acts = VectorX::Ones(s.n_lambda);
  for (const system::CouplerData& c : s.couplers) {
    const bool steady =
        c.drive.rate == 0.0 && c.drive.amplitude == 0.0 && c.drive.time.empty() && !c.drive.python;
    if (s.holds(c) && !steady)
      acts[s.lambda(c) - s.lambda0] = 0.0;
  }
  build::SparseMatrix rows = acts.asDiagonal() * build::constraint_gradient(s, y);
  rows.prune(0.0);
  for (int pass = 0; pass < 2; ++pass) // the second pass removes rounding errors of the first
    u -= build::smallest_solution(rows, rows * u);
  return u;
}

/// Pose near the start that keeps the constraints, to distinguish a lock from a dead point.
VectorX pose_beside(const system::Regime& s, std::mt19937& random) {
  const VectorX start = system::initial_state(s), scale = build::displacement_scale(s);
  VectorX y = start, step(s.n_u);
  for (Index k = 0; k < s.n_u; ++k)
    step[k] = 0.5 * (2.0 * (random() / 4294967296.0) - 1.0) * scale[k];
  retract(s, step, y);
  return build::close(s, y) ? y : start;
}

/// Judges forces along motions that are locked at the start and near it.
void judge_forces(const system::Regime& s, std::vector<Finding>& out) {
  std::vector<const system::PortData*> ports;
  system::for_each_law(s,
                       [&](const system::ElementList&, std::size_t, const system::PortData& port) {
                         if (port.motion >= 0)
                           ports.push_back(&port);
                       });
  if (ports.empty())
    return;
  std::mt19937 random(5);
  const VectorX scale = build::displacement_scale(s), rest = VectorX::Zero(s.n);
  std::vector<bool> moves(ports.size(), false);
  for (const VectorX& y : {VectorX(system::initial_state(s)), pose_beside(s, random)}) {
    const VectorX u = allowed_velocities(s, y, random);
    system::Workspace<double> ws(s);
    system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
    // The rates for one unit of the scales show which ones count.
    for (std::size_t k = 0; k < ports.size(); ++k) {
      const double rate = motion_rate(s, ws, ports[k]->motion, u.cwiseProduct(scale)).first;
      const double most = motion_rate(s, ws, ports[k]->motion, scale).second;
      moves[k] = moves[k] || std::abs(rate) > 1e-7 * most;
    }
  }
  for (std::size_t k = 0; k < ports.size(); ++k) {
    if (moves[k])
      continue;
    const system::MotionData& motion = s.motions[static_cast<std::size_t>(ports[k]->motion)];
    const system::JointData& j = s.joints[static_cast<std::size_t>(motion.joint)];
    out.push_back(
        {true, "force " + in_quotes(ports[k]->component) + " acts along " +
                   (j.hidden ? "a distance" : motion.name + " of joint " + in_quotes(j.name)) +
                   ", which cannot change: the bodies' motion or other joints lock it, "
                   "and the force does no work"});
  }
}

void judge_stops(const model::Scene& scene, const system::System& s, std::vector<Finding>& out) {
  if (scene.solver.start == "equilibrium")
    return;
  const system::Workspace<double> ws(s);
  for (const system::SwitchData& element : s.switches) {
    if (element.kind != system::SwitchData::Kind::stop)
      continue;
    const double value = system::motion_row<double>(s, ws, element.motion).value;
    const double unit =
        s.motions[static_cast<std::size_t>(element.motion)].motion.is_angle() ? 180.0 / pi : 1.0;
    const std::string& name = s.couplers[static_cast<std::size_t>(element.coupler)].name;
    const double slack = 1e-6 * std::max(1.0, std::abs(value));
    if (value < element.lower - slack || value > element.upper + slack)
      out.push_back({true, "the start is beyond stop " + in_quotes(name) + ": " +
                               rounded_text(value * unit, 3) + (unit > 1.0 ? " deg" : " m") +
                               " is not within " + rounded_text(element.lower * unit, 3) + " and " +
                               rounded_text(element.upper * unit, 3) + "; a run refuses it"});
  }
}

constexpr double overstretched = 2.0; ///< strain beyond that of any rope, including rubber cords

/// Judges ropes and lines whose ends are much farther apart than their length.
void judge_stretch(const model::Scene& scene, std::vector<Finding>& out) {
  const auto judge = [&](const auto& force, double chord, double length, double stiffness) {
    const double strain =
        force.pretension ? *force.pretension / stiffness : (chord - length) / length;
    if (!(strain > overstretched))
      return;
    out.push_back(
        {true, "force " + in_quotes(force.name) +
                   (force.pretension
                        ? ": its pretension, " + rounded_text(*force.pretension, 3) + " N, is " +
                              rounded_text(strain, 3) + " times its stiffness EA, " +
                              rounded_text(stiffness, 3)
                        : ": its points are " + rounded_text(chord, 3) +
                              " m apart in the reference pose, " + rounded_text(chord / length, 3) +
                              " times its unstretched length, " + rounded_text(length, 3)) +
                   (force.pretension ? " N" : " m")});
  };
  const auto judge_line = [&](const auto& line) {
    double softest = HUGE_VAL;
    for (std::size_t i = 0; i < line.length.size(); ++i)
      softest = std::min(softest, line.stiffness_of(i));
    judge(line, (line.point_b - line.point_a).norm(),
          std::accumulate(line.length.begin(), line.length.end(), 0.0), softest);
  };
  for (const line::Rope& rope : model::forces_of<line::Rope>(scene)) {
    double chord = 0.0;
    for (std::size_t i = 1; i < rope.points.size(); ++i)
      chord += (rope.points[i] - rope.points[i - 1]).norm();
    const double length =
        !rope.winch_length.empty() ? rope.winch_length.front() : rope.length.value_or(chord);
    judge(rope, chord, length, rope.stiffness);
  }
  for (const auto& line : model::forces_of<line::CatenaryLine>(scene))
    judge_line(line);
  for (const line::Line& line : model::forces_of<line::Line>(scene))
    if (!line.free_end)
      judge_line(line);
}

/// Line in the reference pose: its sag below end A, and the dry part of its unstretched length.
struct Shape {
  double sag = 0.0, dry = 0.0; ///< [m], [-]
};
Shape shape(const line::CatenaryLine& of) {
  const Catenary line = of.law().line;
  const Vector3 d = of.point_b - of.point_a;
  const double X = std::hypot(d[0], d[1]), all = line.length(), above = of.point_b[2];
  constexpr int n = 1000;
  std::vector<double> s;
  for (int k = 0; k <= n; ++k)
    s.push_back(all * k / n);
  Shape out;
  for (const LinePoint& point : profile(line, hold(line, X, d[2], above), X, s, above)) {
    out.sag = std::max(out.sag, -point.z);
    out.dry += of.point_a[2] + point.z > 0.0 ? 1.0 / (n + 1) : 0.0;
  }
  return out;
}

/// Judges lines in other water, or on another seabed, than those of the scene.
void judge_water(const model::Scene& scene, std::vector<Finding>& out) {
  const model::Water water = model::water(scene);
  const bool bottomless = !std::isfinite(water.depth);
  const auto tell = [&](const std::string& name, bool serious, const std::string& what) {
    out.push_back({serious, "force " + in_quotes(name) + what});
  };
  const auto other_bed = [&](const std::string& name, double depth) {
    if (!bottomless && std::abs(depth - water.depth) > 1e-3 * water.depth)
      tell(name, false,
           ": its seabed is at z = " + rounded_text(-depth, 4) + " m, that of the scene at " +
               rounded_text(-water.depth, 4) + " m");
  };
  for (const line::Line& line : model::forces_of<line::Line>(scene)) {
    if (line.water_density && water.density > 0.0 && *line.water_density != water.density)
      tell(line.name, false,
           " is in water of " + rounded_text(*line.water_density, 6) + " kg/m3, the scene in " +
               rounded_text(water.density, 6) + " kg/m3");
    if (line.seabed && line.seabed_depth)
      other_bed(line.name, *line.seabed_depth);
  }
  for (const auto& line : model::forces_of<line::CatenaryLine>(scene)) {
    const Shape hangs = shape(line);
    // part of its length: 1/8 of the weight of steel is 0.1 % of all
    constexpr double hardly = 0.01;
    if (line.dry_weight.empty() && water.density > 0.0 && hangs.dry > hardly)
      tell(line.name, false,
           ": " + rounded_text(100.0 * hangs.dry, 2) +
               " % of its length is out of the water in the reference pose, where it has its "
               "weight in water, or zero if it floats: give 'dry_weight'");
    if (line.seabed)
      other_bed(line.name, -line.point_a[2]);
    else if (const double lowest = bottomless ? 0.0 : line.point_a[2] - hangs.sag;
             lowest < -1.001 * water.depth)
      tell(line.name, true,
           " hangs down to z = " + rounded_text(lowest, 4) + " m, below the sea bed at " +
               rounded_text(-water.depth, 4) +
               " m, which it does not feel: seabed = true for an anchor there, or type 'line'");
  }
}

/// Judges bodies with mass that turn about an axis without a moment of inertia, which may be an
/// oversight.
void judge_inertia(const system::System& s, std::vector<Finding>& out) {
  for (const system::BodyData& b : s.bodies)
    for (int k = b.n_translations; k < b.n_active && b.mass > 0.0; ++k)
      if (const int axis = b.active[static_cast<std::size_t>(k)] - 3; b.inertia(axis, axis) == 0.0)
        out.push_back({false, "body " + in_quotes(b.name) +
                                  " has a mass and no moment of inertia about " + "xyz"[axis] +
                                  ", and turns: it moves as a point or a thin rod"});
}

} // namespace

std::vector<Finding> look_at_mechanism(const model::Scene& scene, const system::System& s) {
  std::vector<Finding> out;
  judge_inertia(s, out);
  judge_joints(scene, s, out);
  judge_depth(scene, out);
  judge_forces(system::Regime(s), out);
  judge_stops(scene, s, out);
  judge_stretch(scene, out);
  judge_water(scene, out);
  return out;
}

std::vector<Finding> look_over(const model::Scene& scene, const system::System& s) {
  std::vector<Finding> out = look_at_bodies(scene, s);
  for (const std::vector<Finding>& more :
       {look_at_mechanism(scene, s), look_at_sea(scene), look_at_headings(scene, s),
        look_at_hulls(scene), look_at_chambers(scene)})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

void note_findings(const model::Scene& scene, system::System& s) {
  for (const Finding& finding : look_over(scene, s))
    if (finding.serious)
      s.notes.push_back("looks wrong: " + finding.text);
}

} // namespace hydrodae::sanity
