#pragma once
/// Scenes that together contain every joint type, every force type, every kind of body and both
/// hydrodynamic axes, made from the type lists themselves.

#include <memory>
#include <string>
#include <vector>

#include "chambers.h"
#include "databases.h"
#include "forces.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/deformation.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/jacobian.h"
#include "hydrodae/water/excitation.h"

namespace hydrodae::test {

/// Two bodies "a" and "b" on a joint "link" of the given type, "a" also held by the same type of
/// joint to the ground ("anchor").
inline model::Scene two_bodies(const joint::JointType& type, const std::vector<std::string>& motion,
                               Random& random) {
  model::Scene scene;
  scene.solver.end_time = 1.0;
  scene.solver.force = true; // the made-up memories are not passive
  for (int i = 0; i < 2; ++i) {
    model::Body body;
    body.name = i == 0 ? "a" : "b";
    body.motion = motion;
    body.mass = 2.0 + i;
    body.center_of_gravity = i == 0 ? Vector3(0, 0, 0) : Vector3(2.0, 0.5, -1.0);
    body.inertia = {0.5, 0.7 + i, 0.9};
    body.products_of_inertia = 0.05 * random.vector();
    scene.bodies.push_back(body);
  }
  const bool planar = motion.size() == 1 && motion[0] == "planar";
  const bool lies_in_plane = !type.turns() || type.name == "universal";
  auto add = [&](const std::string& name, const std::string& a, const std::string& b,
                 const Vector3& p) {
    model::Joint joint;
    joint.name = name;
    joint.type = std::string(type.name);
    joint.body_a = a;
    joint.body_b = b;
    joint.point = p;
    if (type.has_two_points())
      joint.point_b = p + Vector3(0.3, 0.0, 0.4);
    joint.pitch = 0.3;
    if (type.has_row<joint::AcrossRow>())
      for (int k = 0; k < 9; ++k)
        joint.path.push_back(p + Vector3(k - 4.0, planar ? 0.0 : 0.1 * std::sin(k), 0.1 * (k % 2)));
    if (planar)
      joint.axis = lies_in_plane ? Vector3(0.6, 0.0, 0.8) : Vector3(0, 1, 0);
    else
      joint.axis = Vector3(random.vector() + Vector3(0, 0, 2)).normalized();
    scene.joints.push_back(joint);
  };
  add("link", "a", "b", planar ? Vector3(1.0, 0.0, -0.4) : Vector3(1.0, 0.2, -0.4));
  add("anchor", "ground", "a", planar ? Vector3(-0.7, 0.0, 0.3) : Vector3(-0.7, -0.1, 0.3));
  return scene;
}

inline void add_hydro(model::Scene& scene, const std::string& axes, const std::string& radiation,
                      Random& random) {
  scene.database = random_database(random);
  scene.hydro = model::HydroOptions{};
  scene.hydro->axes = axes;
  scene.hydro->radiation = radiation;
  if (radiation == "constant")
    scene.hydro->frequency = 1.2;
  scene.waves.push_back(swell());
  for (model::Body& body : scene.bodies)
    body.hydro = body.name;
}

/// A mode of the first body, whose mass, motions and water are coupled with it.
inline void add_mode(model::Scene& scene, Random& random) {
  scene.database = random_database(random, {"bend"});
  model::Mode mode;
  mode.name = "bend";
  mode.body = scene.bodies.front().name;
  mode.mass = 0.4;
  mode.stiffness = 3.0;
  mode.mass_with_motions.resize(6);
  for (double& mass : mode.mass_with_motions)
    mass = 0.01 * random();
  scene.modes.push_back(mode);
  model::add_parts(scene);
}

/// Tables of both bodies over one coordinate of the pose of each.
inline void add_pose_tables(model::Scene& scene, const std::string& coordinate, Random& random) {
  for (const model::Body& body : scene.bodies) {
    model::PoseTable table;
    table.name = table.body = body.name;
    table.coordinate = coordinate;
    (table.turns() ? table.values_deg : table.values) = {-1.1, -0.2, 0.3, 1.4};
    for (int k = 0; k < 4; ++k)
      table.loaded.push_back(near(*scene.database, random));
    scene.pose_tables.push_back(table);
  }
}

struct NamedScene {
  std::string name;
  model::Scene scene;
};

/// Every joint type x kind of body x hydrodynamic axes, each with every force.
inline std::vector<NamedScene> all_scenes() {
  std::vector<NamedScene> scenes;
  Random common;
  const std::vector<std::vector<std::string>> motions = {
      {"rigid"}, {"planar"}, {"surge", "sway", "heave", "yaw"}};
  const std::vector<std::string> poses = {"heave", "roll", "pitch", "yaw"};
  std::size_t next_pose = 0;
  for (const joint::JointType& type : joint::joint_types())
    for (const auto& motion : motions)
      for (const std::string hydro :
           {"dry", "body", "mean", "yaw", "round", "constant", "convolution", "poses",
            "poses, constant", "mean, mode", "round, mode"}) {
        const bool bends = hydro.ends_with("mode");
        // Rows on three axes of rotation overdetermine a body that has one.
        if ((motion.size() > 1 && type.rows.size() > 3) || (bends && motion.front() != "rigid"))
          continue;
        Random own; // scenes with a mode leave the numbers of the others as they are
        Random& random = bends ? own : common;
        model::Scene scene = two_bodies(type, motion, random);
        if (hydro != "dry")
          add_hydro(scene,
                    hydro.starts_with("round")  ? "yaw"
                    : hydro.starts_with("mean") ? "mean"
                    : hydro == "yaw"            ? "yaw"
                                                : "body",
                    hydro.ends_with("constant") ? "constant"
                    : hydro == "convolution"    ? hydro
                                                : "exponential",
                    random);
        if (bends)
          add_mode(scene, random);
        if (hydro.starts_with("round"))
          scene.database = all_round(*scene.database);
        if (hydro.starts_with("mean") || hydro == "constant" || hydro.starts_with("round") ||
            hydro == "poses")
          scene.sea.phase = "moving";
        if (hydro.starts_with("poses")) {
          scene.hydro->axes = std::vector{"mean", "body", "yaw"}[next_pose % 3];
          add_pose_tables(scene, poses[next_pose++ % 4], random);
        }
        add_every_force(scene, random, hydro == "convolution");
        add_morison(scene);
        add_chambers(scene);
        scenes.push_back({std::string(type.name) + ", " + motion[0] +
                              (motion.size() > 1 ? "..." : "") + ", " + hydro,
                          scene});
      }
  return scenes;
}

/// Random accepted points before `now`, where the system depends on its past; null elsewhere.
inline std::unique_ptr<system::History> random_history(system::Regime& s, Random& random,
                                                       double now) {
  if (!system::has_past(s))
    return nullptr;
  auto history = std::make_unique<system::History>(s);
  for (const double before : {1.0, 0.6, 0.35, 0.04}) {
    VectorX y = system::initial_state(s), yp(s.n);
    for (Index i = 0; i < s.n; ++i) {
      y[i] += (i < s.n_q ? 0.3 : 1.0) * random();
      yp[i] = random();
    }
    history->append(now - before, y, yp);
  }
  s.history = history.get();
  return history;
}

/// Gives every hydrodynamic body a mean yaw of its own, as if it had been placed so.
inline void turn_mean_axes(system::System& s) {
  double yaw = 0.4;
  for (system::HydroBody& hb : s.hydro.bodies) {
    hb.turned = true;
    hb.yaw = yaw;
    hb.cos_yaw = std::cos(yaw);
    hb.sin_yaw = std::sin(yaw);
    yaw -= 1.1;
  }
  for (system::ElementList& list : s.elements)
    if (const auto* waves = dynamic_cast<const water::Excitation*>(list.laws.get())) {
      auto turned = std::make_shared<water::Excitation>(*waves);
      turned->turn(s.hydro.bodies);
      list.laws = std::move(turned);
    }
}

/// Unknowns far from any special value; quaternions off the unit sphere by some per cent.
inline VectorX random_state(const system::Regime& s, Random& random) {
  VectorX y = system::initial_state(s);
  for (Index i = 0; i < s.n; ++i) {
    const bool of_law = i >= s.z0 && i < s.memory0; // a pressure stays positive
    y[i] += (of_law ? s.scale[i] : i < s.n_q ? 0.3 : 1.0) * random();
  }
  return y;
}

/// The entries of a sparse matrix in their places.
inline MatrixX dense(const system::Pattern& p, const std::vector<double>& values) {
  MatrixX m = MatrixX::Zero(p.n, p.n);
  for (Index c = 0; c < p.n; ++c)
    for (Index k = p.column_start[c]; k < p.column_start[c + 1]; ++k)
      m(p.row[k], c) += values[k];
  return m;
}

} // namespace hydrodae::test
