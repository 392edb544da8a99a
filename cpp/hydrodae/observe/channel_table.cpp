#include "hydrodae/observe/channel_table.h"

#include <algorithm>
#include <set>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/declare.h"

namespace hydrodae::observe {

using namespace system;

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Adds the axes and the origin of a marker in the reference pose to a channel.
void describe_marker(Channel& channel, const System& s, const joint::Marker& marker) {
  const Vector3 origin =
      marker.point + (marker.body < 0 ? Vector3(0, 0, 0) : s.bodies[at(marker.body)].reference);
  channel.vectors = {{"axis_x", marker.axes.col(0)},
                     {"axis_y", marker.axes.col(1)},
                     {"axis_z", marker.axes.col(2)},
                     {"origin", origin}};
}

void add_mode(ChannelTable& table, const BodyData& b, std::size_t i) {
  const std::string head = "modes/" + b.name + "/";
  table.add(head + "amplitude", "m", "-", "Of the mode, in the scale of its shape.",
            [i, rest = b.reference[0]](const Instant& now) { return now.bodies[i].r[0] - rest; });
  table.add(head + "rate", "m/s", "-", "Of the amplitude.",
            [i](const Instant& now) { return now.bodies[i].v[0]; });
  table.add(head + "acceleration", "m/s2", "-", "Of the amplitude.",
            [i](const Instant& now) { return now.bodies[i].v_dot[0]; });
}

/// Loads that the fit of the radiation does not give on a body, in words; "" where it gives all.
std::string uncovered_note(const System& s, const BodyData& b) {
  std::string note;
  for (const HydroBody& hb : s.hydro.bodies)
    if (s.bodies[at(hb.body)].name == b.name)
      for (const std::string& label : s.hydro.uncovered)
        note +=
            (note.empty() ? " Without the hydrodynamic loads that the fit does not give: " : ", ") +
            label;
  return note;
}

void add_body(ChannelTable& table, const System& s, const BodyData& b, std::size_t i) {
  const std::string head = "bodies/" + b.name + "/";
  table.add(head + "position", "m", "world", "Centre of gravity.",
            [i](const Instant& now) { return now.bodies[i].r; });
  table.add(head + "orientation", "-", "world",
            "Unit quaternion (w, x, y, z) of the rotation from the reference pose.",
            [i](const Instant& now) {
              const Eigen::Quaterniond q(now.bodies[i].R);
              return Vector4(q.w(), q.x(), q.y(), q.z());
            });
  table.add(head + "rotation", "rad", "world", "Rotation vector from the reference pose.",
            [i](const Instant& now) {
              const measure::Observer& observer = now.measure.observer();
              return Vector3(observer.displacement(static_cast<int>(i), now.y).tail<3>());
            });
  if (b.n_active > 0) {
    table.add(head + "velocity", "m/s", "world", "Of the centre of gravity.",
              [i](const Instant& now) { return now.bodies[i].v; });
    table.add(head + "angular_velocity", "rad/s", "world", "Angular velocity.",
              [i](const Instant& now) { return Vector3(now.bodies[i].R * now.bodies[i].w); });
    table.add(head + "acceleration", "m/s2", "world", "Of the centre of gravity.",
              [i](const Instant& now) { return now.bodies[i].v_dot; });
    // w' in body axes: the part w x w of the turning axes vanishes.
    table.add(head + "angular_acceleration", "rad/s2", "world", "Rate of the angular velocity.",
              [i](const Instant& now) { return Vector3(now.bodies[i].R * now.bodies[i].w_dot); });
  }
  if (b.n_active < 6) {
    const std::string note = uncovered_note(s, b);
    table.add(head + "support_force", "N", "world",
              "What holds the locked coordinates, on the body." + note,
              [i](const Instant& now) { return Vector3(now.seen.supports[i].head<3>()); });
    table.add(head + "support_moment", "N m", "world",
              "Moment about the centre of gravity that holds the locked coordinates." + note,
              [i](const Instant& now) { return Vector3(now.seen.supports[i].tail<3>()); });
  }
}

void add_joint(ChannelTable& table, const System& s, const JointData& j, std::size_t k) {
  const std::string head = "joints/" + j.name + "/", frame = "marker A of " + j.name;
  for (std::size_t n = 0; n < j.type->motions.size(); ++n) {
    const std::size_t m = at(j.first_motion) + n;
    const std::string name = head + s.motions[m].name;
    const std::string unit = s.motions[m].motion.is_angle() ? "rad" : "m";
    table.add(name, unit, frame, "Joint coordinate of B against A, followed over turns.",
              [m](const Instant& now) { return now.seen.motions[m][0]; });
    table.add(name + "_rate", unit + "/s", frame, "Rate of the joint coordinate.",
              [m](const Instant& now) { return now.seen.motions[m][1]; });
  }
  const std::string owner = j.A.body < 0 ? "the ground" : "body " + s.bodies[at(j.A.body)].name;
  describe_marker(
      table.add(head + "reaction_force", "N", frame,
                "Force of the joint on body B, along the axes of marker A, which " + owner +
                    " carries; axis_x, axis_y, axis_z and origin: where they are in the reference "
                    "pose, world axes.",
                [k](const Instant& now) { return Vector3(now.seen.reactions[k].head<3>()); }),
      s, j.A);
  describe_marker(
      table.add(head + "reaction_moment", "N m", frame,
                "Moment of the joint on body B about the origin of its marker, along the axes of "
                "marker A (see the reaction force).",
                [k](const Instant& now) { return Vector3(now.seen.reactions[k].tail<3>()); }),
      s, j.A);
}

void add_coupler(ChannelTable& table, const System& s, const CouplerData& c, std::size_t k) {
  const bool angle = s.motions[at(c.terms.front().motion)].motion.is_angle();
  table.add("constraints/" + c.name + "/reaction", angle ? "N m" : "N", "-",
            "Load that the constraint puts on its (first) coordinate.",
            [k](const Instant& now) { return now.seen.constraints[k]; });
}

/// r + R s,   v + R (w x s),   v' + R (w' x s + w x (w x s)), with s, w, w' in body axes.
void add_marker(ChannelTable& table, const System& s, const MarkerData& m) {
  const std::string head = "markers/" + m.name + "/", body = s.bodies[at(m.body)].name;
  const std::string frame = m.body_axes ? "body " + body : "world";
  const std::string axes = m.body_axes
                               ? " Along axes that " + body +
                                     " carries: in the reference pose those of the world, axis_x, "
                                     "axis_y, axis_z; origin: the point there."
                               : " Along the axes of the world; origin: the point in the "
                                 "reference pose.";
  const joint::Marker marker{m.body, m.point, Matrix3::Identity(), nullptr};
  const auto along_axes = [turns = m.body_axes](const BodyState<double>& b, const Vector3& world) {
    return turns ? Vector3(b.R.transpose() * world) : world;
  };
  const auto body_of = [i = at(m.body)](const Instant& now) -> const BodyState<double>& {
    return now.bodies[i];
  };
  table.add(head + "position", "m", "world", "Of a point of " + body + ".",
            [=, p = m.point](const Instant& now) {
              const BodyState<double>& b = body_of(now);
              return Vector3(b.r + b.R * p);
            });
  describe_marker(table.add(head + "velocity", "m/s", frame,
                            "Of a point of " + body + ", over the world." + axes,
                            [=, p = m.point](const Instant& now) {
                              const BodyState<double>& b = body_of(now);
                              return along_axes(b, b.v + b.R * b.w.cross(p));
                            }),
                  s, marker);
  describe_marker(table.add(head + "acceleration", "m/s2", frame,
                            "Of a point of " + body + ", over the world; without gravity." + axes,
                            [=, p = m.point](const Instant& now) {
                              const BodyState<double>& b = body_of(now);
                              return along_axes(
                                  b, b.v_dot + b.R * (b.w_dot.cross(p) + b.w.cross(b.w.cross(p))));
                            }),
                  s, marker);
}

void add_load(ChannelTable& table, const System& s, const measure::Observation& seen,
              std::size_t k) {
  const measure::ComponentLoad& load = seen.loads[k];
  const BodyData& b = s.bodies[at(load.body)];
  const std::string head = "forces/" + seen.components[at(load.component)] + "/" + b.name + "/";
  if (b.is_mode()) {
    table.add(head + "load", "N", "-", "On the amplitude of the mode.",
              [k](const Instant& now) { return now.seen.loads[k].load[0]; });
    return;
  }
  table.add(head + "force", "N", "world", "Force on the body.",
            [k](const Instant& now) { return Vector3(now.seen.loads[k].load.head<3>()); });
  table.add(head + "moment", "N m", "world", "Moment on the body about its centre of gravity.",
            [k](const Instant& now) { return Vector3(now.seen.loads[k].load.tail<3>()); });
}

void add_elements(ChannelTable& table, const Regime& s) {
  std::size_t first = 0;
  for (const Channel& channel : declare(s).channels) {
    const auto width = static_cast<std::size_t>(channel.width);
    table.add_block(channel, [first, width](const Instant& now, double* out) {
      std::copy_n(now.seen.elements.data() + first, width, out);
    });
    first += width;
  }
}

void add_gauge(ChannelTable& table, const System& s, const GaugeData& g) {
  const std::string head = "gauges/" + g.name + "/";
  const std::string place = g.marker < 0
                                ? "x = " + number_text(g.x) + " m, y = " + number_text(g.y) + " m"
                                : "marker " + s.markers[at(g.marker)].name;
  const auto elevation = [&s, &g](const Instant& now, double later) {
    double x = g.x, y = g.y;
    if (g.marker >= 0) {
      const MarkerData& m = s.markers[at(g.marker)];
      const BodyState<double>& b = now.bodies[at(m.body)];
      const Vector3 point = b.r + b.R * m.point;
      x = point[0];
      y = point[1];
    }
    return sea::elevation(s.gauged, now.t + later, x, y);
  };
  table.add(head + "elevation", "m", "world", "Of the undisturbed waves at " + place + ".",
            [elevation](const Instant& now) { return elevation(now, 0.0); });
  for (std::size_t k = 0; k < g.ahead.size(); ++k)
    table.add(
        head + "ahead_" + std::to_string(k + 1), "m", "world",
        "Elevation " + number_text(g.ahead[k]) + " s later where the gauge is now: at " + place +
            ".",
        [elevation, later = g.ahead[k]](const Instant& now) { return elevation(now, later); });
}

void add_energy(ChannelTable& table, const measure::Observation& seen) {
  table.add("energy/kinetic", "J", "-", "Of the bodies.",
            [](const Instant& now) { return now.seen.kinetic; });
  table.add("energy/kinetic_added_mass", "J", "-", "Of the fluid: U . A_inf U / 2.",
            [](const Instant& now) { return now.seen.kinetic_added_mass; });
  table.add("energy/potential", "J", "-",
            "Weight, hydrostatics and springs; zero in the reference pose.",
            [](const Instant& now) { return now.seen.potential; });
  table.add("energy/total", "J", "-", "Kinetic energies and potential.", [](const Instant& now) {
    return now.seen.kinetic + now.seen.kinetic_added_mass + now.seen.potential;
  });
  for (std::size_t k = 0; k < seen.components.size(); ++k)
    table.add("energy/work/" + seen.components[k], "J", "-",
              seen.works[k] == element::Work::part ? "Part of the work of another load."
                                                   : "Work on the bodies since the start.",
              [k](const Instant& now) { return now.work[k]; });
  table.add("energy/balance_error", "J", "-",
            "Change of the kinetic energies minus the work of all forces: zero but for the "
            "solver's error.",
            [](const Instant& now) { return now.measure.balance_error(now.work); });
}

/// Refuses a body whose name is that of a channel: own channels of a force stand beside its loads
/// on bodies, which have the names of the bodies.
void check_paths(const std::vector<Channel>& channels) {
  std::set<std::string> paths;
  for (const Channel& channel : channels)
    paths.insert(channel.path);
  for (const Channel& channel : channels) {
    const std::string parent = channel.path.substr(0, channel.path.rfind('/'));
    if (!paths.contains(parent))
      continue;
    const std::string name = parent.substr(parent.rfind('/') + 1);
    throw ModelError("body." + name + ".name", "body " + in_quotes(name) +
                                                   " has the name of a channel of the results, " +
                                                   in_quotes(parent) + "; give it another one");
  }
}

} // namespace

