#include "hydrodae/run/method_choice.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/integrate/stiffness.h"
#include "hydrodae/system/declare.h"
#include "hydrodae/system/mechanisms.h"

namespace hydrodae::run {

namespace {

constexpr double stiff = 50.0;      ///< fastest rate over that of the motion
constexpr double long_run = 2000.0; ///< [rad]
constexpr int weighed = 10;         ///< steps that are weighed together
constexpr double stability = 5.0;   ///< of a step of order 8: its length times the fastest rate
constexpr double safety = 0.8;      ///< of that, where the step control rejects and shrinks
constexpr double enough = 1.5;      ///< operations over those promised; counts are this good
constexpr double look = 500.0;      ///< evaluations between two looks at the fastest rate, of 14

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
  return {{"explicit_rk", "radau", "ida"}, "nothing is stiff", true};
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

MethodChoice::MethodChoice(std::string method)
    : MethodChoice(MethodOrder{{std::move(method)}, ""}) {}

MethodChoice::MethodChoice(MethodOrder order)
    : order_(std::move(order)), candidates_(order_.methods) {
  for (const char* name : {"explicit_rk", "radau"})
    if (order_.weighs &&
        std::find(candidates_.begin(), candidates_.end(), name) == candidates_.end())
      candidates_.emplace_back(name);
}

bool MethodChoice::is_left(std::size_t k) const {
  return std::find(state_.given_up.begin(), state_.given_up.end(), k) == state_.given_up.end();
}

/// The method that follows where this one stops: the first of the order that is left; none: beyond
/// the candidates.
std::size_t MethodChoice::follower() const {
  for (std::size_t k = 0; k < order_.methods.size(); ++k)
    if (k != state_.at && is_left(k))
      return k;
  return candidates_.size();
}

/// The method that this one is weighed against; none: beyond the candidates.
std::size_t MethodChoice::rival() const {
  if (!order_.weighs || (method() != "explicit_rk" && method() != "radau"))
    return candidates_.size();
  const char* other = method() == "radau" ? "explicit_rk" : "radau";
  const auto k = static_cast<std::size_t>(std::find(candidates_.begin(), candidates_.end(), other) -
                                          candidates_.begin());
  return is_left(k) ? k : candidates_.size();
}

void MethodChoice::open_window() {
  state_.steps = state_.bounded = 0;
  state_.time = 0.0;
}

void MethodChoice::next(const MethodChange& change) {
  const std::size_t to = change.cause == MethodChange::Cause::cost ? rival() : follower();
  if (change.cause != MethodChange::Cause::cost) {
    state_.given_up.push_back(state_.at);
    state_.trial = 0;
  }
  state_.changes.push_back(change);
  state_.changes.back().to = candidates_[to];
  state_.at = to;
  open_window();
}

MethodChange MethodChoice::after(const SolverError& error, MethodChange::Cause cause) const {
  MethodChange change{cause, method(), error.time, error.halt.what, ""};
  if (more())
    return change;
  Halt halt = error.halt;
  halt.advice.clear(); // the advice names other methods
  halt.what = "no method of \"auto\" goes on: ";
  for (const MethodChange& c : state_.changes)
    if (c.cause != MethodChange::Cause::cost)
      halt.what += with_time(c) + "; ";
  halt.what += with_time(change);
  throw SolverError(error.time, std::move(halt));
}

// The first step opens the window: its own operations may hold the start of the method.
void MethodChoice::accept(double h, bool own, double operations) {
  if (state_.steps == 0) {
    state_.window_from = operations;
  } else {
    state_.time += h;
    state_.bounded += !own;
  }
  ++state_.steps;
  state_.operations = operations;
}

bool MethodChoice::weighs() const { return state_.steps > weighed && rival() < candidates_.size(); }

/// The reason to leave the method of a trial, if it was more expensive.
std::optional<std::string> MethodChoice::judge_trial(double cost) {
  if (++state_.trial <= 2) // the first window holds steps that still grow
    return std::nullopt;
  state_.trial = 0;
  const double spent = state_.operations - state_.trial_from;
  if (cost < state_.cost_before) {
    state_.patience = 10.0;
    state_.next_look = state_.operations + state_.patience * spent;
    return std::nullopt;
  }
  state_.next_look = state_.operations + state_.patience * spent;
  state_.patience *= 2.0;
  return method() + " took " + rounded_text(cost / state_.cost_before) +
         " times the operations of the other method";
}

/// The reason to try the other method, if there is one.
std::optional<std::string> MethodChoice::promise(double of_step,
                                                 const std::function<double()>& fastest) {
  const double spent = state_.operations - state_.window_from, mean = state_.time / weighed;
  if (method() == "radau") {
    double ratio = spent / (of_step * weighed); // to steps of explicit_rk that are as long
    if (ratio > enough)
      ratio = std::min(ratio, spent * stability / (of_step * fastest() * state_.time));
    if (ratio > enough)
      return number_text(weighed) + " steps of radau took " + rounded_text(ratio) +
             " times the operations that explicit_rk needs";
  } else if (2 * state_.bounded > weighed) {
    return "instants of the scene bound the steps of explicit_rk";
  } else if (const double reach = mean * fastest(); reach > safety * stability) {
    return "stability bounds the steps of explicit_rk: their length is " + rounded_text(reach) +
           " over the fastest rate";
  }
  return std::nullopt;
}

std::optional<MethodChange> MethodChoice::weigh(double t, double of_step,
                                                const std::function<double()>& fastest) {
  const double spent = state_.operations - state_.window_from, cost = spent / state_.time;
  std::optional<std::string> reason;
  if (state_.trial > 0) {
    reason = judge_trial(cost);
  } else if (state_.operations >= state_.next_look) {
    reason = promise(of_step, fastest);
    if (reason) {
      state_.trial = 1;
      state_.trial_from = state_.operations;
      state_.cost_before = cost;
    } else {
      state_.next_look = state_.operations + look / 13.0 * of_step;
    }
  }
  open_window();
  if (!reason)
    return std::nullopt;
  return MethodChange{MethodChange::Cause::cost, method(), t, *reason, ""};
}

std::vector<MethodChoice::Part> MethodChoice::parts() const {
  std::vector<Part> out{{order_.methods[0], 0.0, order_.reason}};
  for (const MethodChange& change : state_.changes)
    out.push_back({change.to, change.time, in_words(change)});
  return out;
}

void MethodChoice::set(State state) {
  if (state.at >= candidates_.size() ||
      std::any_of(state.given_up.begin(), state.given_up.end(),
                  [&](std::size_t k) { return k >= candidates_.size(); }))
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
