/// Loads on the bodies: each list of forces of the case becomes a list of laws, with the ports that
/// their members name.

#include <algorithm>
#include <cmath>
#include <map>

#include "hydrodae/build/initial_pose.h"
#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/element/laws.h"
#include "hydrodae/hydro/coverage.h"
#include "hydrodae/math/rotation.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/water/buoyancy.h"
#include "hydrodae/water/hydrostatics.h"

namespace hydrodae::build {

namespace {

using element::Port;

const joint::JointType spring_type = {"spring", {}, {joint::stretches()}, false};
const joint::JointType bushing_type = {"bushing", {}, {}, false};

/// Joins markers by a hidden joint without rows.
void join_markers(const std::string& name, const joint::JointType& type, joint::Marker A,
                  joint::Marker B, system::System& s, system::PortData& port) {
  system::JointData j;
  j.name = name;
  j.type = &type;
  j.A = std::move(A);
  j.B = std::move(B);
  j.hidden = true;
  port.joint = static_cast<int>(s.joints.size());
  const system::JointData& added = add_joint(s, std::move(j));
  port.motion = type.motions.empty() ? -1 : added.first_motion;
}

/// Checks that the program has set its law.
template <class F> void check_given(const F& force) {
  if constexpr (requires { force.function; })
    if (!force.function)
      throw ModelError("force." + force.name,
                       "force " + in_quotes(force.name) +
                           " is a Python function, which nobody "
                           "gave; run the case as hydrodae.run(case, forces={\"" +
                           force.name + "\": function})");
  if constexpr (std::is_base_of_v<element::LibraryLaw, F>)
    if (!force.found)
      throw ModelError("force." + force.name,
                       "force " + in_quotes(force.name) + " is the law " + in_quotes(force.law) +
                           " of a shared library, which nobody gave: hydrodae-solve --library "
                           "FILE, or hydrodae.Case.read(path, libraries=[FILE])");
}

template <class F>
system::PortData make_port(const model::Scene& scene, const F& force, system::System& s) {
  system::PortData port;
  port.component = force.name;
  if constexpr (F::port == Port::on_body) {
    port.body = body_index(scene, force.body);
  } else if constexpr (F::port == Port::along_joint) {
    port.motion = joint_motion(s, force.joint, force.coordinate);
    port.joint = s.motions[static_cast<std::size_t>(port.motion)].joint;
  } else if constexpr (F::port == Port::along_distance) {
    const Matrix3 axes = Matrix3::Identity();
    join_markers(force.name, spring_type, make_marker(scene, force.body_a, force.point_a, axes),
                 make_marker(scene, force.body_b, force.point_b, axes), s, port);
  } else if constexpr (F::port == Port::points) {
    for (const auto& [body, point] : force.ends())
      port.points.push_back(make_marker(scene, body, point, Matrix3::Identity()));
  } else {
    const Matrix3 axes = marker_axes(force.axis, force.axis_x);
    join_markers(force.name, bushing_type, make_marker(scene, force.body_a, force.point, axes),
                 make_marker(scene, force.body_b, force.point, axes), s, port);
  }
  if constexpr (requires { force.delay; })
    if (force.delay > 0.0) {
      port.delay = static_cast<int>(s.delays.size());
      s.delays.push_back({port.motion, force.delay});
    }
  return port;
}

/// Completes friction by values of the scene.
template <class F> void complete(F& force, const system::PortData& port, const system::System& s) {
  if constexpr (std::is_base_of_v<element::FrictionLoads, F>) {
    force.turns = s.motions[static_cast<std::size_t>(port.motion)].motion.is_angle();
    force.weight = INFINITY;
    system::for_each_body(s, port, [&](int body) {
      if (body < 0 || s.bodies[static_cast<std::size_t>(body)].n_active == 0)
        return;
      const double g = s.gravity > 0.0 ? s.gravity : 9.81; // only the size matters
      force.weight = std::min(force.weight, g * s.bodies[static_cast<std::size_t>(body)].mass);
    });
    if (std::isinf(force.weight))
      force.weight = 1.0;
  }
}

/// Adds switches for the sticking laws of the last list.
void add_sticking(system::System& s) {
  const system::ElementList& list = s.elements.back();
  for (std::size_t k = 0; k < list.laws->sticks.size(); ++k) {
    system::SwitchData friction;
    friction.kind = system::SwitchData::Kind::friction;
    friction.motion = list.ports[k].motion;
    friction.static_load = list.laws->sticks[k].hold;
    friction.kinetic_load = list.laws->sticks[k].slide;
    friction.list = static_cast<int>(s.elements.size()) - 1;
    friction.law = static_cast<int>(k);
    add_switch(list.laws->names[k], friction, s);
  }
}

/// Splits forces of one type into lists of equal shape: their numbers of points or states may
/// differ.
template <class F> std::vector<std::vector<F>> alike(const std::vector<F>& forces) {
  if constexpr (requires(const F& f) { f.shape(); }) {
    std::map<std::size_t, std::vector<F>> by_number;
    for (const F& force : forces)
      by_number[force.shape()].push_back(force);
    std::vector<std::vector<F>> out;
    for (auto& [n, list] : by_number)
      out.push_back(std::move(list));
    return out;
  } else {
    return {forces};
  }
}

template <class F>
std::shared_ptr<const element::Elements> make_laws(const element::Surroundings& around,
                                                   const std::vector<F>& forces) {
  if constexpr (requires { F::list(forces, around); })
    return F::list(forces, around);
  else if constexpr (requires { F::list(forces); })
    return F::list(forces);
  else
    return std::make_shared<const element::Laws<F>>(forces);
}

template <class F>
void add_list(const model::Scene& scene, const element::Surroundings& around,
              const std::vector<F>& forces, system::System& s) {
  system::ElementList list;
  std::vector<F> completed = forces;
  for (F& force : completed) {
    list.ports.push_back(make_port(scene, force, s));
    complete(force, list.ports.back(), s);
    if constexpr (std::is_base_of_v<element::FrictionLoads, F>)
      if (force.pressed())
        list.ports.back().bearing = force.bearing();
  }
  list.laws = make_laws(around, completed);
  s.elements.push_back(std::move(list));
  add_sticking(s);
}

/// Buoyancy and linear hydrostatics in the axes of the database: force (0, 0, rho g V), moment (r_B
/// - r_G) x (0, 0, rho g V), minus C_hs xi.
element::LinearWrench hydrostatic_wrench(const hydro::Database& db,
                                         const hydro::DatabaseBody& entry) {
  const hydro::Hydrostatics& h = *entry.hydrostatics;
  const Vector3 lift(0.0, 0.0, db.rho * db.gravity * h.displaced_volume);
  element::LinearWrench law;
  law.constant << lift, (h.center_of_buoyancy - entry.reference_point).cross(lift);
  law.stiffness = h.stiffness;
  return law;
}

/// Turns the wrench by the mean yaw T: W = T (W0 - C_hs T^T xi), with xi relative to the reference
/// pose turned by T.
void turn(element::LinearWrench& law, system::PortData& port, const system::HydroBody& hb) {
  Matrix6 T = Matrix6::Zero();
  T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() = rotation_about_axis<double>(2, hb.yaw);
  law.constant = T * law.constant;
  law.stiffness = T * law.stiffness * T.transpose();
  port.turn << std::cos(0.5 * hb.yaw), 0.0, 0.0, std::sin(0.5 * hb.yaw);
}

/// Adds buoyancy of dry bodies with a given displaced volume.
void add_buoyancy(const model::Scene& scene, system::System& s) {
  const model::Water water = model::water(scene);
  std::vector<water::Buoyancy> forces;
  system::ElementList list;
  for (const model::Body& body : scene.bodies) {
    if (body.volume == 0.0)
      continue;
    forces.push_back({body.name, water.density * water.gravity * body.volume,
                      body.is_point() ? std::cbrt(0.75 * body.volume / pi) : 0.0});
    system::PortData port;
    port.component = water::Buoyancy::type;
    port.points.push_back(make_marker(scene, body.name,
                                      body.center_of_buoyancy.value_or(body.center_of_gravity),
                                      Matrix3::Identity()));
    list.ports.push_back(std::move(port));
  }
  if (forces.empty())
    return;
  list.laws = std::make_shared<const element::Laws<water::Buoyancy>>(forces);
  s.elements.push_back(std::move(list));
}

} // namespace

void add_elements(const model::Scene& scene, const Sea& sea, system::System& s) {
  const model::Water water = model::water(scene);
  const element::Surroundings around{water.gravity, water.density, sea.field,
                                     scene.seabed ? scene.seabed->surface() : nullptr};
  const auto add = [&](const auto& forces) {
    for (const auto& force : forces)
      check_given(force);
    if (!forces.empty())
      for (const auto& list : alike(forces))
        add_list(scene, around, list, s);
  };
  std::apply([&](const auto&... list) { (add(list), ...); }, scene.forces->lists);
  add_buoyancy(scene, s);
}

void start_laws(system::System& s) {
  const system::Regime start(s);
  system::Workspace<double> ws(start);
  bool known = false;
  VectorX y;
  for (system::ElementList& list : s.elements) {
    const Port port = list.laws->shape.port;
    const bool starts = port == Port::points || port == Port::along_coordinates;
    if (!starts || list.laws->shape.n_states == 0)
      continue;
    if (!known) {
      y = system::initial_state(start);
      system::unpack<double>(s, y.data(), y.data(), ws.bodies);
      known = true;
    }
    system::ElementScratch<double>& scratch = ws.elements[system::index_of(start, list)];
    system::gather<double>(start, list, ws, y.data(), scratch);
    if (auto started = list.laws->started(scratch.in.data()))
      list.laws = std::move(started);
  }
  if (known)
    system::number(s);
}

void set_hydrostatics(const model::Scene& scene, system::System& s) {
  std::vector<water::Hydrostatics> forces;
  const auto at_yaw = std::make_shared<water::YawHydrostatics>();
  const bool follow = s.hydro.axes == system::HydroAxes::yaw;
  std::vector<system::PortData> ports;
  for (const system::HydroBody& hb : s.hydro.bodies) {
    const auto body = static_cast<std::size_t>(hb.body);
    const hydro::DatabaseBody* entry = hydro::find_body(*scene.database, *scene.bodies[body].hydro);
    if (!entry->hydrostatics || scene.bodies[body].hydrostatics_by_mesh() ||
        s.bodies[body].is_mode())
      continue;
    system::PortData port;
    port.component = water::Hydrostatics::type;
    port.body = hb.body;
    element::LinearWrench law = hydrostatic_wrench(*scene.database, *entry);
    if (follow)
      at_yaw->add(s.bodies[body].name, law, s.bodies[body].reference[2]);
    else if (hb.turned)
      turn(law, port, hb);
    forces.push_back({s.bodies[body].name, law});
    ports.push_back(port);
  }
  const auto has = [](const system::ElementList& list) {
    return list.laws->type == water::Hydrostatics::type && !list.laws->shape.in_water();
  };
  auto list = std::find_if(s.elements.begin(), s.elements.end(), has);
  if (forces.empty())
    return;
  if (list == s.elements.end())
    list = s.elements.insert(s.elements.end(), system::ElementList());
  if (follow)
    list->laws = at_yaw;
  else
    list->laws = std::make_shared<const element::Laws<water::Hydrostatics>>(forces);
  list->ports = ports;
  system::follow_rotations(s);
}

} // namespace hydrodae::build
