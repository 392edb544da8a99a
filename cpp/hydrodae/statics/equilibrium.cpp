#include "hydrodae/statics/equilibrium.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/element/rubbing.h"
#include "hydrodae/math/dense.h"
#include "hydrodae/sanity/sanity.h"
#include "hydrodae/statics/balance.h"
#include "hydrodae/statics/fit_at_waves.h"
#include "hydrodae/statics/static_step.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::statics {

namespace {

using system::BodyData;
using system::Regime;
using system::System;

/// Copies the positions of y into the start of the bodies and motions, at rest.
void take_start(System& s, const VectorX& y) {
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(y.size());
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    BodyData& b = s.bodies[i];
    b.position = ws.bodies[i].r;
    b.velocity = b.angular_velocity = Vector3::Zero();
    if (b.rotation == BodyData::Rotation::about_axis)
      b.orientation =
          quaternion_from_rotation_vector(y[b.q0 + b.n_translations] * Vector3::Unit(b.axis));
    if (b.rotation == BodyData::Rotation::free)
      b.orientation = ws.bodies[i].p.normalized();
  }
  for (int m = 0; m < static_cast<int>(s.motions.size()); ++m)
    s.motions[static_cast<std::size_t>(m)].start = system::motion_row<double>(s, ws, m).value;
}

/// Replaces laws with states by laws at rest.
/// @returns whether there are any
bool take_statics(System& s) {
  bool any = false;
  for (system::ElementList& list : s.elements)
    if (auto statics = list.laws->statics()) {
      list.laws = std::move(statics);
      any = true;
    }
  if (any)
    system::number(s);
  return any;
}

/// Note on a direction, allowed by the constraints, in which forces drive the scene away; ""
/// for a stable pose.
std::string instability(const LinearMatrices& m, const VectorX& scale) {
  const MatrixX free = scale.asDiagonal() * null_space(m.constraints * scale.asDiagonal());
  if (free.cols() == 0)
    return "";
  const MatrixX K = free.transpose() * m.stiffness * free;
  // The hydrostatics of modes have no potential of their own: K need not be symmetric.
  const VectorX values = real_parts_of_eigenvalues(K);
  return values.minCoeff() < -1e-6 * values.cwiseAbs().maxCoeff()
             ? "the equilibrium is unstable: the smallest displacement moves the scene away from it"
             : "";
}

/// Unit length or angle of a coordinate.
double size_of(const System& s, int motion) {
  const system::BodyData* b = system::moving_body(s, system::joint_of(s, motion));
  if (!b)
    return 1.0;
  const bool turns = s.motions[static_cast<std::size_t>(motion)].motion.is_angle();
  return b->length_scale / (turns ? b->lever : 1.0);
}

/// Closes the stop that y violates most, or else opens the one that pulls most; returns false if
/// every stop agrees with y. Dry friction stays open: it can hold any pose nearby.
bool correct_stops(Regime& s, const VectorX& y) {
  using State = Regime::Mode;
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  double worst = 0.0;
  const system::SwitchData* which = nullptr;
  State next = State::open;
  const auto propose = [&](double wrong, const system::SwitchData& element, State state) {
    if (wrong > worst) {
      worst = wrong;
      which = &element;
      next = state;
    }
  };
  for (const system::SwitchData& element : s.switches) {
    if (element.kind != system::SwitchData::Kind::stop || s.holds(element))
      continue;
    const double value = system::motion_row<double>(s, ws, element.motion).value;
    const double little = 1e-9 * size_of(s, element.motion);
    propose(value - element.upper - little, element, State::upper);
    propose(element.lower - value - little, element, State::lower);
  }
  for (const system::SwitchData& element : s.switches) {
    if (!s.holds(element) || worst > 0.0)
      continue;
    const Index row = s.lambda(s.couplers[static_cast<std::size_t>(element.coupler)]);
    const double pull = y[row] / s.scale[row];
    propose((s.mode(element) == State::upper ? pull : -pull) - balanced, element, State::open);
  }
  if (which)
    system::set_mode(s, *which, next);
  return which != nullptr;
}

