#include "hydrodae/run/controllers.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "hydrodae/control/bang_bang.h"
#include "hydrodae/control/declutching.h"
#include "hydrodae/control/latching.h"
#include "hydrodae/control/pid.h"
#include "hydrodae/control/reactive.h"
#include "hydrodae/control/table.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::run {

namespace {

std::unique_ptr<control::Law> make_pid(const model::Controller& c) {
  control::Pid::Gains g;
  g.p = c.gain_p;
  g.i = c.gain_i;
  g.d = c.gain_d;
  g.target = c.target;
  g.period = c.period;
  g.filter_time = c.filter_time;
  const double own = c.gain_p != 0.0 && c.gain_i != 0.0 ? std::abs(c.gain_p / c.gain_i) : INFINITY;
  g.tracking_time = c.tracking_time.value_or(own);
  g.lower = c.lower.value_or(-INFINITY);
  g.upper = c.upper.value_or(INFINITY);
  return std::make_unique<control::Pid>(g);
}

/// The friction whose largest load it writes must be on the joint whose rate it reads.
std::unique_ptr<control::Law> make_latching(const model::Controller& c,
                                            const system::Regime& regime) {
  const auto refuse = [&](const char* key, const std::string& wrong, const std::string& expected) {
    throw ModelError("controller." + c.name + "." + key, "controller " + in_quotes(c.name) + ": " +
                                                             in_quotes(wrong) + " is not " +
                                                             expected);
  };
  const system::SwitchData* friction = find_friction(regime, signal_of(c.outputs.front()).name);
  if (!friction)
    refuse("outputs", c.outputs.front(),
           "the 'static' of a dry_friction, by which a latch holds: \"forces/NAME/static\"");
  const system::MotionData& motion = regime.motions[static_cast<std::size_t>(friction->motion)];
  const std::string rate = "joints/" + regime.joints[static_cast<std::size_t>(motion.joint)].name +
                           "/" + motion.name + "_rate";
  if (signal_of(c.inputs.front()).name != rate)
    refuse("inputs", c.inputs.front(), "the rate of the joint that it holds, " + in_quotes(rate));
  return std::make_unique<control::Latching>(
      *c.hold_load, *c.hold_time, c.period,
      [&regime, friction] { return regime.mode(*friction) == system::SwitchData::State::stick; });
}

std::unique_ptr<control::Law> make_law(const model::Controller& c,
                                       const control::Terminals& terminals,
                                       const system::Regime& regime) {
  if (c.make)
    return c.make(terminals);
  if (model::is_outside(c))
    throw ModelError("controller." + c.name,
                     "controller " + in_quotes(c.name) +
                         " is a Python function, which nobody "
                         "gave; run the case as hydrodae.run(case, controllers={\"" +
                         c.name + "\": function})");
  const double limit = c.limit.value_or(INFINITY);
  if (c.type == "pid")
    return make_pid(c);
  if (c.type == "reactive")
    return std::make_unique<control::Reactive>(c.stiffness, c.damping, c.neutral, limit);
  if (c.type == "resistive")
    return std::make_unique<control::Resistive>(c.damping, limit);
  if (c.type == "bang_bang")
    return std::make_unique<control::BangBang>(c.target, c.band, *c.lower, *c.upper);
  if (c.type == "latching")
    return make_latching(c, regime);
  if (c.type == "declutching")
    return std::make_unique<control::Declutching>(*c.engaged, c.free, *c.free_time, c.period);
  return std::make_unique<control::Table>(c.at, c.value);
}

/// The channel behind a name with a component, "velocity.z"; its own name where it has one number.
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

/// A channel or input of the scene, in the unit that stands behind its name or in its own.
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

/// Are numbers in one unit the same in the other?
bool same_unit(const std::string& a, const std::string& b) {
  const std::optional<Unit> one = unit_of(a), other = unit_of(b);
  if (!one || !other)
    return a == b;
  const std::optional<Conversion> between = conversion(*one, *other);
  return between && between->is_none();
}

/// The units in which a law of the kernel's own computes: two inputs of one kind, or a coordinate,
/// its rate and a load in SI units, as its keys are.
void require_units_of_law(const model::Controller& c, const control::Terminals& t) {
  const auto refuse = [&](const char* key, const std::string& why) {
    throw ModelError("controller." + c.name + "." + key,
                     "controller " + in_quotes(c.name) + ": " + why);
  };
  const auto told = [](const control::Terminal& of) {
    return in_quotes(of.name) + " is in " + in_quotes(of.unit);
  };
  if ((c.type == "pid" || c.type == "bang_bang") && t.inputs.size() == 2 &&
      !same_unit(t.inputs[0].unit, t.inputs[1].unit))
    refuse("inputs", told(t.inputs[1]) + ", and cannot be the target of " +
                         in_quotes(t.inputs[0].name) + ", which is in " +
                         in_quotes(t.inputs[0].unit));
  const bool reactive = c.type == "reactive", resistive = c.type == "resistive";
  if (!reactive && !resistive && c.type != "latching")
    return;
  for (const auto* terminals : {&t.inputs, &t.outputs})
    for (const control::Terminal& one : *terminals)
      if (!one.to_own.is_none())
        refuse(terminals == &t.inputs ? "inputs" : "outputs",
               "the keys of a " + c.type + " controller are in SI units; leave '[" + one.unit +
                   "]' away");
  if (c.type == "latching")
    return;
  const std::string& rate = t.inputs.back().own_unit;
  if (rate != "m/s" && rate != "rad/s")
    refuse("inputs", told(t.inputs.back()) + "; a " + c.type +
                         " controller takes a rate there, in m/s or rad/s");
  if (reactive && t.inputs[0].own_unit + "/s" != rate)
    refuse("inputs", told(t.inputs[0]) +
                         "; a reactive controller takes the coordinate of the rate " +
                         in_quotes(t.inputs[1].name) + " there, in " +
                         in_quotes(rate.substr(0, rate.size() - 2)));
  if (t.outputs[0].own_unit != "N" && t.outputs[0].own_unit != "N m")
    refuse("outputs",
           told(t.outputs[0]) + "; a " + c.type + " controller answers with a load, in N or N m");
}

/// Is an instant reached at t? Those that differ by the rounding of k T or t + delay are one.
bool reached(double instant, double t) {
  constexpr double rounding = 32.0 * std::numeric_limits<double>::epsilon();
  return instant <= t * (1.0 + rounding);
}

} // namespace

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
    for (const std::string& text : controller.inputs) {
      const SignalName named = signal_of(text);
      std::size_t column = find_column(channels, named.name); // or refuses
      out.inputs.push_back(terminal(named, find_channel(channels, named.name, column)->unit, 0.0));
    }
    key = "outputs";
    for (const std::string& text : controller.outputs) {
      const SignalName named = signal_of(text);
      const Input& input = input_named(inputs, named.name);
      if (controller.lag > 0.0 && !input.lags)
        throw CaseError("input " + in_quotes(named.name) +
                        " jumps at events, and cannot follow a 'lag'");
      out.outputs.push_back(terminal(named, input.unit, *input.value));
    }
  } catch (const CaseError& error) {
    throw ModelError("controller." + controller.name + "." + key,
                     "controller " + in_quotes(controller.name) + ": " + error.what());
  }
  require_units_of_law(controller, out);
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

