#include "hydrodae/system/recorder.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace hydrodae::system {

namespace {

bool has_locked(const BodyData& body) { return body.n_active < 6; }

void put(double*& out, const Vector3& v) {
  for (int k = 0; k < 3; ++k)
    *out++ = v[k];
}

} // namespace

Recorder::Recorder(const System& system, double t0, const VectorX& y, const VectorX& yp)
    : s_(system), observer_(system), t_(t0), end_(t0), y_(y), yp_(yp) {
  const Observation& o = observer_.observe(t0, y, yp);
  power_ = powers();
  work_.assign(power_.size(), 0.0);
  energy0_ = o.kinetic + o.kinetic_added_mass;
  static const std::set<std::string> keep = {"weight",     "hydrostatic",   "added_mass_inf",
                                             "excitation", "froude_krylov", "diffraction",
                                             "constraints"};
  for (const std::string& component : o.components)
    gives_.push_back(!keep.contains(component));
  if (s_.n_mechanisms > 1)
    for (double kinetic : o.mechanism_kinetic)
      mechanisms_.push_back({0.0, 0.0, kinetic});
  take_turns();
  observer_.follow(turns_);
  make_channels();
}

void Recorder::add_channel(std::string path, int width, std::string unit, std::string frame,
                           std::string description) {
  width_ += static_cast<std::size_t>(width);
  channels_.push_back(
      {std::move(path), width, std::move(unit), std::move(frame), std::move(description)});
}

/// The axes and the origin of a marker in the reference pose go with the last channel.
void Recorder::describe_marker(const joint::Marker& marker) {
  const Vector3 origin =
      marker.point + (marker.body < 0 ? Vector3(0, 0, 0) : s_.bodies[marker.body].reference);
  channels_.back().vectors = {{"axis_x", marker.axes.col(0)},
                              {"axis_y", marker.axes.col(1)},
                              {"axis_z", marker.axes.col(2)},
                              {"origin", origin}};
}

