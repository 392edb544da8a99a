#include "hydrodae/model/controller.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/core/unit.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

using Keys = std::vector<std::string>;

/// What a type of controller reads and writes.
struct Arity {
  std::size_t least_inputs, most_inputs, outputs; ///< outputs 0: one or more
  const char* meaning;
};

Arity arity(const std::string& type) {
  constexpr std::size_t many = 1000;
  if (type == "pid")
    return {1, 2, 1, "what it holds at its target, then its target where that is a channel"};
  if (type == "reactive")
    return {2, 2, 1, "a coordinate and its rate"};
  if (type == "resistive")
    return {1, 1, 1, "a rate"};
  if (type == "latching")
    return {1, 1, 1, "the rate of a joint"};
  if (type == "bang_bang")
    return {1, 2, 1, "what it holds at its target, then its target where that is a channel"};
  if (type == "declutching")
    return {1, 1, 1, "the rate of a joint"};
  if (type == "table")
    return {1, 1, 1, "the channel of which it is a function"};
  return {0, many, 0, "channels"};
}

/// A key of another type of controller would do nothing.
void check_own_keys(const Scene& scene, const Entry& entry, const Controller& c) {
  const Keys own = controller_keys(c.type);
  const std::string head = "controller." + c.name + ".";
  for (auto at = scene.positions.lower_bound(head);
       at != scene.positions.end() && at->first.starts_with(head); ++at) {
    const std::string key = at->first.substr(head.size());
    if (std::find(own.begin(), own.end(), key) == own.end())
      refuse(entry, key,
             "a " + c.type + " controller has no key " + in_quotes(key) + suggestion(key, own));
  }
}

void check_lookup(const Entry& entry, const Controller& c) {
  if (c.at.size() < 2 || c.at.size() != c.value.size())
    refuse(entry, "at", "'at' and 'value' must have as many numbers, two or more");
  for (std::size_t k = 1; k < c.at.size(); ++k)
    if (!(c.at[k] > c.at[k - 1]))
      refuse(entry, "at", "'at' must ascend");
}

void check_fmu(const Entry& entry, const Controller& c) {
  const auto match = [&](const char* key, std::size_t n, const char* other, std::size_t wanted) {
    if (n != wanted)
      refuse(entry, key,
             in_quotes(key) + " must have as many as " + in_quotes(other) + ": " +
                 std::to_string(wanted) + ", it has " + std::to_string(n));
  };
  if (c.file.empty())
    refuse(entry, "file", "an fmu controller needs the key 'file'");
  match("fmu_inputs", c.fmu_inputs.size(), "inputs", c.inputs.size());
  match("fmu_outputs", c.fmu_outputs.size(), "outputs", c.outputs.size());
  match("parameter_values", c.parameter_values.size(), "parameters", c.parameters.size());
  match("text_values", c.text_values.size(), "text_parameters", c.text_parameters.size());
  if (!c.fmu_factors.empty())
    match("fmu_factors", c.fmu_factors.size(), "outputs", c.outputs.size());
}

void check_limits(const Entry& entry, const Controller& c) {
  if (c.lower && c.upper && *c.lower > *c.upper)
    refuse(entry, "lower", "'lower' is above 'upper'");
}

void check_pid(const Entry& entry, const Controller& c) {
  check_limits(entry, c);
  const bool limited = c.lower || c.upper;
  if (limited && c.gain_i != 0.0 && c.gain_p == 0.0 && !c.tracking_time)
    refuse(entry, "tracking_time",
           "an integral within limits needs the key 'tracking_time', as there is no gain_p to take "
           "it from");
}

} // namespace

