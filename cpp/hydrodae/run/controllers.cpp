#include "hydrodae/run/controllers.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <tuple>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/model/forces.h"

namespace hydrodae::run {

namespace {

/// Dry friction whose largest load is the first output of the controller, if there is one.
std::optional<control::Friction> friction_of(const model::Controller& c,
                                             const system::Regime& regime) {
  const system::SwitchData* friction = find_friction(regime, signal_of(c->outputs.front()).name);
  if (!friction)
    return {};
  const system::MotionData& motion = regime.motions[static_cast<std::size_t>(friction->motion)];
  const std::string& joint = regime.joints[static_cast<std::size_t>(motion.joint)].name;
  return control::Friction{"joints/" + joint + "/" + motion.name + "_rate", [&regime, friction] {
                             return regime.mode(*friction) == system::SwitchData::State::stick;
                           }};
}

/// Channel of a name with a component, "velocity.z", or of its own name if it has one value.
const Channel* find_channel(const std::vector<Channel>& channels, const std::string& name,
                            std::size_t& column) {
  static const std::string of_three = "xyz", of_four = "wxyz";
  column = 0;
  for (const Channel& c : channels) {
    if (c.width == 1 && c.path == name)
      return &c;
    const std::string& letters = c.width == 4 ? of_four : of_three;
    if (c.width > 1 && name.size() == c.path.size() + 2 && name.starts_with(c.path) &&
        name[c.path.size()] == '.')
      if (const std::size_t k = letters.find(name.back()); k < static_cast<std::size_t>(c.width)) {
        column += k;
        return &c;
      }
    column += static_cast<std::size_t>(c.width);
  }
  return nullptr;
}

/// Terminal for a channel or input of the scene, in the unit given with its name, or in its own.
control::Terminal terminal(const SignalName& named, const std::string& own, double start) {
  control::Terminal out{named.name, named.unit.value_or(own), start, own, {}};
  if (out.unit == own)
    return out;
  const std::optional<Unit> given = unit_of(out.unit), of_scene = unit_of(own);
  const std::string expected = "; " + in_quotes(named.name) + " is in " + in_quotes(own);
  if (!given)
    throw CaseError(in_quotes(out.unit) + " is no unit that is known here" + expected);
  const auto to_own = of_scene ? conversion(*given, *of_scene) : std::nullopt;
  if (!to_own)
    throw CaseError(in_quotes(out.unit) + " is a unit of something else (" + given->text() + ")" +
                    expected + (of_scene ? " (" + of_scene->text() + ")" : ""));
  out.to_own = *to_own;
  out.start = out.to_own.back(start);
  return out;
}

/// Returns whether t has reached an instant, up to the rounding of k T or t + delay.
bool reached(double instant, double t) {
  constexpr double rounding = 32.0 * std::numeric_limits<double>::epsilon();
  return instant <= t * (1.0 + rounding);
}

/// Name of the input that is the time [s], and what stands for its column: it is no channel.
constexpr std::string_view time_input = "time";
constexpr std::size_t no_column = static_cast<std::size_t>(-1);

} // namespace

bool asks_outside(const model::Scene& scene) {
  bool called = false;
  model::for_each_force(scene, [&](const auto& force) {
    if constexpr (requires { force.function; })
      called = called || static_cast<bool>(force.function);
  });
  return called ||
         std::any_of(scene.constraints.begin(), scene.constraints.end(),
                     [](const model::Constraint& c) {
                       const auto* driven = c.as<model::DrivenCoordinate>();
                       return driven && driven->drive.function;
                     }) ||
         std::any_of(scene.controllers.begin(), scene.controllers.end(),
                     [](const model::Controller& c) {
                       const auto* outside = c.as<control::Outside>();
                       return outside && outside->make;
                     });
}

std::size_t find_column(const std::vector<Channel>& channels, const std::string& name) {
  std::size_t column = 0;
  if (find_channel(channels, name, column))
    return column;
  std::vector<std::string> names;
  for (const Channel& c : channels)
    for (int k = 0; k < c.width; ++k)
      names.push_back(c.width == 1 ? c.path : c.path + "." + (c.width == 4 ? "wxyz" : "xyz")[k]);
  throw CaseError("there is no channel " + in_quotes(name) + " of one number" +
                  suggestion(name, names));
}

control::Terminals find_terminals(const model::Controller& controller,
                                  const std::vector<Channel>& channels,
                                  std::vector<Input>& inputs) {
  control::Terminals out;
  std::string key = "inputs";
  try {
    for (const std::string& text : controller->inputs) {
      const SignalName named = signal_of(text);
      const Channel* read = nullptr;
      if (named.name != time_input) {
        std::size_t column = find_column(channels, named.name); // throws for an unknown name
        read = find_channel(channels, named.name, column);
      }
      out.inputs.push_back(terminal(named, read ? read->unit : "s", 0.0));
    }
    key = "outputs";
    for (const std::string& text : controller->outputs) {
      const SignalName named = signal_of(text);
      const Input& input = input_named(inputs, named.name);
      if (controller->lag > 0.0 && !input.lags)
        throw CaseError("input " + in_quotes(named.name) +
                        " jumps at events, and cannot follow a 'lag'");
      out.outputs.push_back(terminal(named, input.unit, *input.value));
    }
  } catch (const CaseError& error) {
    throw ModelError("controller." + controller->name + "." + key,
                     "controller " + in_quotes(controller->name) + ": " + error.what());
  }
  controller.visit([&](const auto& one) {
    if constexpr (requires { one.fault(out); })
      if (const std::optional<Fault> fault = one.fault(out))
        throw ModelError("controller." + one.name + "." + fault->key,
                         "controller " + in_quotes(one.name) + ": " + fault->message);
  });
  return out;
}

std::vector<std::string> unit_notes(const std::string& controller, const control::Terminals& t) {
  std::vector<std::string> out;
  const auto tell = [&](const control::Terminal& one, const char* how) {
    if (!one.to_own.is_none())
      out.push_back("controller " + in_quotes(controller) + how + one.name + " in " + one.unit +
                    ": " + equation(one.unit, one.own_unit, one.to_own));
  };
  for (const control::Terminal& one : t.inputs)
    tell(one, " reads ");
  for (const control::Terminal& one : t.outputs)
    tell(one, " writes ");
  return out;
}

std::unique_ptr<control::Law> make_law(const model::Controller& controller,
                                       const control::Terminals& terminals,
                                       const system::Regime& regime) {
  const control::Place place{terminals, friction_of(controller, regime)};
  return controller.visit([&](const auto& own) { return own.law(place); });
}

std::vector<Channel> held_channels(const model::Scene& scene, const std::vector<Input>& inputs) {
  std::vector<Channel> out;
  for (const model::Controller& c : scene.controllers)
    for (std::size_t k = 0; k < c->outputs.size(); ++k) {
      const auto written = std::find_if(inputs.begin(), inputs.end(), [&](const Input& input) {
        return input.name == signal_of(c->outputs[k]).name;
      });
      out.push_back({"controllers/" + c->name + "/output" +
                         (c->outputs.size() > 1 ? "_" + std::to_string(k + 1) : ""),
                     1, written == inputs.end() ? "" : written->unit, "-",
                     "What the controller holds " + signal_of(c->outputs[k]).name + " at."});
    }
  return out;
}

Controllers::Controllers(const model::Scene& scene, const system::Regime& regime,
                         const std::vector<Channel>& channels, std::vector<Input>& inputs) {
  for (const model::Controller& c : scene.controllers) {
    One one;
    one.name = one.cost.name = c->name;
    one.period = c->period;
    one.delay = c->delay;
    one.outside = c.as<control::Outside>() != nullptr;
    control::Terminals terminals = find_terminals(c, channels, inputs);
    terminals.end_time = scene.solver.end_time;
    for (const control::Terminal& input : terminals.inputs)
      one.columns.push_back(input.name == time_input ? no_column
                                                     : find_column(channels, input.name));
    for (const control::Terminal& output : terminals.outputs) {
      one.inputs.push_back(&input_named(inputs, output.name));
      one.state.out.push_back(output.start);
    }
    one.in.resize(one.columns.size());
    one.state.swings.resize(one.state.out.size());
    one.law = make_law(c, terminals, regime);
    if (one.law->hears_crossings())
      one.crossing = std::make_unique<events::Crossing>(regime, terminals.inputs.front().name);
    if (c->lag > 0.0)
      for (const Input* input : one.inputs)
        input->follow(c->lag);
    one.terminals = std::move(terminals);
    all_.push_back(std::move(one));
  }
}

double Controllers::next_time() const {
  double first = INFINITY;
  for (const One& one : all_)
    first = std::min(
        {first, one.state.next, one.state.late.empty() ? INFINITY : one.state.late.front().first});
  return first;
}

double Controllers::limit(double end) const {
  const double next = next_time();
  return reached(end, next) ? end : next;
}

bool Controllers::One::is_due(double t, bool event) const {
  return reached(state.next, t) || (event && law->hears_events()) || law->is_due();
}

bool Controllers::is_due(double t, bool event) const {
  return reached(next_time(), t) || std::any_of(all_.begin(), all_.end(), [&](const One& one) {
           return one.is_due(t, event);
         });
}

std::vector<events::Source*> Controllers::sources() const {
  std::vector<events::Source*> out;
  for (const One& one : all_)
    if (one.crossing)
      out.push_back(one.crossing.get());
  return out;
}

void Controllers::accept(double t, const VectorX& y, const VectorX& yp) {
  for (One& one : all_)
    if (one.crossing && one.crossing->accept(t, y, yp))
      one.law->crossed(t);
}

bool Controllers::act(double t, bool event, std::span<const double> row) {
  for (One& one : all_)
    if (one.is_due(t, event))
      one.sample(t, row);
  bool changed = false;
  for (One& one : all_)
    changed = one.write(t) || changed;
  return changed;
}

/// Samples the law; the k-th instant is k T, without the rounding of a sum.
void Controllers::One::sample(double t, std::span<const double> row) {
  for (std::size_t k = 0; k < columns.size(); ++k)
    in[k] = terminals.inputs[k].to_own.back(columns[k] == no_column ? t : row[columns[k]]);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point before = Clock::now();
  law->sample(t, in, state.out);
  if (cost.calls++ > 0) // the first call also waits for the start of another program
    cost.time += std::chrono::duration<double>(Clock::now() - before).count();
  std::vector<double> answer; // answer in the units of the scene
  for (std::size_t k = 0; k < state.out.size(); ++k)
    try {
      answer.push_back(terminals.outputs[k].to_own.of(state.out[k]));
      check_value(*inputs[k], answer[k]);
    } catch (const CaseError& error) {
      throw SolverError(t,
                        {Reason::controller, "controller " + in_quotes(name) + ": " + error.what(),
                         "controllers/" + name});
    }
  for (std::size_t k = 0; k < answer.size(); ++k)
    state.swings[k].add(answer[k]);
  if (reached(state.next, t))
    ++state.count;
  const double own = law->next_time(t);
  state.next = std::isnan(own) ? static_cast<double>(state.count) * period : own;
  state.late.emplace_back(t + delay, std::move(answer));
}

/// @returns whether the value of an input has changed
bool Controllers::One::write(double t) {
  bool changed = false;
  for (; !state.late.empty() && reached(state.late.front().first, t); state.late.pop_front())
    for (std::size_t k = 0; k < inputs.size(); ++k)
      changed = inputs[k]->set(t, state.late.front().second[k]) || changed;
  return changed;
}

std::string Controllers::runaway() const {
  for (const One& one : all_)
    for (std::size_t k = 0; k < one.state.swings.size(); ++k)
      if (const SwingWatch::Growth g = one.state.swings[k].growth(); g.swings > 0)
        return "controller " + in_quotes(one.name) + " feeds the motion: over its last " +
               std::to_string(g.swings) + " swings what it holds " + one.inputs[k]->name +
               " at has grown from " + rounded_text(g.from) + " to " + rounded_text(g.to) + " " +
               one.inputs[k]->unit +
               ", ever by the same factor; its period or delay is too long for what it closes, or "
               "its gain has the wrong sign";
  return "";
}

std::vector<double> Controllers::held() const {
  std::vector<double> out;
  for (const One& one : all_)
    for (const Input* input : one.inputs)
      out.push_back(*input->value);
  return out;
}

std::vector<Controllers::Cost> Controllers::costs() const {
  std::vector<Cost> out;
  for (const One& one : all_)
    if (one.outside)
      out.push_back(one.cost);
  return out;
}

std::vector<std::string> Controllers::unit_notes() const {
  std::vector<std::string> out;
  for (const One& one : all_)
    for (const auto& notes : {run::unit_notes(one.name, one.terminals), one.law->unit_notes()})
      out.insert(out.end(), notes.begin(), notes.end());
  return out;
}

void Controllers::restored(double t) {
  for (One& one : all_)
    one.law->restored(t);
}

void Controllers::finish(const std::string& error) {
  for (One& one : all_)
    one.law->finish(error);
}

Controllers::State Controllers::state() {
  State out;
  for (One& one : all_) {
    out.push_back(one.state);
    out.back().law = one.law->state();
    if (one.crossing)
      out.back().crossing = one.crossing->state();
  }
  return out;
}

void Controllers::set(State state) {
  if (state.size() != all_.size())
    throw Error("the state has other controllers than the scene");
  for (std::size_t k = 0; k < all_.size(); ++k) {
    all_[k].state = std::move(state[k]);
    all_[k].law->set(all_[k].state.law);
    if (all_[k].crossing)
      all_[k].crossing->set(all_[k].state.crossing);
  }
}

} // namespace hydrodae::run
