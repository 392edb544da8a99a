#include "hydrodae/statics/analysis.h"

#include <array>

#include "hydrodae/build/assemble.h"
#include "hydrodae/build/build.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/measure/observer.h"
#include "hydrodae/model/motion.h"
#include "hydrodae/model/waves.h"
#include "hydrodae/statics/analysis_moorings.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/residual.h"
#include "hydrodae/system/retract.h"
#include "hydrodae/water/hydro_axes_gradient.h"

namespace hydrodae::statics {

namespace {

using system::Regime;

/// Row (1, n_u) of a gradient by the virtual displacements of the two bodies of a joint.
Eigen::RowVectorXd joint_row(const Regime& s, const system::JointData& j,
                             const joint::Vector12& gradient) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(s.n_u);
  for (int side = 0; side < 2; ++side) {
    const int body = side == 0 ? j.A.body : j.B.body;
    if (body < 0)
      continue;
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
    for (int k = 0; k < b.n_active; ++k)
      row[b.u0 - s.u0 + k] += gradient[6 * side + b.active[static_cast<std::size_t>(k)]];
  }
  return row;
}

void add_row(MatrixX& matrix, const Eigen::RowVectorXd& row) {
  matrix.conservativeResize(matrix.rows() + 1, row.size());
  matrix.bottomRows<1>() = row;
}

void add_bodies(const Regime& s, const system::Workspace<double>& ws, const VectorX& y,
                LinearModel& out) {
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    const system::BodyData& b = s.bodies[i];
    const Vector6 xi = system::displacement<double>(s, ws, static_cast<int>(i), y.data());
    out.bodies.push_back(b.name);
    out.offsets.emplace_back(xi.head<3>());
    out.places.emplace_back(ws.bodies[i].r);
    out.rotations.emplace_back(xi.tail<3>());
    for (int k = 0; k < b.n_active; ++k)
      out.coordinates.push_back(
          b.is_mode() ? "modes/" + b.name + "/amplitude"
                      : "bodies/" + b.name + "/" +
                            std::string(model::coordinate_names[static_cast<std::size_t>(
                                b.active[static_cast<std::size_t>(k)])]));
  }
}

void add_hydro_map(const model::Scene& scene, const Regime& s, const system::Workspace<double>& ws,
                   LinearModel& out) {
  out.hydro_map = statics::hydro_map(s, ws);
  for (const system::HydroBody& hb : s.hydro.bodies) {
    for (int c = 0; c < 6; ++c) {
      if (hb.moving[static_cast<std::size_t>(c)] < 0)
        continue;
      out.hydro_labels.push_back(build::hydro_label(scene, hb, c));
      const system::HydroBody& carrier = s.hydro.bodies[static_cast<std::size_t>(hb.carrier)];
      out.hydro_yaws.push_back(carrier.yaw); // yaw by which the waves meet the body
      out.hydro_points.push_back(s.bodies[static_cast<std::size_t>(carrier.body)].position);
    }
  }
}

void add_motions(const Regime& s, const system::Workspace<double>& ws, LinearModel& out) {
  for (std::size_t m = 0; m < s.motions.size(); ++m) {
    const system::JointData& j = s.joints[static_cast<std::size_t>(s.motions[m].joint)];
    if (j.hidden)
      continue;
    out.motions.push_back("joints/" + j.name + "/" + s.motions[m].name);
    add_row(out.motion_map,
            joint_row(s, j, system::motion_row<double>(s, ws, static_cast<int>(m)).gradient));
  }
  for (const system::ElementList& list : s.elements) {
    if (list.ports.empty() || list.ports.front().motion < 0)
      continue;
    VectorX x(std::ssize(list.ports));
    for (Index k = 0; k < x.size(); ++k)
      x[k] =
          system::motion_row<double>(s, ws, list.ports[static_cast<std::size_t>(k)].motion).value;
    const std::vector<element::AtRest> rests = element::at_rest(*list.laws, x);
    for (std::size_t law = 0; law < rests.size(); ++law) {
      if (list.laws->lost_at_rest(law))
        continue; // dry friction is no damper; the notes mention it
      const system::PortData& port = list.ports[law];
      out.dampers.push_back(port.component);
      out.damper_damping.push_back(rests[law].damping(0));
      out.damper_stiffness.push_back(rests[law].stiffness(0));
      out.damper_delay.push_back(
          port.delay < 0 ? 0.0 : s.delays[static_cast<std::size_t>(port.delay)].time);
      add_row(out.damper_map, joint_row(s, s.joints[static_cast<std::size_t>(port.joint)],
                                        system::motion_row<double>(s, ws, port.motion).gradient));
    }
  }
}

