#include "hydrodae/run/inputs.h"

#include <algorithm>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::run {

namespace {

void add_forces(system::Regime& s, std::vector<Input>& out) {
  for (std::size_t i = 0; i < s.elements.size(); ++i) {
    const system::ElementList& list = s.elements[i];
    double* value = s.signals[i].data();
    for (std::size_t k = 0; k < list.ports.size(); ++k) {
      const int motion = list.ports[k].motion;
      const bool angle =
          motion >= 0 && s.motions[static_cast<std::size_t>(motion)].motion.is_angle();
      for (const element::Signal& signal : list.laws->inputs) {
        if (!signal.name.empty())
          out.push_back({list.laws->path(k, signal.name), element::unit_along(signal.unit, angle),
                         value, signal.least, &s.lags[i],
                         static_cast<std::size_t>(value - s.signals[i].data())});
        ++value;
      }
    }
  }
}

std::string static_name(const system::Regime& s, const system::SwitchData& friction) {
  const system::ElementList& list = s.elements[static_cast<std::size_t>(friction.list)];
  return "forces/" + list.laws->names[static_cast<std::size_t>(friction.law)] + "/static";
}

/// Inputs for the largest load of dry friction: a controller can lock a joint at rest and release
/// it.
void add_frictions(system::Regime& s, std::vector<Input>& out) {
  for (const system::SwitchData& friction : s.switches) {
    if (friction.kind != system::SwitchData::Kind::friction)
      continue;
    const bool angle = s.motions[static_cast<std::size_t>(friction.motion)].motion.is_angle();
    out.push_back({static_name(s, friction), angle ? "N m" : "N", &s.static_loads[friction.number],
                   0.0, nullptr, 0});
  }
}

/// Inputs for prescribed rates. A jump of a rate changes the velocities by an impulse of all rows,
/// so scenes with stops or friction have no such input: their switches would have to be solved,
/// too.
void add_rates(system::Regime& s, std::vector<Input>& out) {
  if (!s.switches.empty())
    return;
  for (std::size_t k = 0; k < s.couplers.size(); ++k) {
    const system::CouplerData& c = s.couplers[k];
    const auto motion = static_cast<std::size_t>(c.terms.front().motion);
    if (c.velocity_level && c.terms.size() == 1)
      out.push_back({"constraints/" + c.name + "/rate",
                     s.motions[motion].motion.is_angle() ? "rad/s" : "m/s", &s.rates[k], -INFINITY,
                     nullptr, 0});
  }
}

} // namespace

bool Input::set(double t, double target) const {
  if (*value == target)
    return false;
  if (system::Lag* own = lag()) {
    own->from = own->at(t, *value);
    own->since = t;
  }
  *value = target;
  return true;
}

void Input::follow(double time) const {
  lags->resize(std::max(lags->size(), number + 1));
  (*lags)[number] = {time, 0.0, *value};
}

std::vector<Input> find_inputs(system::Regime& regime) {
  std::vector<Input> out;
  add_forces(regime, out);
  add_frictions(regime, out);
  add_rates(regime, out);
  return out;
}

const system::SwitchData* find_friction(const system::Regime& s, const std::string& input) {
  for (const system::SwitchData& friction : s.switches)
    if (friction.kind == system::SwitchData::Kind::friction && static_name(s, friction) == input)
      return &friction;
  return nullptr;
}

Input& input_named(std::vector<Input>& inputs, const std::string& name) {
  std::vector<std::string> names;
  for (Input& input : inputs) {
    if (input.name == name)
      return input;
    names.push_back(input.name);
  }
  throw CaseError("there is no input " + in_quotes(name) + suggestion(name, names));
}

void check_value(const Input& input, double value) {
  if (!std::isfinite(value) || value < input.least)
    throw CaseError("input " + in_quotes(input.name) + " [" + input.unit + "]: expected a finite " +
                    std::string(std::isfinite(input.least) ? "number of at least 0" : "number") +
                    ", got " + number_text(value));
}

} // namespace hydrodae::run
