#include "hydrodae/solve/switching.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::solve {

namespace {

constexpr int bisections = 60;
constexpr long watch = 1000; ///< events; see `count`

} // namespace

Switching::Switching(system::Regime& system, double rtol)
    : s_(system), rtol_(rtol), ws_(system), size_(system.switches.size()),
      depth_(system.switches.size()), struck_(system.switches.size()),
      y_(system::initial_state(system)), yp_(VectorX::Zero(system.n)) {
  for (std::size_t k = 0; k < size_.size(); ++k) // scales are those of the rows when they hold
    set(k, s_.switches[k].kind == Kind::stop ? State::upper : State::stick);
  lay_out(s_);
  for (std::size_t k = 0; k < size_.size(); ++k) {
    const system::CouplerData& c = s_.couplers[static_cast<std::size_t>(s_.switches[k].coupler)];
    size_[k].rate = s_.row_scale[s_.lambda(c)];
    size_[k].load = s_.scale[s_.lambda(c)];
    size_[k].length = c.velocity_level ? 1.0 : s_.row_scale[s_.mu(c)];
  }
  for (std::size_t k = 0; k < size_.size(); ++k)
    set(k, State::open);
  lay_out(s_);
  time_scale_ = INFINITY;
  for (const system::BodyData& b : s_.bodies)
    time_scale_ = std::min(time_scale_, b.time_scale);
  unpack(0.0, y_, yp_);
  for (std::size_t k = 0; k < size_.size(); ++k) {
    const Data& element = s_.switches[k];
    const double s = motion(element).value;
    if (element.kind != Kind::stop || (s >= element.lower - touching * size_[k].length &&
                                       s <= element.upper + touching * size_[k].length))
      continue;
    const std::string& name = s_.couplers[static_cast<std::size_t>(element.coupler)].name;
    const bool angle = s_.motions[static_cast<std::size_t>(element.motion)].motion.is_angle();
    const double unit = angle ? 180.0 / pi : 1.0;
    throw ModelError("constraint." + name, "the start is beyond stop '" + name +
                                               "': " + number_text(s * unit) +
                                               (angle ? " deg" : " m") + " is not within " +
                                               number_text(element.lower * unit) + " and " +
                                               number_text(element.upper * unit));
  }
}

void Switching::fail(double t, const std::string& reason) const {
  std::vector<std::string> names;
  for (const Data& element : s_.switches)
    if (s_.mode(element) != State::open)
      names.push_back(s_.couplers[static_cast<std::size_t>(element.coupler)].name);
  throw SolverError(t, "stopped at t = " + number_text(t) + " s: " + reason +
                           (names.empty() ? "" : " (now acting: " + joined(names) + ")"));
}

/// Infinitely many events in a finite time (a ball that comes to rest ends in a captured contact
/// before) would stop all progress.
void Switching::count(double t) {
  ++events_;
  if (++recent_ < watch)
    return;
  if (t - checked_ < 1e-6 * time_scale_ * static_cast<double>(watch))
    fail(t, std::to_string(watch) + " events of stops or dry friction brought only " +
                number_text(t - checked_) + " s");
  recent_ = 0;
  checked_ = t;
}

void Switching::follow(const system::Turns& turns) {
  ws_.turns = turns;
  s_.nearby = turns.value;
}

void Switching::remember(Archive& a) {
  a(depth_, struck_, events_, recent_, checked_, holding_, ws_.turns);
}

void Switching::resume(double t, const VectorX& y, const VectorX& yp) {
  const Stabilised lock(s_);
  present_ = std::make_unique<Present>(s_);
  present_->equations.accept(t, y, yp);
}

/// y, y' at t, with the loads that belong to the pose and velocities: those of the integrator are
/// of lower order, or oscillate.
void Switching::look(double t, const Interpolant& at) {
  at(t, y_, yp_);
  if (holding_ && !present_->saddle.accelerations(t, y_, yp_))
    fail(t, "no finite accelerations inside the step");
  unpack(t, y_, yp_);
}

void Switching::unpack(double t, const VectorX& y, const VectorX& yp) {
  ws_.time = t;
  system::unpack<double>(s_, y.data(), yp.data(), ws_.bodies);
}

Switching::Motion Switching::motion(const Data& element) const {
  const system::MotionData& m = s_.motions[static_cast<std::size_t>(element.motion)];
  const system::JointData& j = s_.joints[static_cast<std::size_t>(m.joint)];
  const auto row = system::motion_row<double>(s_, ws_, element.motion);
  const joint::Vector12 u = system::joint_velocity<double>(j, ws_.bodies);
  const auto T =
      joint::motion_curvature(m.motion, j.A, j.B, system::joint_geometry<double>(j, ws_.bodies));
  return {row.value, row.gradient.dot(u),
          row.gradient.dot(system::joint_acceleration<double>(j, ws_.bodies)) + u.dot(T * u)};
}