/// Names of the forces with states in the linear model: those of differential equations.
std::vector<std::string> owners_of_states(const Regime& s) {
  std::vector<std::string> all(static_cast<std::size_t>(s.memory0 - s.z0)), out;
  for (const system::ElementList& list : s.elements) {
    const auto each = static_cast<std::size_t>(list.laws->shape.n_states);
    for (std::size_t k = 0; k < each * list.ports.size(); ++k)
      all[static_cast<std::size_t>(list.z0 - s.z0) + k] = list.ports[k / each].component;
  }
  for (std::size_t z = 0; z < all.size(); ++z)
    if (!s.is_algebraic(s.z0 + static_cast<Index>(z)))
      out.push_back(all[z]);
  return out;
}

/// Reactions (6 n_joints,) of the reported joints.
VectorX reactions(const Regime& s, measure::Observer& observer, const VectorX& y) {
  const measure::Observation& o = observer.observe(0.0, y, VectorX::Zero(s.n));
  VectorX out(0);
  for (std::size_t j = 0; j < s.joints.size(); ++j) {
    if (s.joints[j].hidden)
      continue;
    out.conservativeResize(out.size() + 6);
    out.tail<6>() = o.reactions[j];
  }
  return out;
}

constexpr std::array<const char*, 6> wrench_names = {"force.x",  "force.y",  "force.z",
                                                     "moment.x", "moment.y", "moment.z"};

/// Adds the loads that hold the missing coordinates of bodies.
void add_supports(const Regime& s, const VectorX& y, LinearModel& out) {
  measure::Observer observer(s);
  const measure::Observation& o = observer.observe(0.0, y, VectorX::Zero(s.n));
  out.support.resize(0);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    if (s.bodies[i].n_active == 6)
      continue;
    for (const char* part : wrench_names)
      out.supports.push_back("bodies/" + s.bodies[i].name + "/support_" + part);
    out.support.conservativeResize(out.support.size() + 6);
    out.support.tail<6>() = o.supports[i];
  }
}

/// Adds the derivatives of reactions. They are linear in lambda. Their axes turn with the pose:
/// central differences have an error of h^2 = 1e-10 of the static reaction.
void add_reactions(const Regime& s, const VectorX& y, LinearModel& out) {
  measure::Observer observer(s);
  for (const system::JointData& j : s.joints)
    if (!j.hidden)
      for (const char* part : wrench_names)
        out.reactions.push_back("joints/" + j.name + "/reaction_" + part);
  out.reaction = reactions(s, observer, y);
  out.reaction_by_xi.resize(out.reaction.size(), s.n_u);
  out.reaction_by_lambda.resize(out.reaction.size(), s.n_lambda);
  VectorX unloaded = y;
  unloaded.segment(s.lambda0, s.n_lambda).setZero();
  for (Index k = 0; k < s.n_lambda; ++k) {
    VectorX loaded = unloaded;
    loaded[s.lambda0 + k] = 1.0;
    out.reaction_by_lambda.col(k) = reactions(s, observer, loaded);
  }
  constexpr double h = 1e-5;
  for (Index k = 0; k < s.n_u; ++k) {
    VectorX plus = y, minus = y;
    system::retract(s, h * VectorX::Unit(s.n_u, k), plus);
    system::retract(s, -h * VectorX::Unit(s.n_u, k), minus);
    out.reaction_by_xi.col(k) =
        (reactions(s, observer, plus) - reactions(s, observer, minus)) / (2.0 * h);
  }
}

