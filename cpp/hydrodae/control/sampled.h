#pragma once
/// Common members of every table [[controller]].

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/control/law.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/field.h"
#include "hydrodae/core/text.h"

namespace hydrodae::control {

/// Number of channels and inputs of the scene that a controller names.
struct Arity {
  std::size_t least_inputs = 0, most_inputs = 1000, outputs = 0; ///< outputs = 0: one or more
  const char* meaning = "channels";
};

/// Dry friction on a joint whose largest load a controller writes.
struct Friction {
  /// Rate of the joint as a channel: "joints/slide/displacement_rate"
  std::string rate;
  std::function<bool()> sticks; ///< returns whether the joint sticks now
};

/// Connections of a controller in a run.
struct Place {
  const Terminals& terminals;
  std::optional<Friction> friction; ///< friction whose largest load is its first output
};

/// Controller that reads channels at fixed instants k T, and holds inputs from k T + delay on
/// (zero-order hold). A type of controller is a struct that derives from this one, with
///
///   type, doc, fields()               as every typed table (core/one_of.h)
///   static constexpr Arity arity      number of its inputs and outputs
///   law(Place)                        its law for one run; throws ModelError
///   fault()                           optional: fault in its values
///   fault(Terminals)                  optional: fault in the units of its terminals
///
/// and one entry in the list of model/controller.h.
struct Sampled {
  static constexpr std::string_view list_doc =
      "A sampled controller: it reads channels, and holds inputs between its instants.";
  std::string name;
  std::vector<std::string> inputs, outputs;
  double period = 0.0, delay = 0.0, lag = 0.0;
};

enum class Inputs { optional, required };

/// Fields for name, inputs, outputs and period.
template <class C> Fields<C> sampled_fields(Inputs inputs = Inputs::required) {
  return {
      {"name", &C::name, "-", "Name of the controller in the results.", true},
      {"inputs", &C::inputs, "-",
       "Channels that it reads, as in the results; of a vector one component: "
       "\"bodies/float/velocity.z\". In another unit of the same dimension where one stands behind "
       "the name: \"joints/hinge/angle [deg]\". \"time\" is the time.",
       inputs == Inputs::required},
      {"outputs", &C::outputs, "-",
       "Inputs of the scene that it writes, such as \"forces/pto/load\" (hydrodae check lists "
       "them); \"forces/pto/load [kN]\" where it answers in another unit.",
       true},
      {"period", &C::period, "s", "Time T between two sampling instants; the first is the start.",
       true, more_than(0, longest_time)},
  };
}

template <class C> Fields<C> delay_field() {
  return {{"delay", &C::delay, "s",
           "Time from a sampling instant to the one when its answer holds.", false,
           at_least(0, longest_time)}};
}

template <class C> Fields<C> lag_field() {
  return {{"lag", &C::lag, "s",
           "Time constant of the actuator: its output follows what the controller holds like a "
           "filter of first order.",
           false, at_least(0, longest_time)}};
}

/// Fields of all these, with delay and lag.
template <class C> Fields<C> usual_fields(Inputs inputs = Inputs::required) {
  return sampled_fields<C>(inputs) + delay_field<C>() + lag_field<C>();
}

/// Returns whether two units are equal.
inline bool same_unit(const std::string& a, const std::string& b) {
  const std::optional<Unit> one = unit_of(a), other = unit_of(b);
  if (!one || !other)
    return a == b;
  const std::optional<Conversion> between = conversion(*one, *other);
  return between && between->is_none();
}

inline std::string with_unit(const Terminal& t) {
  return in_quotes(t.name) + " is in " + in_quotes(t.unit);
}

/// Checks that a second input, the target of the first one, has the same unit.
inline std::optional<Fault> target_fault(const Terminals& t) {
  if (t.inputs.size() == 2 && !same_unit(t.inputs[0].unit, t.inputs[1].unit))
    return Fault{"inputs", with_unit(t.inputs[1]) + ", and cannot be the target of " +
                               in_quotes(t.inputs[0].name) + ", which is in " +
                               in_quotes(t.inputs[0].unit)};
  return {};
}

/// Checks that a law with keys in SI units has terminals in these.
inline std::optional<Fault> si_fault(const Terminals& t, const std::string& type) {
  for (const auto* terminals : {&t.inputs, &t.outputs})
    for (const Terminal& one : *terminals)
      if (!one.to_own.is_none())
        return Fault{terminals == &t.inputs ? "inputs" : "outputs",
                     "the keys of a " + type + " controller are in SI units; leave '[" + one.unit +
                         "]' away"};
  return {};
}

/// Checks that the last input is a rate and the output the corresponding load.
inline std::optional<Fault> rate_fault(const Terminals& t, const std::string& type) {
  if (const std::optional<Fault> fault = si_fault(t, type))
    return fault;
  const std::string& rate = t.inputs.back().own_unit;
  if (rate != "m/s" && rate != "rad/s")
    return Fault{"inputs", with_unit(t.inputs.back()) + "; a " + type +
                               " controller takes a rate there, in m/s or rad/s"};
  if (t.outputs[0].own_unit != "N" && t.outputs[0].own_unit != "N m")
    return Fault{"outputs", with_unit(t.outputs[0]) + "; a " + type +
                                " controller answers with a load, in N or N m"};
  return {};
}

/// Arity of a law that holds its input at a target.
inline constexpr Arity of_target = {
    1, 2, 1, "what it holds at its target, then its target where that is a channel"};

} // namespace hydrodae::control