Fields<Controller> Controller::fields() {
  using C = Controller;
  return {
      {"name", &C::name, "-", "Name of the controller in the results.", true},
      {"type",
       &C::type,
       "-",
       "Kind of controller.",
       true,
       any_value,
       {"pid", "reactive", "resistive", "bang_bang", "latching", "declutching", "table", "python",
        "tcp", "fmu"}},
      {"inputs", &C::inputs, "-",
       "Channels that it reads, as in the results; of a vector one component: "
       "\"bodies/float/velocity.z\". In another unit of the same dimension where one stands behind "
       "the name: \"joints/hinge/angle [deg]\"."},
      {"outputs", &C::outputs, "-",
       "Inputs of the scene that it writes, such as \"forces/pto/load\" (hydrodae check lists "
       "them); \"forces/pto/load [kN]\" where it answers in another unit.",
       true},
      {"period", &C::period, "s", "Time T between two sampling instants; the first is the start.",
       true, more_than(0, longest_time)},
      {"delay", &C::delay, "s", "Time from a sampling instant to the one when its answer holds.",
       false, at_least(0, longest_time)},
      {"lag", &C::lag, "s",
       "Time constant of the actuator: its output follows what the controller holds like a filter "
       "of first order.",
       false, at_least(0, longest_time)},
      {"gain_p", &C::gain_p, "out per in", "Proportional gain Kp."},
      {"gain_i", &C::gain_i, "out per in and s", "Integral gain Ki."},
      {"gain_d", &C::gain_d, "out s per in", "Derivative gain Kd."},
      {"filter_time", &C::filter_time, "s",
       "Time constant of the filter of first order on the derivative.", false, at_least(0)},
      {"target", &C::target, "unit of the input",
       "What the input is to be, where no second input tells it."},
      {"lower", &C::lower, "unit of the output", "Least output."},
      {"upper", &C::upper, "unit of the output", "Largest output."},
      {"tracking_time", &C::tracking_time, "s",
       "Time in which the integral follows an output at its limit (back-calculation); default "
       "|Kp / Ki|.",
       false, more_than(0)},
      {"stiffness", &C::stiffness, "N/m or N m/rad", "Stiffness K; negative: it pushes away."},
      {"damping", &C::damping, "N s/m or N m s/rad", "Damping C."},
      {"neutral", &C::neutral, "m or rad", "Coordinate s0 at which the spring is slack."},
      {"limit", &C::limit, "N or N m", "Largest load, either way.", false, more_than(0)},
      {"band", &C::band, "unit of the input",
       "Half width of the hysteresis: within it the output stays.", false, at_least(0)},
      {"engaged", &C::engaged, "unit of the output", "Output while the machine works."},
      {"free", &C::free, "unit of the output", "Output while the machine is free."},
      {"free_time", &C::free_time, "s", "How long it is free from a standstill on.", false,
       more_than(0)},
      {"hold_time", &C::hold_time, "s", "How long it holds from the standstill on.", false,
       more_than(0)},
      {"hold_load", &C::hold_load, "N or N m", "Largest load that it holds.", false, more_than(0)},
      {"at", &C::at, "unit of the input", "Values of the input, ascending."},
      {"value", &C::value, "unit of the output",
       "Outputs there; beyond the ends those at the ends."},
      {"file", &C::file, "-", "FMU for co-simulation, version 2.0 or 3.0 of FMI."},
      {"fmu_inputs", &C::fmu_inputs, "-", "Its input for each of `inputs`."},
      {"fmu_outputs", &C::fmu_outputs, "-", "Its output for each of `outputs`."},
      {"fmu_factors", &C::fmu_factors, "unit of the output per that of the FMU",
       "What each of these is multiplied by; default 1."},
      {"parameters", &C::parameters, "-",
       "Numbers, booleans (0 or 1) and enumerations of it that are set before the start."},
      {"parameter_values", &C::parameter_values, "as the FMU says", "Their values."},
      {"text_parameters", &C::text_parameters, "-", "Strings of it that are set before the start."},
      {"text_values", &C::text_values, "-", "Their values."},
      {"protocol",
       &C::protocol,
       "-",
       "hydrodae: a handshake with names and units, then numbered frames; hotint: bare numbers "
       "with a flag (docs/tcp.md).",
       false,
       any_value,
       {"hydrodae", "hotint"}},
      {"role",
       &C::role,
       "-",
       "server: the other program connects to the run; client: the run connects to it.",
       false,
       any_value,
       {"server", "client"}},
      {"host", &C::host, "-", "Address at which a server listens, or to which a client connects."},
      {"port", &C::port, "-", "TCP port.", false, between(1, 65535)},
      {"timeout", &C::timeout, "s", "Longest wait for an answer.", false, more_than(0, 1e6)},
      {"connect_timeout", &C::connect_timeout, "s",
       "Longest wait for the other program to be there.", false, more_than(0, 1e6)},
  };
}

