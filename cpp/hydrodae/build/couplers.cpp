/// Constraints of the case, and what holds at times only.

#include <cmath>

#include "hydrodae/build/parts.h"
#include "hydrodae/core/error.h"
#include "hydrodae/system/kinematics.h"

namespace hydrodae::build {

namespace {

void add_stop(const model::Constraint& c, system::System& s) {
  system::SwitchData stop;
  stop.motion = joint_motion(s, *c.joint, c.coordinate);
  stop.lower = c.lower ? *c.lower : c.lower_angle.value_or(-INFINITY);
  stop.upper = c.upper ? *c.upper : c.upper_angle.value_or(INFINITY);
  stop.restitution = c.restitution.value_or(0.0);
  stop.contact_time = c.contact_time;
  add_switch(c.name, stop, s);
}

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
    if (c.drive.python && !c.drive.function)
      throw ModelError("constraint." + c.name + ".drive.python",
                       "constraint '" + c.name +
                           "': its drive is a Python function, which nobody gave; run the case as "
                           "hydrodae.run(case, drives={\"" +
                           c.name + "\": function})");
    if (c.type == "stop") {
      add_stop(c, s);
      continue;
    }
    system::CouplerData coupler;
    coupler.name = c.name;
    coupler.drive = c.drive;
    coupler.velocity_level = c.level == "velocity";
    const int first = c.joint ? joint_motion(s, *c.joint, c.coordinate)
                              : body_motion(scene, *c.body, *c.coordinate, s);
    if (c.type == "coupler") { // s_b - ratio s = what it is at the start
      coupler.terms = {{joint_motion(s, *c.joint_b, c.coordinate_b), 1.0}, {first, -c.ratio}};
    } else {
      coupler.terms = {{first, 1.0}};
    }
    s.couplers.push_back(coupler);
  }
  add_ropes(scene, s);
}

void set_coupler_offsets(const model::Scene& scene, system::System& s) {
  const system::Workspace<double> start(s);
  for (std::size_t k = 0; k < s.couplers.size(); ++k) {
    if (k >= scene.constraints.size() || scene.constraints[k].type != "coupler")
      continue;
    s.couplers[k].offset = 0.0;
    for (const system::CouplerData::Term& term : s.couplers[k].terms)
      s.couplers[k].offset += term.factor * system::motion_row<double>(s, start, term.motion).value;
  }
}

} // namespace hydrodae::build