void Recorder::make_channels() {
  for (const BodyData& b : s_.bodies) {
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
    if (has_locked(b)) {
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
  const Observation& o = observer_.observation();
  for (const ComponentLoad& load : o.loads) {
    const std::string head =
        "forces/" + o.components[load.component] + "/" + s_.bodies[load.body].name + "/";
    add_channel(head + "force", 3, "N", "world", "Force on the body.");
    add_channel(head + "moment", 3, "N m", "world",
                "Moment on the body about its centre of gravity.");
  }
  if (s_.has_waves())
    add_channel("sea/elevation", 1, "m", "world", "Of the waves at the origin, undisturbed.");
  add_channel("energy/kinetic", 1, "J", "-", "Of the bodies.");
  add_channel("energy/kinetic_added_mass", 1, "J", "-", "Of the fluid: U . A_inf U / 2.");
  add_channel("energy/potential", 1, "J", "-",
              "Weight, hydrostatics and springs; zero in the reference pose.");
  add_channel("energy/total", 1, "J", "-", "Kinetic energies and potential.");
  for (const std::string& component : o.components)
    add_channel("energy/work/" + component, 1, "J", "-", "Work on the bodies since the start.");
  add_channel("energy/balance_error", 1, "J", "-",
              "Change of the kinetic energies minus the work of all forces: zero but for the "
              "solver's error.");
}

/// Powers at the nodes of the step from t_ to t, on the solver's interpolant, and the work over it.
/// Leaves the observer at t.
void Recorder::begin(double t, const Interpolant& at) {
  end_ = t;
  const double h = end_ - t_;
  const std::size_t last = rule_.nodes.size() - 1;
  powers_.resize(last + 1);
  powers_[0] = power_;
  for (std::size_t node = 1; node <= last; ++node) {
    const double time = node == last ? t : t_ + h * rule_.nodes[node];
    at(time, y_, yp_);
    observer_.observe(time, y_, yp_);
    powers_[node] = powers();
  }
  end_work_ = work_;
  for (std::size_t node = 0; node <= last; ++node)
    for (std::size_t k = 0; k < work_.size(); ++k)
      end_work_[k] += h * rule_.weights[node] * powers_[node][k];
  whole_.balance_error = balance(end_work_);
  balance_mechanisms();
  end_kinetic_ = observer_.observation().mechanism_kinetic;
  take_turns();
}

/// All motions where the observer is.
void Recorder::take_turns() {
  turns_.time = end_;
  turns_.known = true;
  turns_.value.clear();
  turns_.rate.clear();
  for (const auto& [value, rate] : observer_.observation().motions) {
    turns_.value.push_back(value);
    turns_.rate.push_back(rate);
  }
}

/// By component; where there are several mechanisms then by load, and of each mechanism's rows.
std::vector<double> Recorder::powers() const {
  const Observation& o = observer_.observation();
  std::vector<double> out = o.powers;
  if (s_.n_mechanisms <= 1)
    return out;
  for (const ComponentLoad& load : o.loads)
    out.push_back(load.power);
  out.insert(out.end(), o.mechanism_constraints.begin(), o.mechanism_constraints.end());
  return out;
}

/// Change of the kinetic energy of each mechanism's bodies minus the work of all loads on them.
void Recorder::balance_mechanisms() {
  const Observation& o = observer_.observation();
  const std::size_t loads = o.powers.size(), rows = loads + o.loads.size();
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    Balance& b = mechanisms_[m];
    b.error = o.mechanism_kinetic[m] - b.start - end_work_[rows + m];
    b.now = o.mechanism_kinetic[m];
    b.kinetic = std::max(b.kinetic, b.now);
    b.exchanged = std::max({b.exchanged, o.mechanism_kinetic[m], std::abs(end_work_[rows + m])});
  }
  std::vector<double> given(mechanisms_.size());
  for (std::size_t k = 0; k < o.loads.size() && !mechanisms_.empty(); ++k) {
    const int m = s_.bodies[static_cast<std::size_t>(o.loads[k].body)].mechanism;
    if (m < 0 || o.loads[k].part)
      continue;
    Balance& b = mechanisms_[static_cast<std::size_t>(m)];
    b.error -= end_work_[loads + k];
    b.exchanged = std::max(b.exchanged, std::abs(end_work_[loads + k]));
    if (gives_[static_cast<std::size_t>(o.loads[k].component)])
      given[static_cast<std::size_t>(m)] -= end_work_[loads + k];
  }
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    mechanisms_[m].given = std::max(mechanisms_[m].given, given[m]);
}

/// Work until t = t_ + x h, where the observer is: the integral of the polynomial through the
/// powers at the nodes and at t, h sum_k P_k int_0^x L_k, by the rule itself on [0, x].
std::vector<double> Recorder::work_at(double x) const {
  if (x <= 0.0)
    return work_;
  std::vector<double> nodes = rule_.nodes;
  const auto apart = [&](double node) { return std::abs(node - x) > 1e-3; };
  const bool own = std::all_of(nodes.begin(), nodes.end(), apart); // else next to one of them
  if (own)
    nodes.push_back(x);
  const std::vector<double> power = powers();
  std::vector<double> work = work_;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    double weight = 0.0;
    for (std::size_t node = 0; node < rule_.nodes.size(); ++node) {
      double value = x * rule_.weights[node];
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (i != j)
          value *= (x * rule_.nodes[node] - nodes[i]) / (nodes[j] - nodes[i]);
      weight += value;
    }
    const std::vector<double>& P = j < powers_.size() ? powers_[j] : power;
    for (std::size_t k = 0; k < work.size(); ++k)
      work[k] += (end_ - t_) * weight * P[k];
  }
  return work;
}

/// Change of the kinetic energies minus the work of all forces; keeps the largest.
double Recorder::balance(const std::vector<double>& work) {
  const Observation& o = observer_.observation();
  const double moving = o.kinetic + o.kinetic_added_mass;
  double total_work = 0.0, exchanged = std::abs(moving), given = 0.0;
  for (std::size_t k = 0; k < o.powers.size(); ++k) {
    // The fluid's kinetic energy is on the left-hand side already; parts are in their whole.
    if (o.components[k] != "added_mass_inf" && !o.parts[k])
      total_work += work[k];
    exchanged = std::max(exchanged, std::abs(work[k]));
    if (gives_[k])
      given -= work[k];
  }
  whole_.given = std::max(whole_.given, given);
  whole_.kinetic = moving;
  const double error = moving - energy0_ - total_work;
  whole_.largest_kinetic = std::max(whole_.largest_kinetic, moving);
  whole_.largest_energy = std::max(whole_.largest_energy, exchanged);
  whole_.largest_error = std::max(whole_.largest_error, std::abs(error));
  return error;
}

