#pragma once
/// Chambers of air on the joints of a scene, of units whose numbers are near one.

#include "hydrodae/joint/types.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::test {

/// Two pistons on one chamber and one on another, joined by a duct; a plug, and a turbine beyond
/// its stall. A third chamber is a network of its own, and shut.
inline void add_chambers(model::Scene& scene) {
  const std::string& type = scene.joints.front().type;
  const std::vector<std::string> motions = joint::motion_names(*joint::find_joint_type(type));
  if (motions.empty())
    return;
  scene.environment.air_pressure = 50.0;
  scene.environment.air_density = 1.2;
  const auto add = [&](const std::string& chamber, double volume,
                       const std::vector<std::string>& joints) {
    air::Chamber air;
    air.name = chamber;
    air.volume = volume;
    scene.chambers.push_back(air);
    for (const std::string& joint : joints) {
      air::Piston piston;
      piston.name = chamber + "-" + joint;
      piston.chamber = chamber;
      piston.joint = joint;
      piston.coordinate = joint == "link" ? motions.back() : motions.front();
      piston.area = joint == "link" ? 0.3 : 0.2;
      scene.pistons.push_back(piston);
    }
  };
  add("fore", 30.0, {"link", "anchor"});
  add("aft", 20.0, {"link"});
  add("shut", 25.0, {"anchor"});
  air::Orifice duct;
  duct.name = "duct";
  duct.chamber = "aft";
  duct.to = "fore";
  duct.coefficient = 0.6;
  duct.area = 0.2;
  air::PorousPlug plug;
  plug.name = "plug";
  plug.chamber = "fore";
  plug.conductance = 0.05;
  air::Wells turbine;
  turbine.name = "turbine";
  turbine.chamber = "aft";
  turbine.diameter = 0.7;
  turbine.speed = 3.0;
  turbine.flow_slope = 0.8;
  turbine.stall = 0.05;
  turbine.stall_slope = 1.6;
  turbine.efficiency_at = {0.0, 5.0, 1e6};
  turbine.efficiency = {0.1, 0.6, 0.2};
  turbine.inertia = 2.0;
  turbine.windage = 0.1;
  turbine.torque = 0.3;
  air::Biradial other;
  other.name = "other";
  other.chamber = "fore";
  other.diameter = 0.4;
  other.speed = 5.0;
  other.laminar = 0.1;
  air::Valve relief;
  relief.name = "relief";
  relief.chamber = "aft";
  relief.direction = "both";
  relief.coefficient = 0.5;
  relief.area = 0.1;
  relief.opens_at = 0.02;
  relief.shuts_at = 0.01;
  scene.outlets = {duct, plug, turbine, other, relief};
}

} // namespace hydrodae::test
