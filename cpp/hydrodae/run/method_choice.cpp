#include "hydrodae/run/method_choice.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/integrate/stiffness.h"
#include "hydrodae/system/declare.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::run {

namespace {

constexpr double stiff = 50.0;      ///< ratio of the fastest rate to that of the motion
constexpr double long_run = 2000.0; ///< length of a long run [rad]
constexpr double short_step = 0.02; ///< length of a short step [rad]
constexpr int many = 40;            ///< number of short steps in a row
constexpr int weighed = 10;         ///< number of steps per comparison

/// Returns whether every group of bodies has more than joints, weights and constant loads.
bool may_damp(const system::Regime& s) {
  std::vector<bool> damped(static_cast<std::size_t>(s.n_groups));
  const auto mark = [&](const system::BodyData* body) {
    if (body && body->group >= 0)
      damped[static_cast<std::size_t>(body->group)] = true;
  };
  for (const system::Declaration::Load& load : system::declare(s).loads)
    if (load.work == element::Work::spent)
      mark(&s.bodies[static_cast<std::size_t>(load.body)]);
  for (const system::SwitchData& w : s.switches)
    mark(system::moving_body(s, system::joint_of(s, w.motion)));
  return std::all_of(damped.begin(), damped.end(), [](bool d) { return d; });
}

std::string find_costly(const system::Regime& s) {
  for (const system::CouplerData& c : s.couplers)
    if (c.drive.python)
      return "a drive of Python";
  for (const system::JointData& j : s.joints)
    if (j.A.path || j.B.path)
      return "a path";
  std::string law;
  system::for_each_law(s,
                       [&](const system::ElementList& list, std::size_t, const system::PortData&) {
                         if (list.laws->type.starts_with("python_"))
                           law = "a force of Python";
                       });
  return law;
}

} // namespace

MethodOrder order_methods(const SceneTraits& traits) {
  if (!(traits.fastest_rate <= stiff * traits.motion_rate))
    return {{"radau", "ida"},
            "it is stiff: the fastest rate is " + rounded_text(traits.fastest_rate) +
                " 1/s, the motion's " + rounded_text(traits.motion_rate) + " 1/s",
            traits.costly.empty()};
  const std::vector<std::string> implicit_first = {"radau", "explicit_rk", "ida"};
  if (!traits.costly.empty())
    return {implicit_first, traits.costly + " is expensive to evaluate"};
  if (!traits.damped && traits.end_time * traits.motion_rate > long_run)
    return {implicit_first, "errors pile up: nothing damps the motion, which goes on for about " +
                                rounded_text(traits.end_time * traits.motion_rate) + " rad"};
  return {{"explicit_rk", "radau", "ida"}, "nothing is stiff"};
}

SceneTraits find_traits(const system::Regime& s, const system::Pattern& pattern,
                        const SolverOptions& options, const VectorX& y, const VectorX& yp) {
  SceneTraits out;
  out.fastest_rate = integrate::fastest_rate(s, pattern, 0.0, y, yp);
  out.motion_rate = integrate::motion_rate(s, y);
  out.end_time = options.end_time;
  out.damped = may_damp(s);
  out.costly = find_costly(s);
  return out;
}

std::string in_words(const MethodChange& change) {
  switch (change.cause) {
  case MethodChange::Cause::stop:
    return change.method + " gave up: " + change.reason;
  case MethodChange::Cause::guard:
    return "a step of " + change.method + " was refused: " + change.reason;
  case MethodChange::Cause::cost:
    break;
  }
  return change.reason;
}

std::string with_time(const MethodChange& change) {
  return change.method + " at t = " + number_text(change.time) + " s: " + change.reason;
}

MethodChoice::MethodChoice(std::string method) { order_.methods.push_back(std::move(method)); }

MethodChoice::MethodChoice(MethodOrder order) : order_(std::move(order)) {}

void MethodChoice::next(const MethodChange& change) {
  state_.changes.push_back(change);
  ++state_.at;
  state_.short_steps = state_.weighed_steps = 0;
  state_.weighed_time = state_.turn_steps = 0.0;
  state_.again = state_.turns > 0;
}

