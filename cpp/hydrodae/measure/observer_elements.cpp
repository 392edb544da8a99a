/// Part of the observer: loads, stored energy and channels of the laws.

#include "hydrodae/measure/observer.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::measure {

using namespace system;

namespace {

/// Load of dry friction that sticks [N or N m]; its law returns zero then.
double holding_load(const Regime& s, const ElementList& list, std::size_t law, const double* y) {
  for (const SwitchData& friction : s.switches)
    if (s.mode(friction) == SwitchData::State::stick &&
        static_cast<std::size_t>(friction.law) == law &&
        static_cast<std::size_t>(friction.list) == index_of(s, list))
      return y[s.lambda(s.couplers[static_cast<std::size_t>(friction.coupler)])];
  return 0.0;
}

} // namespace

/// Adds the loads of a list on its bodies, in the order planned by the constructor.
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
    if (shape.port == element::Port::points) {
      for (std::size_t i = 0; i < port.points.size(); ++i) {
        const int body = port.points[i].body;
        if (body < 0 || !is_first_of_its_body(port, i))
          continue;
        const BodyState<double>& b = ws_.bodies[static_cast<std::size_t>(body)];
        Vector6 sum = Vector6::Zero(); // sum over all its points on the body
        for (std::size_t k = i; k < port.points.size(); ++k)
          if (port.points[k].body == body)
            sum += load_at<double>(b, port.points[k], load + 3 * k);
        add_load(to_world(b, sum));
      }
    } else if (shape.port == element::Port::along_coordinates) {
      observe_motions(port, load, rows);
      rows += shape.width;
    } else {
      joint::Vector12 sum = joint::Vector12::Zero();
      for (int i = 0; i < shape.width; ++i)
        sum += load[i] * *rows++;
      const JointData& j = s_.joints[static_cast<std::size_t>(port.joint)];
      if (j.A.body >= 0)
        add_load(to_world(ws_.bodies[static_cast<std::size_t>(j.A.body)], sum.head<6>()));
      if (j.B.body >= 0)
        add_load(to_world(ws_.bodies[static_cast<std::size_t>(j.B.body)], sum.tail<6>()));
    }
    load += shape.n_out();
  }
}

/// Adds the loads of a law along several motions, summed for each body.
void Observer::observe_motions(const PortData& port, const double* load,
                               const joint::Vec12<double>* rows) {
  for (const int body : port.bodies) {
    if (body < 0)
      continue;
    Vector6 sum = Vector6::Zero();
    for (std::size_t i = 0; i < port.motions.size(); ++i) {
      const JointData& j = joint_of(s_, port.motions[i]);
      if (j.A.body == body)
        sum += load[i] * rows[i].head<6>();
      if (j.B.body == body)
        sum += load[i] * rows[i].tail<6>();
    }
    add_load(to_world(ws_.bodies[static_cast<std::size_t>(body)], sum));
  }
}

/// Absorbed power -load . v; a delayed law reads other rates than those of its work.
double Observer::power_absorbed(const element::Shape& shape, const PortData& port, const double* in,
                                const double* load, const joint::Vec12<double>* rows) const {
  if (element::is_along(shape.port))
    return -*load * rows->dot(joint_velocity<double>(
                        s_.joints[static_cast<std::size_t>(port.joint)], ws_.bodies));
  double power = 0.0;
  for (int i = 0; i < shape.width; ++i)
    power -= load[i] * in[shape.width + i];
  return power;
}

const element::Elements& Observer::observe_loads(const ElementList& list, const double* y) {
  ElementScratch<double>& scratch = ws_.elements[index_of(s_, list)];
  gather<double>(s_, list, ws_, y, scratch);
  list.laws->evaluate(ws_.time, scratch.in.data(), s_.held(list, ws_.time, scratch.held),
                      scratch.out.data());
  observe_ports(list, scratch);
  return *list.laws;
}

void Observer::observe(const ElementList& list, const double* y) {
  const element::Elements& laws = observe_loads(list, y);
  ElementScratch<double>& scratch = ws_.elements[index_of(s_, list)];
  const double *in = scratch.in.data(), *load = scratch.out.data();
  const double* held = s_.held(list, ws_.time, scratch.held);
  const std::size_t values = laws.channel_size();
  double *energy = element_values_.data(), *declared = energy + laws.size();
  laws.energy(in, held, energy);
  laws.observe(ws_.time, in, held, load, declared);
  const joint::Vec12<double>* rows = scratch.rows.data();
  for (std::size_t law = 0; law < list.ports.size(); ++law) {
    const PortData& port = list.ports[law];
    if (port.delay < 0) // a delayed spring returns another energy than it takes
      out_.potential += *energy;
    ++energy;
    if (element::is_along(laws.shape.port)) {
      *own_++ = *load + holding_load(s_, list, law, y);
    } else if (laws.shape.port == element::Port::between) {
      own_ = std::copy(load, load + 6, own_);
      own_ = std::copy(in, in + 6, own_);
    }
    if (laws.absorbs)
      *own_++ = power_absorbed(laws.shape, port, in, load, rows);
    if (laws.tells_unknowns)
      own_ = std::copy_n(in + laws.shape.n_in() - laws.shape.n_states, laws.shape.n_states, own_);
    own_ = std::copy_n(declared, values, own_);
    declared += values;
    rows += element::has_rows(laws.shape.port) ? laws.shape.width : 0;
    in += laws.shape.n_in();
    load += laws.shape.n_out();
  }
}

} // namespace hydrodae::measure
