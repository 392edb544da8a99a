/// Part of the recorder: names, units and frames of all channels, and in the same order their
/// values.

#include <set>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/observe/recorder.h"
#include "hydrodae/system/declare.h"

namespace hydrodae::observe {

using namespace system;

namespace {

void put(double*& out, const Vector3& v) {
  for (int k = 0; k < 3; ++k)
    *out++ = v[k];
}

} // namespace

void Recorder::add_channel(std::string path, int width, std::string unit, std::string frame,
                           std::string description) {
  width_ += static_cast<std::size_t>(width);
  channels_.push_back(
      {std::move(path), width, std::move(unit), std::move(frame), std::move(description)});
}

/// Adds axes and origin of a marker in the reference pose to the last channel.
void Recorder::describe_marker(const joint::Marker& marker) {
  const Vector3 origin =
      marker.point + (marker.body < 0 ? Vector3(0, 0, 0) : s_.bodies[marker.body].reference);
  channels_.back().vectors = {{"axis_x", marker.axes.col(0)},
                              {"axis_y", marker.axes.col(1)},
                              {"axis_z", marker.axes.col(2)},
                              {"origin", origin}};
}

/// Checks that channels of a force and its loads on bodies have different names.
void Recorder::check_paths() const {
  std::set<std::string> paths;
  for (const Channel& channel : channels_)
    paths.insert(channel.path);
  for (const Channel& channel : channels_) {
    const std::string parent = channel.path.substr(0, channel.path.rfind('/'));
    if (!paths.contains(parent))
      continue;
    const std::string name = parent.substr(parent.rfind('/') + 1);
    throw ModelError("body." + name + ".name", "body " + in_quotes(name) +
                                                   " has the name of a channel of the results, " +
                                                   in_quotes(parent) + "; give it another one");
  }
}

void Recorder::make_channels() {
  for (const BodyData& b : s_.bodies) {
    if (b.is_mode()) {
      const std::string head = "modes/" + b.name + "/";
      add_channel(head + "amplitude", 1, "m", "-", "Of the mode, in the scale of its shape.");
      add_channel(head + "rate", 1, "m/s", "-", "Of the amplitude.");
      add_channel(head + "acceleration", 1, "m/s2", "-", "Of the amplitude.");
      continue;
    }
    const std::string head = "bodies/" + b.name + "/";
    add_channel(head + "position", 3, "m", "world", "Centre of gravity.");
    add_channel(head + "orientation", 4, "-", "world",
                "Unit quaternion (w, x, y, z) of the rotation from the reference pose.");
    add_channel(head + "rotation", 3, "rad", "world", "Rotation vector from the reference pose.");
    if (b.n_active > 0) {
      add_channel(head + "velocity", 3, "m/s", "world", "Of the centre of gravity.");
      add_channel(head + "angular_velocity", 3, "rad/s", "world", "Angular velocity.");
      add_channel(head + "acceleration", 3, "m/s2", "world", "Of the centre of gravity.");
      add_channel(head + "angular_acceleration", 3, "rad/s2", "world",
                  "Rate of the angular velocity.");
    }
    if (b.n_active < 6) {
      std::string note;
      for (const HydroBody& hb : s_.hydro.bodies)
        if (s_.bodies[hb.body].name == b.name && !s_.hydro.uncovered.empty())
          for (const std::string& label : s_.hydro.uncovered)
            note += (note.empty() ? " Without the hydrodynamic loads that the fit does not give: "
                                  : ", ") +
                    label;
      add_channel(head + "support_force", 3, "N", "world",
                  "What holds the locked coordinates, on the body." + note);
      add_channel(head + "support_moment", 3, "N m", "world",
                  "Moment about the centre of gravity that holds the locked coordinates." + note);
    }
  }
  for (const JointData& j : s_.joints) {
    if (j.hidden)
      continue;
    const std::string head = "joints/" + j.name + "/", frame = "marker A of " + j.name;
    for (std::size_t m = 0; m < j.type->motions.size(); ++m) {
      const MotionData& motion = s_.motions[static_cast<std::size_t>(j.first_motion) + m];
      const std::string unit = motion.motion.is_angle() ? "rad" : "m";
      add_channel(head + motion.name, 1, unit, frame,
                  "Joint coordinate of B against A, followed over turns.");
      add_channel(head + motion.name + "_rate", 1, unit + "/s", frame,
                  "Rate of the joint coordinate.");
    }
    const std::string owner = j.A.body < 0 ? "the ground" : "body " + s_.bodies[j.A.body].name;
    add_channel(head + "reaction_force", 3, "N", frame,
                "Force of the joint on body B, along the axes of marker A, which " + owner +
                    " carries; axis_x, axis_y, axis_z and origin: where they are in the reference "
                    "pose, world axes.");
    describe_marker(j.A);
    add_channel(head + "reaction_moment", 3, "N m", frame,
                "Moment of the joint on body B about the origin of its marker, along the axes of "
                "marker A (see the reaction force).");
    describe_marker(j.A);
  }
  for (const CouplerData& c : s_.couplers) {
    if (c.hidden)
      continue;
    const bool angle = s_.motions[c.terms.front().motion].motion.is_angle();
    add_channel("constraints/" + c.name + "/reaction", 1, angle ? "N m" : "N", "-",
                "Load that the constraint puts on its (first) coordinate.");
  }
  for (const MarkerData& m : s_.markers) {
    const std::string head = "markers/" + m.name + "/", body = s_.bodies[m.body].name;
    const std::string frame = m.body_axes ? "body " + body : "world";
    const std::string axes =
        m.body_axes ? " Along axes that " + body +
                          " carries: in the reference pose those of the world, axis_x, axis_y, "
                          "axis_z; origin: the point there."
                    : " Along the axes of the world; origin: the point in the reference pose.";
    const joint::Marker marker{m.body, m.point, Matrix3::Identity(), nullptr};
    add_channel(head + "position", 3, "m", "world", "Of a point of " + body + ".");
    add_channel(head + "velocity", 3, "m/s", frame,
                "Of a point of " + body + ", over the world." + axes);
    describe_marker(marker);
    add_channel(head + "acceleration", 3, "m/s2", frame,
                "Of a point of " + body + ", over the world; without gravity." + axes);
    describe_marker(marker);
  }
  const Observation& o = seen();
  for (const ComponentLoad& load : o.loads) {
    const std::string head =
        "forces/" + o.components[load.component] + "/" + s_.bodies[load.body].name + "/";
    if (s_.bodies[load.body].is_mode()) {
      add_channel(head + "load", 1, "N", "-", "On the amplitude of the mode.");
      continue;
    }
    add_channel(head + "force", 3, "N", "world", "Force on the body.");
    add_channel(head + "moment", 3, "N m", "world",
                "Moment on the body about its centre of gravity.");
  }
  for (const Channel& channel : declare(s_).channels) {
    width_ += static_cast<std::size_t>(channel.width);
    channels_.push_back(channel);
  }
  if (o.in_waves)
    add_channel("sea/elevation", 1, "m", "world", "Of the waves at the origin, undisturbed.");
  add_gauges();
  add_channel("energy/kinetic", 1, "J", "-", "Of the bodies.");
  add_channel("energy/kinetic_added_mass", 1, "J", "-", "Of the fluid: U . A_inf U / 2.");
  add_channel("energy/potential", 1, "J", "-",
              "Weight, hydrostatics and springs; zero in the reference pose.");
  add_channel("energy/total", 1, "J", "-", "Kinetic energies and potential.");
  for (std::size_t k = 0; k < o.components.size(); ++k)
    add_channel("energy/work/" + o.components[k], 1, "J", "-",
                o.works[k] == element::Work::part ? "Part of the work of another load."
                                                  : "Work on the bodies since the start.");
  add_channel("energy/balance_error", 1, "J", "-",
              "Change of the kinetic energies minus the work of all forces: zero but for the "
              "solver's error.");
  check_paths();
}

void Recorder::fill_bodies(double*& out) {
  const auto& states = measure_.observer().bodies();
  for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
    const BodyData& b = s_.bodies[i];
    const BodyState<double>& state = states[i];
    if (b.is_mode()) {
      *out++ = state.r[0] - b.reference[0];
      *out++ = state.v[0];
      *out++ = state.v_dot[0];
      continue;
    }
    put(out, state.r);
    const Eigen::Quaterniond q(state.R);
    for (double c : {q.w(), q.x(), q.y(), q.z()})
      *out++ = c;
    put(out, measure_.observer().displacement(static_cast<int>(i), y_).tail<3>());
    if (b.n_active > 0) {
      put(out, state.v);
      put(out, state.R * state.w);
      put(out, state.v_dot);
      put(out, state.R * state.w_dot); // the term w x w vanishes
    }
    if (b.n_active < 6) {
      put(out, seen().supports[i].head<3>());
      put(out, seen().supports[i].tail<3>());
    }
  }
}