void Recorder::accept() {
  t_ = end_;
  work_ = end_work_;
  power_ = powers_.back();
  observer_.follow(turns_);
}

void Recorder::restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work) {
  const Observation& o = observer_.observe(t_, y, yp);
  power_ = powers();
  end_ = t_;
  take_turns();
  observer_.follow(turns_);
  if (!work)
    return;
  work_[o.powers.size() - 1] += *work; // "constraints"
  // Of one mechanism alone: the water may have passed on a part of the impulse.
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    work_[o.powers.size() + o.loads.size() + m] += o.mechanism_kinetic[m] - end_kinetic_[m];
}

void Recorder::fill_bodies(double*& out) {
  const auto& states = observer_.bodies();
  for (std::size_t i = 0; i < s_.bodies.size(); ++i) {
    const BodyData& b = s_.bodies[i];
    const BodyState<double>& state = states[i];
    put(out, state.r);
    const Eigen::Quaterniond q(state.R);
    for (double c : {q.w(), q.x(), q.y(), q.z()})
      *out++ = c;
    put(out, displacement<double>(b, state, y_.data()).tail<3>());
    if (b.n_active > 0) {
      put(out, state.v);
      put(out, state.R * state.w);
      put(out, state.v_dot);
      put(out, state.R * state.w_dot); // the part w x w of the turning axes vanishes
    }
    if (has_locked(b)) {
      put(out, observer_.observation().supports[i].head<3>());
      put(out, observer_.observation().supports[i].tail<3>());
    }
  }
}

void Recorder::fill_joints(double*& out) {
  const Observation& o = observer_.observation();
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
  for (double multiplier : o.constraints)
    *out++ = multiplier;
}

// r + R s,   v + R (w x s),   v' + R (w' x s + w x (w x s)), with s, w, w' in body axes.
void Recorder::fill_markers(double*& out) {
  for (const MarkerData& m : s_.markers) {
    const BodyState<double>& b = observer_.bodies()[m.body];
    const Matrix3 axes = m.body_axes ? Matrix3(b.R.transpose()) : Matrix3(Matrix3::Identity());
    const Vector3 speed = b.w.cross(m.point);
    put(out, b.r + b.R * m.point);
    put(out, axes * (b.v + b.R * speed));
    put(out, axes * (b.v_dot + b.R * (b.w_dot.cross(m.point) + b.w.cross(speed))));
  }
}

void Recorder::fill_energy(double*& out, const std::vector<double>& work) {
  const Observation& o = observer_.observation();
  *out++ = o.kinetic;
  *out++ = o.kinetic_added_mass;
  *out++ = o.potential;
  *out++ = o.kinetic + o.kinetic_added_mass + o.potential;
  for (std::size_t k = 0; k < o.powers.size(); ++k)
    *out++ = work[k];
  *out++ = balance(work);
}

void Recorder::sample(double t, const Interpolant& at, std::span<double> row) {
  if (end_ > t_) // else the start of the run
    at(t, y_, yp_);
  observer_.observe(t, y_, yp_);
  fill(row, work_at(end_ > t_ ? (t - t_) / (end_ - t_) : 0.0));
}

void Recorder::look(const VectorX& y, const VectorX& yp, std::span<double> row) {
  const Whole before = whole_;
  y_ = y;
  yp_ = yp;
  observer_.observe(t_, y_, yp_);
  fill(row, work_);
  whole_ = before;
}

/// From where the observer is.
void Recorder::fill(std::span<double> row, const std::vector<double>& work) {
  double* out = row.data();
  fill_bodies(out);
  fill_joints(out);
  fill_markers(out);
  for (const ComponentLoad& load : observer_.observation().loads) {
    put(out, load.load.head<3>());
    put(out, load.load.tail<3>());
  }
  if (s_.has_waves())
    *out++ = observer_.observation().elevation;
  fill_energy(out, work);
}

double Recorder::relative_balance_error() const {
  return whole_.largest_energy > 0.0 ? whole_.largest_error / whole_.largest_energy : 0.0;
}

void Recorder::remember(Archive& a) {
  a(t_, end_, power_, work_, turns_, end_kinetic_, mechanisms_, energy0_, whole_, rule_);
  if (!a.saves())
    observer_.follow(turns_);
}

} // namespace hydrodae::system