/// Part of the full scales that the motion of its bodies takes.
double Switching::motion_scale(const Data& element) const {
  const system::BodyData* body = system::moving_body(s_, system::joint_of(s_, element.motion));
  return body ? s_.motion_scale[body->group] : 1.0;
}

/// Load of a row that holds on its coordinate [N or N m].
double Switching::load(const Data& element, const VectorX& y) const {
  return y[s_.lambda(s_.couplers[static_cast<std::size_t>(element.coupler)])];
}

/// Of an open stop from the bound that is nearer [m or rad].
double Switching::gap(std::size_t k) const {
  const Data& element = s_.switches[k];
  const double s = motion(element).value;
  return std::min(element.upper - s, s - element.lower);
}

/// How far the switch is from having to change; negative when it is past that.
double Switching::margin(std::size_t k, const VectorX& y) const {
  const Data& element = s_.switches[k];
  const Size& size = size_[k];
  switch (s_.mode(element)) {
  case State::open: {
    // What has just come off leaves slowly, and the integrator's error may be larger than its gap.
    const double scale = motion_scale(element);
    const bool slow = approach(k) <= rtol_ * scale * size.rate;
    return gap(k) + depth_[k] + (slow ? 0.1 * rtol_ * scale : 1e-3 * touching) * size.length;
  }
  case State::upper:
    return -load(element, y) + 2.0 * resting * size.load;
  case State::lower:
    return load(element, y) + 2.0 * resting * size.load;
  case State::stick:
    return system::sticking_load(s_, element, y.data()) + 2.0 * resting * size.load -
           std::abs(load(element, y));
  case State::forward:
    return motion(element).rate + resting * size.rate;
  case State::backward:
    break;
  }
  return -motion(element).rate + resting * size.rate;
}

/// Rate at which an open stop closes [m/s or rad/s], towards the bound that is nearer.
double Switching::approach(std::size_t k) const {
  const Data& element = s_.switches[k];
  const Motion m = motion(element);
  return element.upper - m.value < m.value - element.lower ? m.rate : -m.rate;
}

/// The first time in (a, b] after which `past` stays true, given that it is true at b.
double Switching::bisect(double a, double b, const Interpolant& at,
                         const std::function<bool()>& past) {
  for (int i = 0; i < bisections && b - a > 1e-15 * std::max(std::abs(b), time_scale_); ++i) {
    const double middle = 0.5 * (a + b);
    look(middle, at);
    (past() ? b : a) = middle;
  }
  return b;
}

/// The first time in (a, b] at which a margin is lost, where one is at b.
std::optional<double> Switching::first_root(double a, double b, const Interpolant& at) {
  std::optional<double> first;
  for (std::size_t k = 0; k < size_.size(); ++k) {
    look(b, at);
    if (margin(k, y_) >= 0.0)
      continue;
    b = bisect(a, b, at, [&] { return margin(k, y_) < 0.0; });
    first = b;
  }
  return first;
}

std::optional<double> Switching::locate(double t0, double t1, int nodes, const Interpolant& at) {
  const auto count = size_.size();
  std::vector<double> speed(count);
  double a = t0;
  const Stabilised lock(s_);
  look(a, at);
  for (std::size_t k = 0; k < count; ++k)
    speed[k] = approach(k);
  for (int node = 1; node <= nodes; ++node) {
    const double b = node == nodes ? t1 : t0 + (t1 - t0) * node / nodes;
    look(b, at);
    bool lost = false;
    std::vector<double> now(count);
    for (std::size_t k = 0; k < count; ++k) {
      lost = lost || margin(k, y_) < 0.0;
      now[k] = approach(k);
    }
    if (lost)
      return first_root(a, b, at);
    // An open stop may have been passed and left within the interval: look where it is nearest.
    for (std::size_t k = 0; k < count; ++k) {
      if (s_.switches[k].kind != Kind::stop || s_.holds(s_.switches[k]) || speed[k] <= 0.0 ||
          now[k] >= 0.0)
        continue;
      const double nearest = bisect(a, b, at, [&] { return approach(k) < 0.0; });
      if (const auto root = first_root(a, nearest, at))
        return root;
    }
    speed = now;
    a = b;
  }
  for (std::size_t k = 0; k < count; ++k)
    if (depth_[k] > 0.0 && gap(k) >= 0.0)
      depth_[k] = 0.0;
  system::accept_turns(s_, t1, y_.data(), yp_.data(), ws_);
  present_->equations.accept(t1, y_, yp_);
  return std::nullopt;
}

} // namespace hydrodae::solve