/// Names of ropes with friction; an equilibrium neglects their friction.
std::string rubbing_ropes(const System& s) {
  std::vector<std::string> names;
  for (const system::ElementList& list : s.elements)
    if (const auto* rubs = dynamic_cast<const element::Rubbing*>(list.laws.get());
        rubs && rubs->may_rub())
      for (const std::string& name : list.laws->names)
        names.push_back(in_quotes(name));
  return joined(names);
}

constexpr const char* one_tension =
    " is left out of the equilibrium: they have one tension all along, and weights that friction "
    "alone holds start from a pose of their own";

/// Notes switches and friction for a linear model about the equilibrium.
void note_switches(const Regime& rows, System& s) {
  if (const std::string ropes = rubbing_ropes(s); !ropes.empty())
    s.notes.push_back("friction of ropes (" + ropes + ")" + one_tension +
                      "; rest is possible in a band about it, up to the ratio 'grip' of the "
                      "tensions at both ends");
  for (const system::SwitchData& element : s.switches) {
    const std::string& name = s.couplers[static_cast<std::size_t>(element.coupler)].name;
    if (rows.holds(element))
      s.notes.push_back("'" + name + "' holds its bound in the equilibrium");
    if (element.kind == system::SwitchData::Kind::friction)
      s.notes.push_back("dry friction '" + name + "' is left out of the equilibrium");
  }
}

} // namespace

Rest move_to_equilibrium(System& system) {
  System s = system; // without waves
  system::calm(s);
  const bool less = take_statics(s);
  Regime rows(s);
  VectorX y = system::initial_state(rows);
  if (!y.segment(s.u0, s.n_u).isZero(0.0))
    throw ModelError("solver.start", "start = \"equilibrium\" is at rest, but the case gives "
                                     "initial velocities");
  LinearMatrices m = [&] {
    try {
      return balance(rows, y);
    } catch (const ModelError& error) {
      const std::string ropes = rubbing_ropes(system);
      if (ropes.empty())
        throw;
      throw ModelError(error.key,
                       error.what() + ("; friction of ropes (" + ropes + ")") + one_tension);
    }
  }();
  for (std::size_t pass = 0; correct_stops(rows, y); ++pass) {
    if (pass > 4 * s.switches.size())
      throw ModelError("solver.start", "no static equilibrium that all stops agree with");
    system::lay_out(rows);
    system::resize(rows, y);
    m = balance(rows, y);
  }
  note_switches(rows, system);
  const std::string unstable = instability(m, build::displacement_scale(s));
  if (!unstable.empty())
    system.notes.push_back(unstable);
  take_start(system, y);
  if (!less)
    return {y, rows.modes, unstable};
  build::start_laws(system);
  VectorX all = system::initial_state(Regime(system, rows.modes));
  all.head(s.z0) = y.head(s.z0);
  all.tail(rows.n - rows.lambda0) = y.tail(rows.n - rows.lambda0);
  return {all, rows.modes, unstable};
}

Rest settle(const model::Scene& scene, System& s) {
  constexpr int most_passes = 20;
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::size_t notes = s.notes.size();
    Rest rest = move_to_equilibrium(s);
    if (!build::take_mean_yaw(scene, s))
      return rest;
    s.notes.resize(notes);
  }
  throw ModelError("solver.start", "no static equilibrium near the start: the yaw of the bodies, "
                                   "with which the hydrostatics turn, does not settle");
}

System bare_system(const model::Scene& scene) {
  const bool rests = scene.solver.start == "equilibrium";
  const build::Sea sea = build::draw_sea(scene);
  System s = build::build(scene, sea, !rests);
  if (rests) {
    settle(scene, s);
    build::note_axes(scene, s);
    build::add_sea(scene, sea, s);
    build::add_second_order(scene, sea, s);
  }
  return s;
}

System starting_system(const model::Scene& scene) {
  System s = bare_system(scene);
  sanity::note_findings(scene, s);
  for (const sanity::Finding& finding : look_at_fit(scene, s))
    s.notes.push_back((finding.serious ? "looks wrong: " : "") + finding.text);
  return s;
}

} // namespace hydrodae::statics