MethodChange MethodChoice::after(const SolverError& error, MethodChange::Cause cause) const {
  MethodChange change{cause, method(), error.time, error.halt.what};
  if (more())
    return change;
  Halt halt = error.halt;
  halt.advice.clear(); // the advice names other methods
  halt.what = "no method of \"auto\" goes on: ";
  for (const MethodChange& c : state_.changes)
    halt.what += with_time(c) + "; ";
  halt.what += with_time(change);
  throw SolverError(error.time, std::move(halt));
}

void MethodChoice::accept(double h, double rate, bool own, double operations) {
  if (own)
    state_.short_steps = h * rate < short_step ? state_.short_steps + 1 : 0;
  if (state_.weighed_steps == 0)
    state_.weighed_from = operations;
  else
    state_.weighed_time += h;
  ++state_.weighed_steps;
  state_.turn_steps += 1.0;
  state_.operations = operations;
}

std::optional<MethodChange> MethodChoice::labours(double t) const {
  if (state_.short_steps < many || !more() || takes_turn() ||
      !method_traits(method()).bounded_stability)
    return std::nullopt;
  return MethodChange{MethodChange::Cause::cost, method(), t,
                      number_text(many) + " steps of " + method() + " in a row were shorter than " +
                          number_text(short_step) + " rad of the motion"};
}

bool MethodChoice::weighs() const {
  return order_.may_weigh && state_.at == 2 * state_.turns && state_.weighed_steps > weighed;
}

std::optional<MethodChange> MethodChoice::weigh(double t, double of_step,
                                                const std::function<double()>& fastest) {
  // factor of steps; stable length of an order 8 step times the fastest rate
  constexpr double enough = 2.0, stable = 5.0;
  const double as_many =
      (state_.operations - state_.weighed_from) / of_step; // number of explicit_rk steps
  double ratio = as_many / weighed;                        // ratio for steps of equal length
  if (ratio > enough)
    ratio = std::min(ratio, as_many * stable / (fastest() * state_.weighed_time));
  state_.weighed_steps = 0;
  state_.weighed_time = 0.0;
  const bool again = state_.again;
  state_.again = false;
  if (!(ratio > enough))
    return std::nullopt;
  ++state_.turns;
  state_.turn = again ? 2.0 * state_.turn : 10.0 * as_many;
  return MethodChange{MethodChange::Cause::cost, method(), t,
                      number_text(weighed) + " steps of " + method() + " took " +
                          rounded_text(ratio) + " times the operations that explicit_rk needs"};
}

/// Method number `at` of the order, with the turns of explicit_rk after the first method.
const std::string& MethodChoice::method(std::size_t at) const {
  static const std::string other = "explicit_rk";
  if (at > 2 * state_.turns)
    return order_.methods[at - 2 * state_.turns];
  return at % 2 == 1 ? other : order_.methods.front();
}

std::optional<MethodChange> MethodChoice::returns(double t) const {
  if (!takes_turn() || state_.turn_steps < state_.turn)
    return std::nullopt;
  return MethodChange{MethodChange::Cause::cost, method(), t,
                      method() + " has made the " + number_text(state_.turn_steps) +
                          " steps of its turn"};
}

std::vector<MethodChoice::Part> MethodChoice::parts() const {
  std::vector<Part> out{{order_.methods[0], 0.0, order_.reason}};
  for (std::size_t k = 1; k <= state_.at; ++k)
    out.push_back({method(k), state_.changes[k - 1].time, in_words(state_.changes[k - 1])});
  return out;
}

void MethodChoice::set(State state) {
  if (state.at >= size(state.turns) || state.changes.size() < state.at)
    throw Error("the state is of a run with other methods");
  state_ = std::move(state);
}

std::string in_words(const MethodChoice& choice) {
  const std::vector<MethodChoice::Part> parts = choice.parts();
  if (!choice.chosen())
    return parts.front().method;
  std::string text = "auto: " + parts.front().method + " (" + parts.front().reason + ")";
  const std::size_t shown = std::min<std::size_t>(parts.size(), 4);
  for (std::size_t k = 1; k < shown; ++k)
    text += ", " + parts[k].method + " from t = " + number_text(parts[k].from) + " s because " +
            parts[k].reason;
  if (parts.size() > shown)
    text += ", and " + std::to_string(parts.size() - shown) + " more changes, at last to " +
            parts.back().method + " at t = " + number_text(parts.back().from) + " s";
  return text;
}

} // namespace hydrodae::run