Keys controller_keys(const std::string& type) {
  Keys keys = {"name", "type", "inputs", "outputs", "period", "delay", "lag"};
  const auto with = [&](const Keys& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
  };
  if (type == "pid")
    return with(
        {"gain_p", "gain_i", "gain_d", "filter_time", "target", "lower", "upper", "tracking_time"});
  if (type == "reactive")
    return with({"stiffness", "damping", "neutral", "limit"});
  if (type == "resistive")
    return with({"damping", "limit"});
  if (type == "bang_bang")
    return with({"target", "band", "lower", "upper"});
  const Keys at_once = {"name", "type", "inputs", "outputs", "period"};
  if (type == "latching") {
    keys = at_once;
    return with({"hold_time", "hold_load"});
  }
  if (type == "declutching") {
    keys = at_once;
    return with({"engaged", "free", "free_time", "lag"});
  }
  if (type == "table")
    return with({"at", "value"});
  if (type == "python")
    return keys;
  if (type == "fmu")
    return with({"file", "fmu_inputs", "fmu_outputs", "fmu_factors", "parameters",
                 "parameter_values", "text_parameters", "text_values"});
  if (type == "tcp")
    return with({"protocol", "role", "host", "port", "timeout", "connect_timeout"});
  return {};
}

Keys needed_controller_keys(const std::string& type) {
  if (type == "latching")
    return {"inputs", "hold_time", "hold_load"};
  if (type == "bang_bang")
    return {"inputs", "lower", "upper"};
  if (type == "declutching")
    return {"inputs", "engaged", "free_time"};
  if (type == "table")
    return {"inputs", "at", "value"};
  if (type == "fmu")
    return {"file", "fmu_outputs"};
  return type == "python" || type == "tcp" ? Keys{} : Keys{"inputs"};
}

bool is_outside(const Controller& controller) {
  return controller.type == "python" || controller.type == "tcp" || controller.type == "fmu";
}

void check_controller(const Scene& scene, const Controller& c) {
  const Entry entry{"controller", c.name};
  check_own_keys(scene, entry, c);
  constexpr double most_samples = 1e9;
  if (scene.solver.end_time > most_samples * c.period)
    refuse(entry, "period",
           "'period' = " + number_text(c.period) + " s takes " +
               number_text(scene.solver.end_time / c.period) +
               " samples until the end of the run (solver.end_time); at most 1e9");
  const Arity a = arity(c.type);
  if (c.inputs.size() < a.least_inputs || c.inputs.size() > a.most_inputs)
    refuse(entry, "inputs",
           "'inputs' of a " + c.type + " controller must name " + a.meaning + "; it has " +
               std::to_string(c.inputs.size()));
  if (c.outputs.empty() || (a.outputs > 0 && c.outputs.size() != a.outputs))
    refuse(entry, "outputs",
           a.outputs > 0 ? "a " + c.type + " controller has one output" : "it has no output");
  for (std::size_t k = 0; k < c.outputs.size(); ++k)
    for (const Controller& other : scene.controllers)
      for (std::size_t i = 0; i < other.outputs.size(); ++i)
        if (signal_of(other.outputs[i]).name == signal_of(c.outputs[k]).name &&
            (&other != &c || i != k))
          refuse(entry, "outputs",
                 in_quotes(signal_of(c.outputs[k]).name) + " is written twice" +
                     (&other != &c ? ", by controller " + in_quotes(other.name) + " too" : ""));
  if (c.type == "pid")
    check_pid(entry, c);
  if (c.type == "fmu")
    check_fmu(entry, c);
  if (c.type == "table")
    check_lookup(entry, c);
  const auto needs = [&](const char* key, const std::optional<double>& value) {
    if (!value)
      refuse(entry, key, "a " + c.type + " controller needs the key " + in_quotes(key));
  };
  if (c.type == "latching") {
    needs("hold_time", c.hold_time);
    needs("hold_load", c.hold_load);
  }
  if (c.type == "declutching") {
    needs("engaged", c.engaged);
    needs("free_time", c.free_time);
  }
  if (c.type == "bang_bang") {
    needs("lower", c.lower);
    needs("upper", c.upper);
    check_limits(entry, c);
  }
}

} // namespace hydrodae::model
