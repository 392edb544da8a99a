/// Of the observer: loads, stored energy and own channels of the laws.

#include <cmath>

#include "hydrodae/system/elements.h"
#include "hydrodae/system/observer.h"

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
    if (laws.absorbs)
      out.push_back({head + "power_absorbed", 1, "W", "-",
                     "Power that it takes out of the motion: minus load times rate."});
  } else if (laws.shape.port == element::Port::between) {
    const JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
    const std::string frame = "marker A of " + j.name;
    out.push_back({head + "force", 3, "N", frame, "On body B at its point."});
    out.push_back({head + "moment", 3, "N m", frame, "On body B about its point."});
    out.push_back({head + "displacement", 3, "m", frame, "Place of B's point seen from A's."});
    out.push_back({head + "rotation", 3, "rad", frame, "Rotation vector of B against A."});
  }
}

} // namespace

std::vector<Channel> element_channels(const System& s) {
  std::vector<Channel> out;
  for_each_law(s, [&](const ElementList& list, std::size_t k, const PortData& port) {
    const element::Elements& laws = *list.laws;
    const std::string head = "forces/" + laws.names[k] + "/";
    const bool angle =
        port.motion >= 0 && s.motions[static_cast<std::size_t>(port.motion)].motion.is_angle();
    add_port_channels(s, laws, port, head, out);
    const auto n = static_cast<std::size_t>(laws.shape.n_states);
    for (std::size_t z = 0; z < n; ++z) {
      const element::Unknown& u = laws.unknowns[k * n + z];
      out.push_back(
          {head + u.name, 1, element::unit_along(u.unit, angle), "-", "State of the force."});
    }
    for (const element::Quantity& q : laws.channels)
      out.push_back({head + std::string(q.name), 1, element::unit_along(q.unit, angle), "-",
                     std::string(q.doc)});
  });
  return out;
}

/// The loads of a list on its bodies, in the order in which the constructor planned them.
void Observer::observe_ports(const ElementList& list, const ElementScratch<double>& scratch) {
  const element::Shape& shape = list.laws->shape;
  const double* load = scratch.out.data();
  if (element::is_on_body(shape.port)) {
    list.laws->report(ws_.time, scratch.in.data(), load, element_values_.data());
    load = element_values_.data();
    for (const PortData& port : list.ports)
      for (std::size_t part = 0; part <= list.laws->parts.size(); ++part, load += 6) {
        const Eigen::Map<const Vector6> own(load);
        add_load(shape.in_water() ? to_world(ws_.bodies[static_cast<std::size_t>(port.body)], own)
                                  : Vector6(own));
      }
    return;
  }
  const joint::Vec12<double>* rows = scratch.rows.data();
  for (const PortData& port : list.ports) {
    joint::Vector12 sum = joint::Vector12::Zero();
    for (int i = 0; i < shape.width; ++i)
      sum += load[i] * *rows++;
    const JointData& j = s_.joints[static_cast<std::size_t>(port.joint)];
    if (j.A.body >= 0)
      add_load(to_world(ws_.bodies[static_cast<std::size_t>(j.A.body)], sum.head<6>()));
    if (j.B.body >= 0)
      add_load(to_world(ws_.bodies[static_cast<std::size_t>(j.B.body)], sum.tail<6>()));
    load += shape.n_out();
  }
}

void Observer::observe_elements(const double* y) {
  double* own = out_.elements.data();
  for (std::size_t l = 0; l < s_.elements.size(); ++l) {
    const ElementList& list = s_.elements[l];
    const element::Elements& laws = *list.laws;
    ElementScratch<double>& scratch = ws_.elements[l];
    gather<double>(s_, list, ws_, y, scratch);
    const double *in = scratch.in.data(), *load = scratch.out.data();
    laws.evaluate(ws_.time, in, list.signals.data(), scratch.out.data());
    observe_ports(list, scratch);
    double *energy = element_values_.data(), *declared = energy + laws.size();
    laws.energy(in, list.signals.data(), energy);
    laws.observe(ws_.time, in, list.signals.data(), load, declared);
    const joint::Vec12<double>* rows = scratch.rows.data();
    for (const PortData& port : list.ports) {
      if (port.delay < 0) // a delayed spring gives back another energy than it took
        out_.potential += *energy;
      ++energy;
      if (element::is_along(laws.shape.port)) {
        *own++ = *load;
        if (laws.absorbs)
          *own++ = -*load * rows->dot(joint_velocity<double>(
                                s_.joints[static_cast<std::size_t>(port.joint)], ws_.bodies));
      } else if (laws.shape.port == element::Port::between) {
        own = std::copy(load, load + 6, own);
        own = std::copy(in, in + 6, own);
      }
      own = std::copy_n(in + laws.shape.n_in() - laws.shape.n_states, laws.shape.n_states, own);
      own = std::copy_n(declared, laws.channels.size(), own);
      declared += laws.channels.size();
      rows += element::is_on_body(laws.shape.port) ? 0 : laws.shape.width;
      in += laws.shape.n_in();
      load += laws.shape.n_out();
    }
  }
}

} // namespace hydrodae::system