void Recorder::fill_joints(double*& out) {
  const Observation& o = seen();
  for (std::size_t j = 0; j < s_.joints.size(); ++j) {
    const JointData& joint = s_.joints[j];
    if (joint.hidden)
      continue;
    for (std::size_t m = 0; m < joint.type->motions.size(); ++m) {
      const std::array<double, 2>& motion =
          o.motions[static_cast<std::size_t>(joint.first_motion) + m];
      *out++ = motion[0];
      *out++ = motion[1];
    }
    put(out, o.reactions[j].head<3>());
    put(out, o.reactions[j].tail<3>());
  }
  for (std::size_t k = 0; k < s_.couplers.size(); ++k)
    if (!s_.couplers[k].hidden)
      *out++ = o.constraints[k];
}

// Marker motion r + R s, v + R (w x s), v' + R (w' x s + w x (w x s)), with s, w, w' in body axes.
void Recorder::fill_markers(double*& out) {
  for (const MarkerData& m : s_.markers) {
    const BodyState<double>& b = measure_.observer().bodies()[m.body];
    const Matrix3 axes = m.body_axes ? Matrix3(b.R.transpose()) : Matrix3(Matrix3::Identity());
    const Vector3 speed = b.w.cross(m.point);
    put(out, b.r + b.R * m.point);
    put(out, axes * (b.v + b.R * speed));
    put(out, axes * (b.v_dot + b.R * (b.w_dot.cross(m.point) + b.w.cross(speed))));
  }
}

