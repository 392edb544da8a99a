/// Constraints of the case, including those that hold only at times.

#include <cmath>

#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::build {

namespace {

/// One-sided distances, after the constraints of the case.
void add_ropes(const model::Scene& scene, system::System& s) {
  for (std::size_t k = 0; k < scene.joints.size(); ++k) {
    const model::Joint& joint = scene.joints[k];
    if (!joint.one_sided)
      continue;
    system::SwitchData rope;
    rope.motion = s.joints[k].first_motion;
    rope.upper = s.joints[k].parameters.length;
    rope.restitution = joint.restitution.value_or(0.0);
    rope.contact_time = joint.contact_time;
    add_switch(joint.name, rope, s);
  }
}

} // namespace

void add_switch(const std::string& name, system::SwitchData element, system::System& s) {
  system::CouplerData coupler;
  coupler.name = name;
  coupler.terms = {{element.motion, 1.0}};
  coupler.velocity_level = element.kind == system::SwitchData::Kind::friction;
  coupler.of_switch = static_cast<int>(s.switches.size());
  element.coupler = static_cast<int>(s.couplers.size());
  element.number = s.switches.size();
  s.couplers.push_back(coupler);
  s.switches.push_back(element);
}

void add_constraints(const model::Scene& scene, system::System& s) {
  for (const model::Constraint& c : scene.constraints) {
    const model::Condition asked = c.visit([](const auto& one) { return one.condition(); });
    if (asked.drive.python && !asked.drive.function)
      throw ModelError("constraint." + c->name + ".drive.python",
                       "constraint '" + c->name +
                           "': its drive is a Python function, which nobody gave; run the case as "
                           "hydrodae.run(case, drives={\"" +
                           c->name + "\": function})");
    std::vector<system::CouplerData::Term> terms;
    for (const model::Condition::Term& term : asked.terms)
      terms.push_back({term.joint ? joint_motion(s, *term.joint, term.coordinate)
                                  : body_motion(scene, *term.body, *term.coordinate, s),
                       term.factor});
    if (asked.bounds) {
      system::SwitchData stop;
      stop.motion = terms.front().motion;
      stop.lower = asked.bounds->lower;
      stop.upper = asked.bounds->upper;
      stop.restitution = asked.bounds->restitution;
      stop.contact_time = asked.bounds->contact_time;
      add_switch(c->name, stop, s);
      continue;
    }
    system::CouplerData coupler;
    coupler.name = c->name;
    coupler.drive = asked.drive;
    coupler.velocity_level = asked.velocity_level;
    coupler.keeps_start = asked.keeps_start;
    coupler.terms = std::move(terms);
    s.couplers.push_back(coupler);
  }
  add_ropes(scene, s);
}

void set_coupler_offsets(system::System& s) {
  const system::Workspace<double> start(s);
  for (system::CouplerData& coupler : s.couplers) {
    if (!coupler.keeps_start)
      continue;
    coupler.offset = 0.0;
    for (const system::CouplerData::Term& term : coupler.terms)
      coupler.offset += term.factor * system::motion_row<double>(s, start, term.motion).value;
  }
}

} // namespace hydrodae::build