std::vector<Channel> held_channels(const model::Scene& scene, const std::vector<Input>& inputs) {
  std::vector<Channel> out;
  for (const model::Controller& c : scene.controllers)
    for (std::size_t k = 0; k < c.outputs.size(); ++k) {
      const auto written = std::find_if(inputs.begin(), inputs.end(), [&](const Input& input) {
        return input.name == signal_of(c.outputs[k]).name;
      });
      out.push_back({"controllers/" + c.name + "/output" +
                         (c.outputs.size() > 1 ? "_" + std::to_string(k + 1) : ""),
                     1, written == inputs.end() ? "" : written->unit, "-",
                     "What the controller holds " + signal_of(c.outputs[k]).name + " at."});
    }
  return out;
}

Controllers::Controllers(const model::Scene& scene, const system::Regime& regime,
                         const std::vector<Channel>& channels, std::vector<Input>& inputs) {
  for (const model::Controller& c : scene.controllers) {
    One one;
    one.name = one.cost.name = c.name;
    one.period = c.period;
    one.delay = c.delay;
    one.outside = model::is_outside(c);
    control::Terminals terminals = find_terminals(c, channels, inputs);
    terminals.end_time = scene.solver.end_time;
    for (const control::Terminal& input : terminals.inputs)
      one.columns.push_back(find_column(channels, input.name));
    for (const control::Terminal& output : terminals.outputs) {
      one.inputs.push_back(&input_named(inputs, output.name));
      one.out.push_back(output.start);
    }
    one.in.resize(one.columns.size());
    one.swings.resize(one.out.size());
    one.law = make_law(c, terminals, regime);
    if (one.law->hears_crossings())
      one.crossing = std::make_unique<events::Crossing>(regime, terminals.inputs.front().name);
    if (c.lag > 0.0)
      for (const Input* input : one.inputs)
        input->follow(c.lag);
    one.terminals = std::move(terminals);
    all_.push_back(std::move(one));
  }
}