void Recorder::add_gauges() {
  for (const GaugeData& g : s_.system.gauges) {
    const std::string head = "gauges/" + g.name + "/";
    const std::string place = g.marker < 0
                                  ? "x = " + number_text(g.x) + " m, y = " + number_text(g.y) + " m"
                                  : "marker " + s_.markers[static_cast<std::size_t>(g.marker)].name;
    add_channel(head + "elevation", 1, "m", "world", "Of the undisturbed waves at " + place + ".");
    for (std::size_t k = 0; k < g.ahead.size(); ++k)
      add_channel(head + "ahead_" + std::to_string(k + 1), 1, "m", "world",
                  "Elevation " + number_text(g.ahead[k]) + " s later where the gauge is now: at " +
                      place + ".");
  }
}

void Recorder::fill_gauges(double t, double*& out) {
  for (const GaugeData& g : s_.system.gauges) {
    double x = g.x, y = g.y;
    if (g.marker >= 0) {
      const MarkerData& m = s_.markers[static_cast<std::size_t>(g.marker)];
      const BodyState<double>& b = measure_.observer().bodies()[static_cast<std::size_t>(m.body)];
      const Vector3 place = b.r + b.R * m.point;
      x = place[0];
      y = place[1];
    }
    *out++ = sea::elevation(s_.system.gauged, t, x, y);
    for (const double ahead : g.ahead)
      *out++ = sea::elevation(s_.system.gauged, t + ahead, x, y);
  }
}

void Recorder::fill_energy(double t, double*& out) {
  const Observation& o = seen();
  const std::vector<double> work = measure_.work_at(t);
  *out++ = o.kinetic;
  *out++ = o.kinetic_added_mass;
  *out++ = o.potential;
  *out++ = o.kinetic + o.kinetic_added_mass + o.potential;
  for (std::size_t k = 0; k < o.powers.size(); ++k)
    *out++ = work[k];
  *out++ = measure_.balance_error(work);
}

/// Fills a row from the observer's state.
void Recorder::fill(double t, std::span<double> row) {
  double* out = row.data();
  fill_bodies(out);
  fill_joints(out);
  fill_markers(out);
  for (const ComponentLoad& load : seen().loads) {
    if (s_.bodies[load.body].is_mode()) {
      *out++ = load.load[0];
      continue;
    }
    put(out, load.load.head<3>());
    put(out, load.load.tail<3>());
  }
  out = std::copy(seen().elements.begin(), seen().elements.end(), out);
  if (seen().in_waves)
    *out++ = seen().elevation;
  fill_gauges(t, out);
  fill_energy(t, out);
}

} // namespace hydrodae::observe
