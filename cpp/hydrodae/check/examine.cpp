#include "hydrodae/check/examine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/observe/recorder.h"
#include "hydrodae/run/controllers.h"
#include "hydrodae/simulation.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/system/retract.h"

namespace hydrodae::check {

namespace {

using system::System;

/// Rest, as part of the largest motion in units of the scales of the bodies
constexpr double resting = 1e-9;
constexpr std::size_t longest_list = 30;

/// Replaces drives by others that surely accelerate, from the same values.
void stir_drives(System& s) {
  for (system::CouplerData& c : s.couplers) {
    const bool steady =
        c.drive.rate == 0.0 && c.drive.amplitude == 0.0 && c.drive.time.empty() && !c.drive.python;
    if (steady)
      continue;
    const double start = c.drive(0.0)[0];
    c.drive = Drive{};
    c.drive.amplitude = 0.1;
    c.drive.period = 5.0;
    c.drive.phase = 0.7;
    c.drive.constant = start - 0.1 * std::sin(0.7);
  }
}

/// Replaces the waves by those at some time after the ramp, with a random phase of each component.
template <class Draw> void stir_waves(const System& given, System& s, Draw&& draw) {
  for (std::size_t k = 0; k < s.elements.size(); ++k)
    if (auto stirred = given.elements[k].laws->stirred(draw))
      s.elements[k].laws = std::move(stirred);
}

/// Offset of a body's velocity coordinates in vectors of length n_u.
Index first(const System& s, const system::BodyData& b) { return b.u0 - s.u0; }

/// Coordinates of this body that never move: "sway, roll, yaw".
std::vector<std::string> resting_coordinates(const System& s, const system::BodyData& b,
                                             const std::vector<bool>& never) {
  std::vector<std::string> out;
  for (int k = 0; k < b.n_active; ++k)
    if (never[static_cast<std::size_t>(first(s, b) + k)])
      out.emplace_back(model::coordinate_names[static_cast<std::size_t>(b.active[k])]);
  return out;
}

/// Cheapest `motion` with all coordinates that move.
std::string lesser_motion(const System& s, const system::BodyData& b,
                          const std::vector<bool>& never) {
  std::array<bool, 6> moves{};
  for (int k = 0; k < b.n_active; ++k)
    moves[static_cast<std::size_t>(b.active[k])] =
        !never[static_cast<std::size_t>(first(s, b) + k)];
  const auto rotations = std::count(moves.begin() + 3, moves.end(), true);
  if (rotations > 1) // a body turns about no axis, one, or all
    std::fill(moves.begin() + 3, moves.end(), true);
  const auto free = std::count(moves.begin(), moves.end(), true);
  if (free == b.n_active)
    return "";
  if (free == 0)
    return "\"fixed\"";
  if (!moves[1] && !moves[3] && !moves[5] && moves[0] && moves[2] && moves[4])
    return "\"planar\"";
  if (moves[0] && moves[1] && moves[2] && rotations == 0)
    return "\"point\"";
  std::string list;
  for (std::size_t c = 0; c < 6; ++c)
    if (moves[c])
      list += (list.empty() ? "\"" : ", \"") + std::string(model::coordinate_names[c]) + "\"";
  return free == 1 ? list : "[" + list + "]";
}

void advise_bodies(std::ostream& out, const System& s, const std::vector<bool>& never) {
  for (const system::BodyData& b : s.bodies) {
    if (b.kind == system::BodyData::Kind::attachment)
      continue; // moves as its body does
    const std::vector<std::string> rest =
        never.empty() ? std::vector<std::string>{} : resting_coordinates(s, b, never);
    if (rest.empty())
      continue;
    if (b.is_mode()) {
      out << "  never excited: mode '" << b.name << "'\n";
      continue;
    }
    out << "  never excited: " << joined(rest) << " of body '" << b.name
        << "' (held by joints or zero by symmetry, which a disturbance may break)\n";
    const std::string less = lesser_motion(s, b, never);
    if (!less.empty())
      out << "  could be less: body '" << b.name << "' with motion = " << less << '\n';
  }
}

/// Returns whether a force or a constraint acts on a coordinate of this joint.
bool joint_is_used(const model::Scene& scene, const std::string& name) {
  bool used = std::any_of(
      scene.constraints.begin(), scene.constraints.end(), [&](const model::Constraint& c) {
        const auto terms = c.visit([](const auto& one) { return one.condition().terms; });
        return std::any_of(terms.begin(), terms.end(),
                           [&](const auto& term) { return term.joint == name; });
      });
  model::for_each_force(scene, [&](const auto& force) {
    if constexpr (requires { force.joint; })
      used = used || force.joint == name;
  });
  return used;
}

/// Advises on joints that a locked coordinate could replace without cost.
void advise_joints(std::ostream& out, const model::Scene& scene) {
  const auto mobile = [&](const std::string& name) {
    const auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                   [&](const model::Body& b) { return b.name == name; });
    return body != scene.bodies.end() && model::moves(*body);
  };
  for (const model::Joint& j : scene.joints) {
    const bool a = mobile(j.body_a), b = mobile(j.body_b);
    if (!a && !b)
      continue;
    const std::string& body = b ? j.body_b : j.body_a;
    const joint::JointType& type = *joint::find_joint_type(j.type);
    if (type.welds() && a && b)
      out << "  could be less: bodies '" << j.body_a << "' and '" << j.body_b << "', which joint '"
          << j.name << "' fixes to each other, as one body\n";
    else if (type.welds())
      out << "  could be less: joint '" << j.name << "' as motion = \"fixed\" of body '" << body
          << "', whose support load is reported too\n";
    const auto alone = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                    [&](const model::Body& other) { return other.name == body; });
    const std::array<bool, 6> free = model::free_coordinates(*alone);
    if (!type.guides() || (a && b) || std::count(free.begin(), free.end(), true) == 1 ||
        joint_is_used(scene, j.name))
      continue;
    for (int c = 0; c < 3; ++c)
      if (std::abs(j.axis->normalized()[c]) > 1.0 - 1e-12)
        out << "  could be less: joint '" << j.name << "' as motion = \""
            << model::coordinate_names[static_cast<std::size_t>(c)] << "\" of body '" << body
            << "'\n";
  }
}

