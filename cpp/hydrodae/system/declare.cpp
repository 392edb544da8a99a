#include "hydrodae/system/declare.h"

#include <cmath>

#include "hydrodae/system/mechanisms.h"

namespace hydrodae::system {

namespace {

void add_port_channels(const System& s, const element::Elements& laws, const PortData& port,
                       const std::string& head, std::vector<Channel>& out) {
  if (element::is_along(laws.shape.port)) {
    const bool angle = s.motions[static_cast<std::size_t>(port.motion)].motion.is_angle();
    const bool distance = laws.shape.port == element::Port::along_distance;
    out.push_back({head + (angle ? "torque" : "force"), 1, angle ? "N m" : "N", "-",
                   distance ? "Load along the distance, positive pushes the points apart."
                            : "Load on the coordinate of the joint, on body B."});
  } else if (laws.shape.port == element::Port::between) {
    const JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
    const std::string frame = "marker A of " + j.name;
    out.push_back({head + "force", 3, "N", frame, "On body B at its point."});
    out.push_back({head + "moment", 3, "N m", frame, "On body B about its point."});
    out.push_back({head + "displacement", 3, "m", frame, "Place of B's point seen from A's."});
    out.push_back({head + "rotation", 3, "rad", frame, "Rotation vector of B against A."});
  }
  if (laws.absorbs)
    out.push_back({head + "power_absorbed", 1, "W", "-",
                   "Power that it takes out of the motion: minus load times rate."});
}

/// Channels of one law: inputs at its port, its states, and the channels that it declares.
void add_channels(const System& s, const element::Elements& laws, std::size_t law,
                  const PortData& port, std::vector<Channel>& out) {
  const std::string head = laws.path(law, "") + "/";
  const bool angle =
      port.motion >= 0 && s.motions[static_cast<std::size_t>(port.motion)].motion.is_angle();
  add_port_channels(s, laws, port, head, out);
  const auto n = static_cast<std::size_t>(laws.shape.n_states);
  for (std::size_t z = 0; z < n && laws.tells_unknowns; ++z) {
    const element::Unknown& u = laws.unknowns[law * n + z];
    out.push_back(
        {head + u.name, 1, element::unit_along(u.unit, angle), "-", "State of the force."});
  }
  for (const element::Quantity& q : laws.channels)
    out.push_back({laws.path(law, q.name), q.width, element::unit_along(q.unit, angle), "-",
                   std::string(q.doc)});
}

/// Size of each velocity of U.
VectorX velocities(const System& s, const HydroData& h) {
  VectorX out(h.n_moving);
  for (Index k = 0; k < out.size(); ++k) {
    const HydroData::Coordinate& u = h.coordinates[k];
    const BodyData& b = s.bodies[h.bodies[u.hydro_body].body];
    out[k] = b.length_scale / b.time_scale / (u.component < 3 ? 1.0 : b.lever);
  }
  return out;
}

} // namespace

void declare(const System& s, const ElementList& list, Declaration& out) {
  const element::Elements& laws = *list.laws;
  const auto n = static_cast<std::ptrdiff_t>(laws.shape.n_states);
  for (std::size_t k = 0; k < list.ports.size(); ++k) {
    const PortData& port = list.ports[k];
    const auto load = [&](const std::string& component, int body, element::Work work) {
      if (body >= 0)
        out.loads.push_back({component, body, work});
    };
    int last = -1; // last body that moves, by number
    std::size_t point = 0;
    for_each_body(s, port, [&](int body) {
      if (laws.shape.port != element::Port::points || is_first_of_its_body(port, point++))
        load(port.component, body, laws.work);
      out.pairs.push_back({last, body});
      if (body >= 0 && s.bodies[static_cast<std::size_t>(body)].n_active > 0)
        last = body;
    });
    for (std::string_view part : laws.parts)
      load(std::string(part), port.body, element::Work::part);
    add_channels(s, laws, k, port, out.channels);
    if (n == 0)
      continue;
    const BodyData* body = moving_body(s, port);
    const auto first = laws.unknowns.begin() + n * static_cast<std::ptrdiff_t>(k);
    out.states.push_back({"force " + laws.names[k],
                          laws.path(k, ""),
                          list.z0 + n * static_cast<Index>(k),
                          body ? static_cast<int>(body - s.bodies.data()) : -1,
                          {first, first + n}});
  }
}

void declare(const System& s, const HydroData& h, Declaration& out) {
  int last = -1; // last body that moves, by number
  for (const HydroBody& hb : h.bodies) {
    out.loads.push_back({"added_mass_inf", hb.body, element::Work::fluid});
    if (h.radiates())
      out.loads.push_back({"radiation", hb.body, element::Work::spent});
    if (s.bodies[static_cast<std::size_t>(hb.body)].n_active == 0)
      continue;
    out.pairs.push_back({last, hb.body});
    last = hb.body;
  }
  if (h.n_states() > 0)
    out.states.push_back(
        {"radiation memory", "radiation memory", h.z0, last,
         h.visit([&](const auto& rung) { return rung.unknowns(velocities(s, h)); })});
}

Declaration declare(const System& s) {
  Declaration out;
  for_each_list(s, [&](const auto& list) { declare(s, list, out); });
  return out;
}

} // namespace hydrodae::system