/// Adds the loads by the motion of the water, point by point.
void add_water(const Regime& s, const system::Workspace<double>& ws, LinearModel& out) {
  system::for_each_law(
      s, [&](const system::ElementList& list, std::size_t law, const system::PortData& port) {
        if (!list.laws->shape.in_water())
          return;
        const system::BodyData& b = s.bodies[static_cast<std::size_t>(port.body)];
        std::array<double, element::body_numbers> in;
        element::write(ws.bodies[static_cast<std::size_t>(port.seen())], in.data());
        for (const element::WaterLoad& at : list.laws->by_water(law, in.data())) {
          MatrixX on_all = MatrixX::Zero(s.n_u, 7);
          for (int c = 0; c < b.n_active; ++c)
            on_all.row(b.u0 - s.u0 + c) = at.load.row(b.active[static_cast<std::size_t>(c)]);
          out.water_points.push_back(at.point);
          out.water_loads.push_back(on_all);
        }
      });
}

/// Notes nonlinear limits and damping, which a linear model lacks.
void note_nonlinear(const Regime& s, LinearModel& out) {
  std::vector<std::string> stops;
  for (const system::SwitchData& element : s.switches)
    if (element.kind == system::SwitchData::Kind::stop && !s.holds(element))
      stops.push_back(s.couplers[static_cast<std::size_t>(element.coupler)].name);
  if (!stops.empty())
    out.notes.push_back("stops and one-sided joints are open in the linear model: " +
                        joined(stops));
  for (const system::ElementList& list : s.elements) {
    const element::Elements& laws = *list.laws;
    std::vector<std::string> lost;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      if (laws.lost_at_rest(k) && !laws.lost.empty())
        lost.push_back(laws.names[k]);
      if (!laws.at_rest_only.empty())
        out.notes.push_back("the linear model has of " + in_quotes(laws.names[k]) +
                            " the slope at rest only: " + std::string(laws.at_rest_only));
    }
    if (!lost.empty())
      out.notes.push_back(laws.lost + ": " + joined(lost));
  }
}

} // namespace

LinearModel linearize(const model::Scene& scene) {
  model::Scene still = scene;
  still.waves.clear();
  still.pose_tables.clear();
  if (still.hydro) {
    still.hydro->radiation = "none";
    static_cast<water::RadiationKeys&>(*still.hydro) = {};
  }
  system::System system = build::build(still, false);
  system.hydro.added_mass.all.setZero();
  build::add_shared_mass(still, system.hydro);
  system.hydro.link();
  const auto [y, modes, unstable] = statics::settle(still, system);
  build::note_axes(scene, system);
  const Regime s(system, modes);
  const statics::LinearMatrices m = statics::linear_matrices(s, system::find_pattern(s), y);
  LinearModel out;
  out.mass = m.mass;
  out.damping = m.damping;
  out.stiffness = m.stiffness;
  out.constraints = m.constraints;
  out.load_by_state = m.load_by_state;
  out.state_by_state = m.state_by_state;
  out.state_by_xi = m.state_by_xi;
  out.state_by_rate = m.state_by_rate;
  out.state_of = owners_of_states(s);
  out.notes = system.notes;
  out.water_depth = model::water(scene).depth;
  out.gravity = model::water(scene).gravity;
  out.motion_map = out.damper_map = MatrixX(0, s.n_u);
  system::Workspace<double> ws(s);
  const VectorX rest = VectorX::Zero(s.n);
  system::unpack<double>(s, y.data(), rest.data(), ws.bodies);
  add_bodies(s, ws, y, out);
  add_hydro_map(still, s, ws, out);
  add_motions(s, ws, out);
  add_water(s, ws, out);
  note_nonlinear(s, out);
  out.moorings = moorings(s, ws, y);
  for (const model::Controller& c : scene.controllers)
    out.notes.push_back("the linear model is without the controller " + in_quotes(c->name) +
                        ": what it writes stays as the case has it");
  add_reactions(s, y, out);
  add_supports(s, y, out);
  return out;
}

MatrixX wave_components(const model::Scene& scene) {
  MatrixX out(0, 4);
  for (const sea::Component& c : model::wave_components(scene))
    add_row(out, Eigen::RowVector4d(c.omega, c.heading, c.amplitude, c.phase));
  return out;
}

} // namespace hydrodae::statics