void write_costs(std::ostream& out, std::vector<ElementCost> costs) {
  std::stable_sort(costs.begin(), costs.end(), [](const ElementCost& a, const ElementCost& b) {
    return a.nonzeros > b.nonzeros;
  });
  out << "  cost of each element:       unknowns  multipliers  nonzeros\n";
  for (std::size_t k = 0; k < std::min(costs.size(), longest_list); ++k) {
    const ElementCost& c = costs[k];
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "%8lld %12lld %9lld", static_cast<long long>(c.unknowns),
                  static_cast<long long>(c.multipliers), static_cast<long long>(c.nonzeros));
    out << "    " << c.name << std::string(c.name.size() < 24 ? 24 - c.name.size() : 1, ' ')
        << numbers << '\n';
  }
  if (costs.size() > longest_list)
    out << "    ... and " << costs.size() - longest_list << " cheaper ones\n";
}

} // namespace

std::vector<bool> never_excited(const System& given, const system::Pattern& pattern) {
  System stirred_system = given;
  stir_drives(stirred_system);
  const system::Regime s(stirred_system);
  const VectorX start = system::initial_state(s), size = build::displacement_scale(s);
  VectorX time(s.n_u);
  for (const system::BodyData& b : s.bodies)
    time.segment(first(s, b), b.n_active).setConstant(b.time_scale);
  std::vector<bool> never(static_cast<std::size_t>(s.n_u), true);
  std::vector<bool> stirred(static_cast<std::size_t>(s.n_z), false); // memory states
  std::mt19937 random(11);
  const auto draw = [&] { return 2.0 * (random() / 4294967296.0) - 1.0; };
  std::vector<double> given_drives;
  for (const system::CouplerData& c : s.couplers)
    given_drives.push_back(c.drive.constant);
  int quiet = 0;
  for (int round = 0; round < 40 && quiet < 3; ++round) {
    VectorX y = start, step = VectorX::Zero(s.n_u), yp;
    stir_waves(given, stirred_system, draw);
    if (round > 0) {
      for (std::size_t k = 0; k < s.couplers.size(); ++k) { // later action of a drive
        system::CouplerData& c = stirred_system.couplers[k];
        if (s.holds(c) && !c.velocity_level && c.drive.amplitude != 0.0)
          c.drive.constant = given_drives[k] + draw() * s.row_scale[s.mu(c)];
      }
      for (Index k = 0; k < s.n_u; ++k)
        if (!never[static_cast<std::size_t>(k)]) {
          step[k] = draw() * size[k];
          y[s.u0 + k] += draw() * size[k] / time[k];
        }
      system::retract(s, step, y);
      for (Index k = 0; k < s.n_z; ++k)
        if (stirred[static_cast<std::size_t>(k)])
          y[s.z0 + k] += draw() * s.scale[s.z0 + k];
    }
    const bool closed = build::close(s, y);
    try {
      if (!closed)
        continue; // too far from the start for this draw
      statics::consistent_start(s, pattern, y, yp);
    } catch (const Error&) {
      if (round == 0)
        return {};
      continue; // a singular pose
    }
    // Velocities and accelerations, both as unit displacements over the body's time scale.
    const VectorX speed = y.segment(s.u0, s.n_u).cwiseProduct(time).cwiseQuotient(size);
    const VectorX rate =
        yp.segment(s.u0, s.n_u).cwiseProduct(time).cwiseProduct(time).cwiseQuotient(size);
    const double fast = std::max(1.0, speed.lpNorm<Eigen::Infinity>()),
                 hard = std::max(1.0, rate.lpNorm<Eigen::Infinity>());
    bool grown = false;
    for (Index k = 0; k < s.n_u; ++k)
      if (never[static_cast<std::size_t>(k)] &&
          (std::abs(speed[k]) > resting * fast || std::abs(rate[k]) > resting * hard)) {
        never[static_cast<std::size_t>(k)] = false;
        grown = true;
      }
    const VectorX memory = yp.segment(s.z0, s.n_z).cwiseAbs();
    for (Index k = 0; k < s.n_z; ++k)
      if (!stirred[static_cast<std::size_t>(k)] && memory[k] > resting * memory.maxCoeff())
        stirred[static_cast<std::size_t>(k)] = grown = true;
    quiet = grown || round == 0 ? 0 : quiet + 1;
  }
  return never;
}

