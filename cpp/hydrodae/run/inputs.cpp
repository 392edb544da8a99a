#include "hydrodae/run/inputs.h"

#include <array>
#include <cmath>

#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"

namespace hydrodae::run {

namespace {

void add_take_offs(system::System& s, std::vector<Input>& out) {
  for (auto& f : std::get<0>(s.motion_forces)) {
    const bool angle = s.motions[static_cast<std::size_t>(f.motion)].motion.is_angle();
    const std::string head = "forces/" + f.component + "/";
    out.push_back({head + "damping", angle ? "N m s/rad" : "N s/m", &f.law.damping, 0.0});
    out.push_back({head + "stiffness", angle ? "N m/rad" : "N/m", &f.law.stiffness, 0.0});
    out.push_back({head + "neutral", angle ? "rad" : "m", &f.law.neutral});
  }
}

void add_constant_loads(const model::Scene& scene, system::System& s, std::vector<Input>& out) {
  static constexpr std::array<const char*, 6> parts{"force.x",  "force.y",  "force.z",
                                                    "moment.x", "moment.y", "moment.z"};
  for (const force::ConstantLoad& c : std::get<std::vector<force::ConstantLoad>>(scene.forces))
    for (auto& f : std::get<0>(s.body_forces))
      for (std::size_t k = 0; f.component == c.name && k < parts.size(); ++k)
        out.push_back({"forces/" + c.name + "/" + parts[k], k < 3 ? "N" : "N m",
                       &f.law.constant[static_cast<Eigen::Index>(k)]});
}

/// A rate that jumps takes the velocities with it at once, by an impulse of all rows. Stops that
/// push only, and friction that slips, would have to be asked first.
void add_rates(system::System& s, std::vector<Input>& out) {
  if (!s.switches.empty())
    return;
  for (system::CouplerData& c : s.couplers) {
    const auto motion = static_cast<std::size_t>(c.terms.front().motion);
    if (c.velocity_level && c.terms.size() == 1)
      out.push_back({"constraints/" + c.name + "/rate",
                     s.motions[motion].motion.is_angle() ? "rad/s" : "m/s", &c.drive.constant});
  }
}

} // namespace

std::vector<Input> find_inputs(const model::Scene& scene, system::System& system) {
  std::vector<Input> out;
  add_take_offs(system, out);
  add_constant_loads(scene, system, out);
  add_rates(system, out);
  return out;
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