double Controllers::next_time() const {
  double first = INFINITY;
  for (const One& one : all_)
    first = std::min({first, one.next, one.late.empty() ? INFINITY : one.late.front().first});
  return first;
}

double Controllers::limit(double end) const {
  const double next = next_time();
  return reached(end, next) ? end : next;
}

bool Controllers::One::is_due(double t, bool event) const {
  return reached(next, t) || (event && law->hears_events()) || law->is_due();
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

/// The k-th instant is k T, without the rounding of a sum.
void Controllers::One::sample(double t, std::span<const double> row) {
  for (std::size_t k = 0; k < columns.size(); ++k)
    in[k] = terminals.inputs[k].to_own.back(row[columns[k]]);
  using Clock = std::chrono::steady_clock;
  const Clock::time_point before = Clock::now();
  law->sample(t, in, out);
  if (cost.calls++ > 0) // the first waits for another program to be there
    cost.time += std::chrono::duration<double>(Clock::now() - before).count();
  std::vector<double> answer; // in the units of the scene
  for (std::size_t k = 0; k < out.size(); ++k)
    try {
      answer.push_back(terminals.outputs[k].to_own.of(out[k]));
      check_value(*inputs[k], answer[k]);
    } catch (const CaseError& error) {
      throw SolverError(t, "stopped at t = " + number_text(t) + " s: controller " +
                               in_quotes(name) + ": " + error.what());
    }
  for (std::size_t k = 0; k < answer.size(); ++k)
    swings[k].add(answer[k]);
  if (reached(next, t))
    ++count;
  const double own = law->next_time(t);
  next = std::isnan(own) ? static_cast<double>(count) * period : own;
  late.emplace_back(t + delay, std::move(answer));
}

/// @returns whether an input has another value now
bool Controllers::One::write(double t) {
  bool changed = false;
  for (; !late.empty() && reached(late.front().first, t); late.pop_front())
    for (std::size_t k = 0; k < inputs.size(); ++k)
      changed = inputs[k]->set(t, late.front().second[k]) || changed;
  return changed;
}

std::string Controllers::runaway() const {
  for (const One& one : all_)
    for (std::size_t k = 0; k < one.swings.size(); ++k)
      if (const SwingWatch::Growth g = one.swings[k].growth(); g.swings > 0)
        return "controller " + in_quotes(one.name) + " feeds the motion: over its last " +
               std::to_string(g.swings) + " swings what it holds " + one.inputs[k]->name +
               " at has grown from " + rounded_text(g.from) + " to " + rounded_text(g.to) + " " +
               one.inputs[k]->unit +
               ", ever by the same factor; its period or delay is too long for what it closes, or "
               "its gain has the wrong sign";
  return "";
}

void Controllers::fill(double*& out) const {
  for (const One& one : all_)
    for (const Input* input : one.inputs)
      *out++ = *input->value;
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

void Controllers::One::remember(Archive& a) {
  a(next, count, out, late, swings, *law);
  if (crossing)
    a(*crossing);
}

void Controllers::remember(Archive& a) {
  for (One& one : all_)
    one.remember(a);
}

} // namespace hydrodae::run
