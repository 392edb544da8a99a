#include <algorithm>
#include <variant>

#include "hydrodae/ensemble/march.h"
#include "hydrodae/run/method_choice.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/statics/equilibrium.h"
#include "hydrodae/system/history.h"

namespace hydrodae::ensemble {

namespace {

/// Returns whether the laws of two systems act at the same places.
bool same_ports(const system::System& a, const system::System& b) {
  const auto same = [](const system::PortData& x, const system::PortData& y) {
    const auto point = [](const joint::Marker& m, const joint::Marker& n) {
      return m.body == n.body;
    };
    return x.motion == y.motion && x.body == y.body && x.joint == y.joint &&
           x.motions == y.motions &&
           std::equal(x.points.begin(), x.points.end(), y.points.begin(), y.points.end(), point);
  };
  return std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
                    [&](const system::ElementList& x, const system::ElementList& y) {
                      return x.laws->type == y.laws->type &&
                             std::equal(x.ports.begin(), x.ports.end(), y.ports.begin(),
                                        y.ports.end(), same);
                    });
}

/// Returns whether two starts have equations between the same unknowns.
bool alike(const Start& a, const Start& b) {
  const auto joint = [](const system::JointData& x, const system::JointData& y) {
    return x.A.body == y.A.body && x.B.body == y.B.body && x.type == y.type;
  };
  const std::vector<system::JointData>&j = a.system.joints, &k = b.system.joints;
  const system::HydroData &m = a.system.hydro, &n = b.system.hydro;
  return a.regime.names == b.regime.names && a.regime.lambdas == b.regime.lambdas &&
         std::equal(j.begin(), j.end(), k.begin(), k.end(), joint) && m.partners == n.partners &&
         m.radiation == n.radiation && same_ports(a.system, b.system);
}

} // namespace

Start::Start(const model::Scene& given, const Start* like)
    : scene(given), system(statics::bare_system(given)), regime(system) {
  pattern = like && alike(*like, *this)
                ? like->pattern
                : std::make_shared<const system::Pattern>(system::find_pattern(regime));
  y = system::initial_state(regime);
  statics::consistent_start(regime, *pattern, y, yp);
  system::take_time_scales(system, y, yp);
  system::lay_out(regime);
  for (system::ElementList& list : system.elements)
    if (auto light = list.laws->unreported())
      list.laws = std::move(light);
}

namespace {

/// Returns whether a row has no branches (LaneModel).
bool is_smooth(const joint::BasicRow& row) {
  return std::holds_alternative<joint::SpanRow>(row) ||
         std::holds_alternative<joint::PerpRow>(row) ||
         std::holds_alternative<joint::DistanceRow>(row);
}

std::string of_elements(const system::ElementList& list) {
  const std::string type(list.laws->type);
  if (!list.laws->sticks.empty())
    return type + " sticks";
  if (list.laws->shape.n_reaction > 0)
    return type + " feels the reaction of its joint";
  if (list.laws->shape.n_algebraic > 0)
    return type + " has algebraic unknowns";
  return "";
}

/// The method that the run begins with, and what it calls.
std::string of_method(const Start& start) {
  const SolverOptions& options = start.scene.solver;
  const run::SceneTraits traits =
      run::find_traits(start.regime, *start.pattern, options, start.y, start.yp);
  if (!traits.costly.empty())
    return "each evaluation calls " + traits.costly;
  if (const MethodTraits* named = find_method(options.method))
    return named->marches_lanes ? "" : "solver.method is " + options.method;
  const run::MethodOrder order = run::order_methods(traits);
  const std::string& first = order.methods.front();
  return method_traits(first).marches_lanes ? "" : "it begins with " + first + ": " + order.reason;
}

} // namespace

std::string alone_because(const Start& start) {
  const system::System& s = start.system;
  const SolverOptions& options = start.scene.solver;
  if (!s.has_waves())
    return "it has no waves";
  if (!start.scene.controllers.empty())
    return "it has controllers";
  if (!s.switches.empty())
    return "it has stops or dry friction";
  if (!s.couplers.empty())
    return "it has drives or couplings";
  if (system::has_past(s))
    return "its loads depend on the past";
  if (!s.hydro.added_mass.tables.empty())
    return "its tables follow a pose";
  if (options.order == 5 || options.formulation != "stabilised")
    return "its [solver] asks for another order or formulation";
  for (const system::JointData& j : s.joints)
    for (const system::RowData& row : j.rows)
      if (!is_smooth(row.kind))
        return "joint " + j.name + " has a " + joint::row_name(row.kind);
  for (const system::ElementList& list : s.elements)
    if (const std::string why = of_elements(list); !why.empty())
      return why;
  const MatrixX& A = s.hydro.added_mass.moving;
  if (A.size() > 0 && !A.isApprox(A.transpose(), 1e-12))
    return "the added mass is not symmetric";
  return of_method(start);
}

std::string apart_because(const Start& one, const Start& other) {
  const system::System &a = one.system, &b = other.system;
  const auto differ = [](bool same, const char* what) {
    return same ? "" : std::string("they differ in ") + what;
  };
  if (a.lambda0 != b.lambda0 || one.regime.n != other.regime.n ||
      a.elements.size() != b.elements.size())
    return "they differ in their unknowns";
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const system::BodyData &x = a.bodies[i], &y = b.bodies[i];
    if (x.mass != y.mass || x.inertia != y.inertia || x.active != y.active ||
        x.rotation != y.rotation)
      return "they differ in the mass of body " + x.name;
  }
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    const system::JointData &x = a.joints[i], &y = b.joints[i];
    const auto same = [](const joint::Marker& m, const joint::Marker& n) {
      return m.body == n.body && m.point == n.point && m.axes == n.axes;
    };
    if (!same(x.A, y.A) || !same(x.B, y.B) || x.parameters.length != y.parameters.length)
      return "they differ in joint " + x.name;
  }
  if (one.regime.lambdas != other.regime.lambdas)
    return "they differ in the rows of their joints";
  const system::HydroData &h = a.hydro, &k = b.hydro;
  const bool water = h.axes == k.axes && h.added_mass.moving == k.added_mass.moving &&
                     h.radiation == k.radiation &&
                     std::equal(h.bodies.begin(), h.bodies.end(), k.bodies.begin(), k.bodies.end(),
                                [](const auto& x, const auto& y) {
                                  return x.yaw == y.yaw && x.moving == y.moving;
                                });
  if (const std::string why = differ(water, "the water"); !why.empty())
    return why;
  const SolverOptions &m = one.scene.solver, &n = other.scene.solver;
  if (const std::string why = differ(
          m.end_time == n.end_time && m.rtol == n.rtol && m.step == n.step &&
              m.max_step == n.max_step && m.energy_guard == n.energy_guard &&
              m.branch_guard == n.branch_guard && m.tolerance_assembly == n.tolerance_assembly,
          "[solver]");
      !why.empty())
    return why;
  return differ(one.scene.sea.ramp == other.scene.sea.ramp &&
                    one.scene.output.step == other.scene.output.step,
                "the ramp or the step of the output");
}

} // namespace hydrodae::ensemble