namespace {

/// Writes the channels that controllers read and the inputs that may be written.
void write_inputs(std::ostream& out, const model::Scene& scene, system::Regime& s,
                  std::vector<Channel> channels) {
  std::vector<run::Input> inputs = run::find_inputs(s);
  const std::vector<Channel> held = run::held_channels(scene, inputs);
  channels.insert(channels.end(), held.begin(), held.end());
  const auto listed = [](const std::vector<control::Terminal>& terminals) {
    std::vector<std::string> names;
    for (const control::Terminal& t : terminals)
      names.push_back(t.name + " [" + t.unit + "]");
    return joined(names);
  };
  for (const model::Controller& c : scene.controllers) {
    const control::Terminals found = run::find_terminals(c, channels, inputs);
    if (!c.as<control::Outside>())
      run::make_law(c, found, s); // throws if it does not fit
    std::vector<std::string> units = run::unit_notes(c->name, found);
    if (const auto* fmu = c.as<control::Fmu>())
      for (const std::string& note : cosim::check_fmu(*fmu, found)) // throws if it does not fit
        units.push_back(note);
    out << "  controller " << c->name << " (" << c.type() << "): every " << c->period << " s "
        << listed(found.inputs) << " -> " << listed(found.outputs);
    if (c->delay > 0.0)
      out << ", " << c->delay << " s later";
    if (c->lag > 0.0)
      out << ", with a lag of " << c->lag << " s";
    out << "\n";
    for (const std::string& note : units)
      out << "  note: " << note << "\n";
  }
  std::vector<std::string> names;
  for (const run::Input& input : inputs)
    names.push_back(input.name + " [" + input.unit + "]");
  if (!names.empty())
    out << "  inputs for controllers and programs: " << joined(names) << "\n";
}

/// Report of `hydrodae check`.
std::string report(const model::Scene& scene) {
  const System built = build::build(scene);
  system::Regime s(built);
  const system::Pattern pattern = system::find_pattern(s);
  measure::Measure measure(s, 0.0, system::initial_state(s), VectorX::Zero(s.n));
  const observe::Recorder named(s, measure); // throws if names collide
  std::ostringstream out;
  out << model::summary(scene) << "  unknowns: " << s.n << " = " << s.n_q << " positions + "
      << s.n_u << " velocities + " << s.n_z << " states + " << s.n_lambda << " + " << s.n_mu
      << " multipliers";
  if (s.n > s.sigma0)
    out << " + " << s.n - s.sigma0 << " of quaternion norms";
  out << "; " << pattern.nonzeros() << " nonzeros in the Jacobian\n"
      << "  mobility: " << build::mobility(s) << " degrees of freedom left by " << s.n_lambda
      << " constraint rows\n";
  write_sizes(out, scene, s, named.width());
  write_method(out, scene);
  write_costs(out, element_costs(s, pattern));
  advise_bodies(out, s, never_excited(built, pattern));
  advise_joints(out, scene);
  write_inputs(out, scene, s, named.channels());
  for (const std::string& note : built.notes)
    out << "  note: " << note << "\n";
  write_sanity(out, scene, s);
  return out.str();
}

} // namespace

} // namespace hydrodae::check

namespace hydrodae {

std::string examine(const model::Scene& scene) { return check::report(scene); }

std::vector<std::pair<std::string, long>> count(const model::Scene& scene) {
  const system::System built = build::build(scene);
  const system::Regime s(built);
  return {{"unknowns", s.n},
          {"positions", s.n_q},
          {"velocities", s.n_u},
          {"states", s.n_z},
          {"multipliers", s.n_lambda + s.n_mu},
          {"nonzeros", system::find_pattern(s).nonzeros()},
          {"degrees_of_freedom", build::mobility(s)},
          {"constraint_rows", s.n_lambda}};
}

} // namespace hydrodae
