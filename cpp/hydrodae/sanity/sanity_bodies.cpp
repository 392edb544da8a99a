/// Weight against buoyancy, radii of gyration, hydrostatic stability.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydrodae/core/text.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/sanity/sanity.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/system/mechanisms.h"
#include "hydrodae/system/residual.h"

namespace hydrodae::sanity {

namespace {

/// Imbalance of free-floating bodies: reported, and serious
constexpr double worth_saying = 0.005, too_much = 0.05;
constexpr double lightest = 0.02, heaviest = 50.0; ///< weight over buoyancy of held bodies
constexpr double thinnest = 0.03, widest = 10.0;   ///< radius of gyration over V^(1/3)
constexpr double unit_slip = 100.0;                ///< factor that suggests a wrong unit

std::string percent(double part) {
  const double value = 100.0 * part;
  return (value > 0.0 ? "+" : "") + number_text(std::round(value * 100.0) / 100.0) + " %";
}

/// Text of a force, "2.568 kN".
std::string force_text(double newtons) {
  const double size = std::abs(newtons);
  return size >= 1e6   ? rounded_text(newtons / 1e6, 4) + " MN"
         : size >= 1e3 ? rounded_text(newtons / 1e3, 4) + " kN"
                       : rounded_text(newtons, 4) + " N";
}

/// Returns whether a row of a joint, or a motion, changes when one body heaves.
bool feels_heave(const joint::Vector12& gradient, int side) {
  return std::abs(gradient[6 * side + 2]) > 1e-9;
}

/// Returns whether these laws load a body by the pressure of still water at its pose.
bool follows_pose(const element::Elements& laws) { return laws.shape.in_water() && laws.buoyant; }

/// Linearised laws of still-water pressure, with their bodies in the reference pose.
std::vector<element::AtRest> in_reference_pose(const system::System& s,
                                               const system::ElementList& list) {
  const std::shared_ptr<const element::Elements> still = list.laws->calm(),
                                                 calm = still ? still : list.laws;
  const auto n = static_cast<Index>(calm->size());
  VectorX in(n * element::body_numbers), out(6 * n), slope(n * 6 * 18);
  element::BodyState<double> state{};
  state.R.setIdentity();
  state.v = state.w = state.v_dot = state.w_dot = Vector3::Zero();
  for (Index k = 0; k < n; ++k) {
    const int body = list.ports[static_cast<std::size_t>(k)].body;
    state.r = s.bodies[static_cast<std::size_t>(body)].reference;
    element::write(state, in.data() + k * element::body_numbers);
  }
  calm->evaluate(0.0, in.data(), nullptr, out.data());
  calm->jacobian(0.0, in.data(), nullptr, slope.data());
  std::vector<element::AtRest> rests;
  for (Index k = 0; k < n; ++k)
    rests.push_back(
        {out.segment<6>(6 * k),
         -Eigen::Map<const Eigen::Matrix<double, 6, 18>>(slope.data() + k * 6 * 18).leftCols<6>(),
         Matrix6::Zero()});
  return rests;
}

/// Linearised laws in the order of `for_each_law`: laws on points at the present places, laws of
/// pressure at the reference pose.
using Rests = std::vector<element::AtRest>;

Rests laws_at_rest(const system::System& s, const system::Workspace<double>& ws) {
  Rests rests;
  for (const system::ElementList& list : s.elements) {
    const Index w = list.laws->shape.width;
    VectorX x, v(w);
    if (!list.ports.empty() && !list.ports.front().points.empty()) {
      x.resize(w * std::ssize(list.ports));
      for (std::size_t k = 0; k < list.ports.size(); ++k)
        system::see_points<double>(ws, list.ports[k], x.data() + static_cast<Index>(k) * w,
                                   v.data());
    }
    for (element::AtRest& rest :
         follows_pose(*list.laws) ? in_reference_pose(s, list) : element::at_rest(*list.laws, x))
      rests.push_back(std::move(rest));
  }
  return rests;
}

/// Visits all laws: visit(list, port, linearised law).
template <class Visit>
void for_each_rest(const system::System& s, const Rests& rests, Visit&& visit) {
  auto rest = rests.begin();
  system::for_each_law(s, [&](const system::ElementList& list, std::size_t,
                              const system::PortData& port) { visit(list, port, *rest++); });
}

/// Rows and motions that transmit a vertical load between bodies, or to the ground.
struct Link {
  int a = -1, b = -1;        ///< bodies, -1: the ground
  double by_a = 0, by_b = 0; ///< rate of the row by their heave
};

std::vector<Link> vertical_links(const system::System& s, const system::Workspace<double>& ws,
                                 const Rests& rests) {
  std::vector<Link> links;
  const auto add = [&](const system::JointData& j, const joint::Vector12& gradient) {
    if ((j.A.body >= 0 && feels_heave(gradient, 0)) || (j.B.body >= 0 && feels_heave(gradient, 1)))
      links.push_back({j.A.body, j.B.body, gradient[2], gradient[8]});
  };
  for (const system::JointData& j : s.joints) {
    const joint::Geometry<double> g = system::joint_geometry<double>(j, ws.bodies);
    for (const joint::BasicRow& row : j.type->rows)
      add(j, joint::basic_row<double>(row, j.A, j.B, j.parameters, g).gradient);
  }
  const auto add_motion = [&](int motion) {
    add(system::joint_of(s, motion), system::motion_row<double>(s, ws, motion).gradient);
  };
  for (std::size_t k = 0; k < s.couplers.size(); ++k) {
    const auto stop =
        std::find_if(s.switches.begin(), s.switches.end(), [&](const system::SwitchData& element) {
          return static_cast<std::size_t>(element.coupler) == k;
        });
    const bool rope = stop != s.switches.end() && !std::isfinite(stop->lower) &&
                      s.motions[static_cast<std::size_t>(stop->motion)].motion.kind ==
                          joint::FreeMotion::Kind::stretches;
    if (stop == s.switches.end() || rope) // an open stop transmits no load
      for (const system::CouplerData::Term& term : s.couplers[k].terms)
        add_motion(term.motion);
  }
  for_each_rest(
      s, rests,
      [&](const system::ElementList&, const system::PortData& port, const element::AtRest& rest) {
        if (port.joint < 0)
          return;
        const MatrixX& stiffness = rest.stiffness;
        const system::JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
        if (port.motion >= 0 && stiffness(0) > 0.0)
          add_motion(port.motion);
        if (port.motion < 0 && !stiffness.isZero(0.0)) // a bushing
          for (int i = 0; i < 3; ++i)
            add(j, joint::SpanRow{i}
                       .at<double>(j.A, j.B, j.parameters,
                                   system::joint_geometry<double>(j, ws.bodies))
                       .gradient);
      });
  return links;
}

bool heave_is_free(const system::BodyData& b) {
  return std::find(b.active.begin(), b.active.begin() + b.n_translations, 2) !=
         b.active.begin() + b.n_translations;
}

const hydro::DatabaseBody* wet_body(const model::Scene& scene, int body) {
  const std::optional<std::string>& name = scene.bodies[static_cast<std::size_t>(body)].hydro;
  const hydro::DatabaseBody* found =
      name && scene.database ? hydro::find_body(*scene.database, *name) : nullptr;
  return found && found->hydrostatics ? found : nullptr;
}

std::string names(const system::System& s, const FloatingGroup& group) {
  std::vector<std::string> out;
  for (int body : group.bodies)
    out.push_back(in_quotes(s.bodies[static_cast<std::size_t>(body)].name));
  return (out.size() == 1 ? "body " : "bodies ") + joined(out);
}

void judge_balance(const system::System& s, const FloatingGroup& group, std::vector<Finding>& out) {
  if (!group.wet || !(group.weight > 0.0) || !(group.buoyancy > 0.0))
    return;
  const double ratio = group.weight / group.buoyancy;
  const bool slip = ratio < 1.0 / unit_slip || ratio > unit_slip;
  const std::string unit =
      slip ? "; a mass is in kg: " + std::string(ratio < 1.0 ? "tonnes" : "a factor 1000") + "?"
           : "";
  if (group.held) {
    if (ratio < lightest || ratio > heaviest)
      out.push_back({true, describe(s, group) + "; the weight is " + rounded_text(ratio, 4) +
                               " of the buoyancy" + unit});
    return;
  }
  const double part = group.imbalance();
  if (std::abs(part) <= (group.stiffness > 0.0 ? worth_saying : 1e-6))
    return;
  std::string text = describe(s, group) + "; the balance is " + percent(part) + ", ";
  const double up = group.buoyancy + group.load - group.weight;
  if (group.stiffness > 0.0)
    text += "so it rests " + rounded_text(std::abs(up) / (group.stiffness + group.mooring), 4) +
            " m " + (up > 0.0 ? "above" : "below") + " the pose of the database";
  else
    text += up > 0.0 ? "and nothing restores its heave: it rises"
                     : "and nothing restores its heave: it sinks";
  out.push_back({std::abs(part) > (group.stiffness > 0.0 ? too_much : 1e-3), text + unit});
}

/// Judges each wet body of a group: a weight far from its buoyancy suggests a wrong unit.
void judge_bodies(const model::Scene& scene, const system::System& s, const FloatingGroup& group,
                  std::vector<Finding>& out) {
  for (int body : group.bodies) {
    const hydro::DatabaseBody* wet = wet_body(scene, body);
    const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
    if (!wet || b.n_active == 0)
      continue;
    const double displaced = scene.database->rho * wet->hydrostatics->displaced_volume;
    if (!(displaced > 0.0))
      continue;
    const double ratio = b.mass / displaced;
    if (group.bodies.size() > 1 && b.mass > 0.0 && (ratio < 1.0 / unit_slip || ratio > unit_slip))
      out.push_back({true, "body " + in_quotes(b.name) + ": mass " + rounded_text(b.mass, 4) +
                               " kg is " + rounded_text(ratio, 4) + " of the " +
                               rounded_text(displaced, 4) +
                               " kg of water that it displaces; is it in kg?"});
    const double size = std::cbrt(wet->hydrostatics->displaced_volume);
    for (int k = b.n_translations; k < b.n_active && b.mass > 0.0; ++k) {
      const int axis = b.active[static_cast<std::size_t>(k)] - 3;
      const double radius = std::sqrt(b.inertia(axis, axis) / b.mass);
      if (radius < thinnest * size || radius > widest * size)
        out.push_back({true, "body " + in_quotes(b.name) + ": inertia " +
                                 rounded_text(b.inertia(axis, axis), 4) + " kg m2 about " +
                                 "xyz"[axis] + " and mass " + rounded_text(b.mass, 4) +
                                 " kg give a radius of gyration of " + rounded_text(radius, 4) +
                                 " m for a body that displaces " +
                                 rounded_text(wet->hydrostatics->displaced_volume, 4) +
                                 " m3; are both in kg?"});
    }
  }
}

/// Judges a single free-floating body that is unstable in roll or pitch: its centre of gravity is
/// too high.
void judge_stability(const system::System& s, const Rests& rests, const FloatingGroup& group,
                     std::vector<Finding>& out) {
  if (group.held || !group.wet || group.bodies.size() != 1 || !(std::abs(group.imbalance()) < 0.5))
    return;
  const int body = group.bodies.front();
  const system::BodyData& b = s.bodies[static_cast<std::size_t>(body)];
  const auto at = [&](const system::JointData& j) {
    return !j.hidden && !j.type->rows.empty() && (j.A.body == body || j.B.body == body);
  };
  if (std::any_of(s.joints.begin(), s.joints.end(), at))
    return;
  Matrix6 K = Matrix6::Zero();
  for_each_rest(
      s, rests,
      [&](const system::ElementList&, const system::PortData& port, const element::AtRest& rest) {
        if (port.body == body)
          K += rest.stiffness;
      });
  for (int k = b.n_translations; k < b.n_active; ++k) {
    const int c = b.active[static_cast<std::size_t>(k)];
    if (c < 5 && K(c, c) < 0.0)
      out.push_back(
          {true, "body " + in_quotes(b.name) + " capsizes: its " + (c == 3 ? "roll" : "pitch") +
                     " stiffness is " + rounded_text(K(c, c), 4) +
                     " N m about the centre of gravity at z = " + rounded_text(b.reference[2], 4) +
                     " m; is that too high?"});
  }
}

std::vector<FloatingGroup> find_groups(const system::System& s, const system::Workspace<double>& ws,
                                       const Rests& rests) {
  const std::vector<Link> links = vertical_links(s, ws, rests);
  std::vector<int> of(s.bodies.size());
  std::iota(of.begin(), of.end(), 0);
  for (const Link& link : links)
    if (link.a >= 0 && link.b >= 0 && link.by_a != 0.0 && link.by_b != 0.0) {
      const int from = of[static_cast<std::size_t>(link.b)],
                to = of[static_cast<std::size_t>(link.a)];
      std::replace(of.begin(), of.end(), from, to);
    }
  std::vector<FloatingGroup> groups;
  std::vector<int> index(s.bodies.size(), -1);
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    int& k = index[static_cast<std::size_t>(of[i])];
    if (k < 0) {
      k = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    FloatingGroup& group = groups[static_cast<std::size_t>(k)];
    group.bodies.push_back(static_cast<int>(i));
    group.weight += s.bodies[i].mass * s.gravity;
    group.held = group.held || !heave_is_free(s.bodies[i]);
  }
  const auto group_of = [&](int body) -> FloatingGroup& {
    return groups[static_cast<std::size_t>(
        index[static_cast<std::size_t>(of[static_cast<std::size_t>(body)])])];
  };
  for_each_rest(s, rests,
                [&](const system::ElementList& list, const system::PortData& port,
                    const element::AtRest& rest) {
                  for (std::size_t i = 0; i < port.points.size(); ++i)
                    if (const int body = port.points[i].body; body >= 0) {
                      const auto z = static_cast<Index>(3 * i + 2);
                      FloatingGroup& group = group_of(body);
                      (list.laws->buoyant ? group.buoyancy : group.load) += rest.load[z];
                      group.mooring += rest.stiffness(z, z);
                    }
                  if (port.body < 0)
                    return;
                  FloatingGroup& group = group_of(port.body);
                  const bool water = list.laws->buoyant;
                  group.wet = group.wet || water;
                  (water ? group.buoyancy : group.load) += rest.load[2];
                  (water ? group.stiffness : group.mooring) += rest.stiffness(2, 2);
                });
  for (const Link& link : links) { // checks whether the row lets the whole group heave
    const double rate = (link.a >= 0 ? link.by_a : 0.0) + (link.b >= 0 ? link.by_b : 0.0);
    if (std::abs(rate) > 1e-6)
      group_of(link.a >= 0 && link.by_a != 0.0 ? link.a : link.b).held = true;
  }
  for (FloatingGroup& group : groups) // a taut mooring; a soft one moves with the body
    group.held = group.held || group.mooring > std::max(group.stiffness, 0.0);
  return groups;
}

} // namespace

double FloatingGroup::imbalance() const {
  const double size = std::max(weight, buoyancy);
  return size > 0.0 ? (buoyancy + load - weight) / size : 0.0;
}

std::vector<FloatingGroup> floating_groups(const system::System& s) {
  const system::Workspace<double> ws(s);
  return find_groups(s, ws, laws_at_rest(s, ws));
}

std::string describe(const system::System& s, const FloatingGroup& group) {
  std::string text = names(s, group) + ": weight " + force_text(group.weight) + ", buoyancy " +
                     force_text(group.buoyancy);
  if (group.load != 0.0)
    text += ", other constant loads " + force_text(group.load) + " upwards";
  return text + (group.held ? ", held vertically by more than buoyancy" : ", floats freely");
}

std::vector<Finding> look_at_bodies(const model::Scene& scene, const system::System& s) {
  std::vector<Finding> out;
  const system::Workspace<double> ws(s);
  const Rests rests = laws_at_rest(s, ws);
  for (const FloatingGroup& group : find_groups(s, ws, rests)) {
    judge_balance(s, group, out);
    judge_bodies(scene, s, group, out);
    judge_stability(s, rests, group, out);
  }
  return out;
}

} // namespace hydrodae::sanity