ChannelTable channel_table(const Regime& s, const measure::Measure& measure) {
  ChannelTable table;
  const measure::Observation& seen = measure.observer().observation();
  for (std::size_t i = 0; i < s.bodies.size(); ++i)
    if (s.bodies[i].is_mode())
      add_mode(table, s.bodies[i], i);
    else
      add_body(table, s.system, s.bodies[i], i);
  for (std::size_t k = 0; k < s.joints.size(); ++k)
    if (!s.joints[k].hidden)
      add_joint(table, s.system, s.joints[k], k);
  for (std::size_t k = 0; k < s.couplers.size(); ++k)
    if (!s.couplers[k].hidden)
      add_coupler(table, s.system, s.couplers[k], k);
  for (const MarkerData& marker : s.markers)
    add_marker(table, s.system, marker);
  for (std::size_t k = 0; k < seen.loads.size(); ++k)
    add_load(table, s.system, seen, k);
  add_elements(table, s);
  if (seen.in_waves)
    table.add("sea/elevation", "m", "world", "Of the waves at the origin, undisturbed.",
              [](const Instant& now) { return now.seen.elevation; });
  for (const GaugeData& gauge : s.system.gauges)
    add_gauge(table, s.system, gauge);
  add_energy(table, seen);
  check_paths(table.channels());
  return table;
}

} // namespace hydrodae::observe
