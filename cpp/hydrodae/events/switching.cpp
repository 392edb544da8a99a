#include "hydrodae/events/switching.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/system/elements.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::events {

namespace {

constexpr long watch = 1000; ///< events; see `count`

} // namespace

Switching::Switching(system::Regime& system, double rtol)
    : s_(system), rtol_(rtol), ws_(system), size_(system.switches.size()),
      y_(system::initial_state(system)), yp_(VectorX::Zero(system.n)) {
  state_.depth.resize(size_.size());
  state_.struck.resize(size_.size());
  for (std::size_t k = 0; k < size_.size(); ++k) // scales are those of the rows when they hold
    put(k, s_.switches[k].kind == Kind::stop ? Mode::upper : Mode::stick);
  lay_out(s_);
  for (std::size_t k = 0; k < size_.size(); ++k) {
    const system::CouplerData& c = s_.couplers[static_cast<std::size_t>(s_.switches[k].coupler)];
    size_[k].rate = s_.row_scale[s_.lambda(c)];
    size_[k].load = s_.scale[s_.lambda(c)];
    size_[k].length = c.velocity_level ? 1.0 : s_.row_scale[s_.mu(c)];
  }
  for (std::size_t k = 0; k < size_.size(); ++k)
    put(k, Mode::open);
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

void Switching::fail(double t, Reason reason, const std::string& what) const {
  std::vector<std::string> names;
  for (const Data& element : s_.switches)
    if (s_.mode(element) != Mode::open)
      names.push_back(s_.couplers[static_cast<std::size_t>(element.coupler)].name);
  throw SolverError(t,
                    {reason, what + (names.empty() ? "" : " (now acting: " + joined(names) + ")")});
}

/// Infinitely many events in a finite time (a ball that comes to rest ends in a captured contact
/// before) would stop all progress.
void Switching::count(double t) {
  ++state_.events;
  if (++state_.recent < watch)
    return;
  if (t - state_.checked < 1e-6 * time_scale_ * static_cast<double>(watch))
    fail(t, Reason::progress,
         std::to_string(watch) + " events of stops or dry friction brought only " +
             number_text(t - state_.checked) + " s");
  state_.recent = 0;
  state_.checked = t;
}

void Switching::follow(const system::Turns& turns) {
  ws_.turns = turns;
  s_.nearby = turns.value;
}

Switching::State Switching::state() const {
  State out = state_;
  out.turns = ws_.turns;
  return out;
}

void Switching::set(State state, double t, const VectorX& y, const VectorX& yp) {
  const Stabilised lock(s_);
  state_ = std::move(state);
  ws_.turns = state_.turns;
  present_ = std::make_unique<Present>(s_);
  present_->equations.accept(t, y, yp);
}

/// y, y' at t, with the loads that belong to the pose and velocities: those of the integrator are
/// of lower order, or oscillate.
void Switching::look(double t, const VectorX& y, const VectorX& yp) {
  y_ = y;
  yp_ = yp;
  if (state_.holding && !present_->saddle.accelerations(t, y_, yp_))
    fail(t, Reason::not_finite, "no finite accelerations inside the step");
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

/// Motion of its bodies as part of the full scales.
double Switching::motion_scale(const Data& element) const {
  const system::BodyData* body = system::moving_body(s_, system::joint_of(s_, element.motion));
  return body ? s_.motion_scale[body->group] : 1.0;
}

/// Load of a row that holds on its coordinate [N or N m].
double Switching::load(const Data& element, const VectorX& y) const {
  return y[s_.lambda(s_.couplers[static_cast<std::size_t>(element.coupler)])];
}

/// Gap of an open stop to the nearer bound [m or rad].
double Switching::gap(std::size_t k) const {
  const Data& element = s_.switches[k];
  const double s = motion(element).value;
  return std::min(element.upper - s, s - element.lower);
}

/// Margins of a switch to its next change, in both directions; negative beyond it.
void Switching::margins_of(std::size_t k, double* out) const {
  constexpr double never = 1.0;
  const Data& element = s_.switches[k];
  const Size& size = size_[k];
  const double spare = 2.0 * resting * size.load;
  out[1] = never;
  switch (s_.mode(element)) {
  case Mode::open: {
    if (element.kind != Kind::stop) {
      out[0] = never;
      return;
    }
    // A stop that has just opened separates slowly; the integrator's error may exceed its gap.
    const Motion m = motion(element);
    const double scale = motion_scale(element);
    const auto left = [&](double gap, double rate) {
      const bool slow = rate <= rtol_ * scale * size.rate;
      const double spare_gap = slow ? 0.1 * rtol_ * scale : 1e-3 * touching;
      return std::isfinite(gap) ? gap + state_.depth[k] + spare_gap * size.length : never;
    };
    out[0] = left(element.upper - m.value, m.rate);
    out[1] = left(m.value - element.lower, -m.rate);
    return;
  }
  case Mode::upper:
    out[0] = -load(element, y_) + spare;
    return;
  case Mode::lower:
    out[0] = load(element, y_) + spare;
    return;
  case Mode::stick:
    out[0] = system::sticking_load(s_, element, y_.data()) + spare;
    out[1] = out[0] + load(element, y_);
    out[0] -= load(element, y_);
    return;
  case Mode::forward:
    out[0] = motion(element).rate + resting * size.rate;
    return;
  case Mode::backward:
    out[0] = -motion(element).rate + resting * size.rate;
    return;
  }
}

/// Rate at which an open stop closes [m/s or rad/s], towards the bound that is nearer.
double Switching::approach(std::size_t k) const {
  const Data& element = s_.switches[k];
  const Motion m = motion(element);
  return element.upper - m.value < m.value - element.lower ? m.rate : -m.rate;
}

void Switching::margins(double t, const VectorX& y, const VectorX& yp, std::span<double> out) {
  const Stabilised lock(s_);
  look(t, y, yp);
  for (std::size_t k = 0; k < size_.size(); ++k)
    margins_of(k, out.data() + 2 * k);
}

void Switching::accept(double t, const VectorX& y, const VectorX& yp) {
  const Stabilised lock(s_);
  look(t, y, yp);
  for (std::size_t k = 0; k < size_.size(); ++k)
    if (state_.depth[k] > 0.0 && gap(k) >= 0.0)
      state_.depth[k] = 0.0;
  system::accept_turns(s_, t, y_.data(), yp_.data(), ws_);
  present_->equations.accept(t, y_, yp_);
}

} // namespace hydrodae::events
