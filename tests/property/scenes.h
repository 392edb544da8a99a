#pragma once
/// Scenes that together contain every joint type, every force type, every kind of body and both
/// hydrodynamic axes, made from the type lists themselves.

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "hydrodae/joint/types.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/jacobian.h"
#include "hydrodae/water/excitation.h"

namespace hydrodae::test {

/// Reproducible numbers in (-1, 1).
struct Random {
  std::mt19937 engine{12345};
  double operator()() { return 2.0 * (engine() / 4294967296.0) - 1.0; }
  Vector3 vector() { return {(*this)(), (*this)(), (*this)()}; }
};

inline const std::vector<std::string> dofs = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

/// A database of two bodies with coupled added mass, hydrostatics and a memory of real and complex
/// poles with dense complex input and output matrices.
inline std::shared_ptr<const hydro::Database> random_database(Random& random) {
  auto db = std::make_shared<hydro::Database>();
  db->rho = 1025.0;
  db->gravity = 9.81;
  const std::vector<Vector3> points = {{0.0, 0.0, 0.0}, {2.0, 0.5, -1.0}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = i == 0 ? "a" : "b";
    hydro::Hydrostatics h;
    h.displaced_volume = 0.01 + 0.003 * random();
    h.center_of_buoyancy = points[i] + 0.1 * random.vector();
    for (int k = 0; k < 36; ++k)
      h.stiffness(k) = 10.0 * random();
    db->bodies.push_back({name, points[i], h, {}, {}});
    for (const std::string& dof : dofs)
      db->coordinates.push_back(name + "." + dof);
  }
  MatrixX root(12, 12);
  for (int k = 0; k < 144; ++k)
    root(k) = random();
  db->added_mass_inf = root * root.transpose();
  hydro::MemoryFit fit;
  fit.name = "random";
  fit.inputs = fit.outputs = db->coordinates;
  fit.poles.resize(3);
  fit.poles << -0.7, std::complex<double>(-0.3, 1.1), std::complex<double>(-0.2, 2.0);
  fit.input_matrix.resize(3, 12);
  fit.output_matrix.resize(12, 3);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 12; ++c) {
      const bool pair = fit.poles[k].imag() != 0.0;
      fit.input_matrix(k, c) = {random(), pair ? random() : 0.0};
      fit.output_matrix(c, k) = {random(), pair ? random() : 0.0};
    }
  fit.added_mass_inf = db->added_mass_inf;
  fit.states = 5;
  db->fits.push_back(fit);
  hydro::RadiationKernel kernel;
  kernel.step = 0.05;
  kernel.inputs = kernel.outputs = db->coordinates;
  kernel.added_mass_inf = db->added_mass_inf;
  for (int k = 0; k < 40; ++k) {
    const double t = kernel.step * k;
    kernel.values.emplace_back(
        fit.output_matrix.real() *
        Eigen::Vector3d(std::exp(-t), std::exp(-t) * std::cos(2.0 * t), std::cos(t)).asDiagonal() *
        fit.input_matrix.real());
  }
  db->kernel = kernel;
  db->water_depth = 20.0;
  db->omega = Vector3(0.5, 1.0, 2.0);
  db->heading = Eigen::Vector2d(-0.5, 0.5);
  for (int h = 0; h < 2; ++h)
    db->excitation.emplace_back(10.0 * Eigen::MatrixXcd::Random(3, 12));
  for (int w = 0; w < 3; ++w) {
    db->added_mass.push_back((1.0 + 0.1 * w) * db->added_mass_inf);
    db->damping.push_back(0.2 * (1.0 + w) * db->added_mass_inf);
  }
  return db;
}

/// The same with headings all round.
inline std::shared_ptr<const hydro::Database> all_round(const hydro::Database& given) {
  auto db = std::make_shared<hydro::Database>(given);
  db->heading = VectorX::LinSpaced(6, 0.0, 2.0 * pi);
  db->excitation.clear();
  for (int h = 0; h < 5; ++h)
    db->excitation.emplace_back(10.0 * Eigen::MatrixXcd::Random(3, 12));
  db->excitation.push_back(db->excitation.front());
  return db;
}

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
    if (type.has_row(joint::BasicRow::Kind::across))
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

/// Fills every field of a force from its own declaration, within its range.
template <class Law> Law random_force(Random& random, const std::string& name) {
  Law law;
  for (const Field<Law>& field : Law::fields()) {
    auto number = [&] {
      const double low = std::isfinite(field.range.min) ? field.range.min : -3.0;
      const double high = std::isfinite(field.range.max) ? field.range.max : low + 6.0;
      return low + (high - low) * (0.5 + 0.45 * random());
    };
    std::visit(
        [&](auto member) {
          auto& value = law.*member;
          using T = std::remove_reference_t<decltype(value)>;
          if constexpr (std::is_same_v<T, double>) {
            value = number();
          } else if constexpr (std::is_same_v<T, bool>) {
            value = false;
          } else if constexpr (std::is_same_v<T, std::vector<double>>) {
            if (field.required)
              value = {number(), number()};
          } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
            value = {"a", "ground", "b"};
          } else if constexpr (std::is_same_v<T, std::vector<Vector3>>) {
            for (int k = 0; k < 3; ++k)
              value.push_back(number() * random.vector());
          } else if constexpr (std::is_same_v<T, std::string>) {
            value = field.key == "body" || field.key == "body_b" ? "b"
                    : field.key == "body_a"                      ? "a"
                    : field.key == "joint"                       ? "link"
                                                                 : name;
            if (!field.choices.empty())
              value = field.choices.front();
          } else if constexpr (std::is_same_v<T, Vector3> || std::is_same_v<T, Vector6> ||
                               std::is_same_v<T, Matrix6>) {
            for (Eigen::Index k = 0; k < value.size(); ++k)
              value.data()[k] = number();
          }
        },
        field.member);
  }
  return law;
}

/// Friction that the reaction of the link presses.
template <class Law> Law pressed_friction(Random& random) {
  Law law = random_force<Law>(random, "pressed " + std::string(Law::type));
  law.static_coefficient = 0.4;
  law.kinetic_coefficient = 0.3;
  law.preload = 0.5;
  law.length = 0.7;
  law.radius = 0.2;
  law.radius_axial = 0.3;
  law.small_force = 0.6;
  return law;
}

/// What a program might give as a law: load_i = -x_i^2 - sin(t) v_i + x_0 v_0.
/// Quadratic, so that central differences are exact but for rounding.
template <int w> element::Function smooth_function() {
  return [](double t, const double* x, const double* v, double* load) {
    for (int i = 0; i < w; ++i)
      load[i] = -x[i] * x[i] - std::sin(t) * v[i] + x[0] * v[0];
  };
}

/// What a shared library might give: a load and a state that follows the first rate.
template <int w>
void library_law(double t, const double* x, const double* v, const double* z, const double*,
                 double* load, double* z_dot) {
  for (int i = 0; i < w; ++i)
    load[i] = -x[i] * v[i] + std::cos(t) * z[0];
  *z_dot = v[0] * v[0] - 2.0 * z[0] * x[0];
}

template <int w> const hydrodae_law* smooth_library_law() {
  static const hydrodae_state state = {"memory", "m2/s", 0.5, 0.3};
  static const hydrodae_law law = {"smooth", w > 1, 0, nullptr, 1, &state, library_law<w>, nullptr};
  return &law;
}

/// Lines of two parts with bending, a buoy and a clump, partly in the air and on the bed. One has a
/// free end, in other water, which is damped where it is slack and leaves the bed.
inline std::vector<line::Line> random_lines(Random& random) {
  line::Line line;
  line.name = "line";
  line.body_a = "a";
  line.body_b = "b";
  line.point_a = Vector3(0.1, 0.2, -0.4) + 0.1 * random.vector();
  line.point_b = Vector3(2.2, 0.1, 0.3) + 0.1 * random.vector();
  line.length = {1.5, 1.4};
  line.segments = {2, 3};
  line.mass = {1.5, 0.8};
  line.diameter = {0.03, 0.02};
  line.stiffness = {300.0, 200.0};
  line.damping = {3.0, 2.0};
  line.bending_stiffness = {2.0};
  line.drag = {1.2};
  line.drag_axial = {0.3};
  line.added_mass = {1.0};
  line.added_mass_axial = {0.2};
  line.attachment_at = {0.75, 1.5};
  line.attachment_mass = {0.1, 0.3};
  line.attachment_volume = {2e-4, 0.0};
  line.attachment_drag_area = {0.1, 0.05};
  line.attachment_added_mass = {0.5, 0.0};
  line.seabed_depth = 0.9;
  line.seabed_stiffness = 40.0;
  line.seabed_damping = 5.0;
  line.seabed_friction = 0.5;
  line::Line hanging = line;
  hanging.name = "hanging";
  hanging.free_end = true;
  hanging.damps_slack = true;
  hanging.seabed_damps_up = true;
  hanging.water_density = 800.0;
  hanging.bending_stiffness.clear();
  hanging.segments = {2, 2};
  hanging.attachment_at = {0.75, 2.9};
  return {line, hanging};
}

/// A rope with two sheaves, under each of which it runs, taut whatever the pose.
inline line::Rope rope_under_sheaves() {
  line::Rope rope;
  rope.name = "rope under sheaves";
  rope.bodies = {"ground", "a", "b", "ground"};
  rope.points = {{-1.0, 0.1, 5.0}, {0.0, 0.0, 0.2}, {2.0, 0.4, -0.6}, {3.5, 0.6, 5.0}};
  rope.stiffness = 30.0;
  rope.damping = 2.0;
  rope.length = 8.0;
  rope.radii = {0.0, 0.15, 0.2, 0.0};
  rope.axes = {
      {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, {0.1, -1.0, 0.0}, {0.0, 1.0, 0.0}}; // of the sheaves
  return rope;
}

/// Adds one force of every kind in the list that this scene can carry; `late`: with a delay where
/// it can have one.
inline void add_every_force(model::Scene& scene, Random& random, bool late = false) {
  const std::string& type = scene.joints.front().type;
  const bool one_motion = joint::find_joint_type(type)->motions.size() == 1;
  const bool presses = type == "prismatic" || type == "revolute" || type == "sliding";
  std::apply(
      [&](auto&... lists) {
        auto add = [&](auto& list) {
          using Law = typename std::remove_reference_t<decltype(list)>::value_type;
          constexpr bool on_joint = requires(Law law) { law.joint; };
          if (!on_joint || one_motion)
            list.push_back(random_force<Law>(random, std::string(Law::type)));
          if constexpr (requires(Law law) { law.function; })
            for (Law& law : list)
              law.function = smooth_function<element::width(Law::port)>();
          if constexpr (requires(Law law) { law.found; })
            for (Law& law : list)
              law.found = smooth_library_law<element::width(Law::port)>();
          if constexpr (requires(Law law) { law.static_coefficient; }) {
            for (Law& law : list)
              law.static_load = 1.5;
            if (presses)
              list.push_back(pressed_friction<Law>(random));
          }
          if constexpr (std::is_same_v<Law, line::Line>)
            list = random_lines(random);
          if constexpr (std::is_same_v<Law, line::Rope>)
            list.push_back(rope_under_sheaves());
          if constexpr (requires(Law law) { law.upper; })
            for (Law& law : list)
              law.upper = -0.2; // beyond it
          if constexpr (requires(Law law) { law.reversal_rate; })
            for (Law& law : list)
              law.reversal_rate = 0.3;
          if constexpr (requires(Law law) { law.delay; })
            for (Law& law : list)
              law.delay = late ? 0.4 : 0.0;
        };
        (add(lists), ...);
      },
      scene.forces);
}

inline sea::Wave swell() {
  sea::Regular wave;
  wave.name = "swell";
  wave.height = 1.0;
  wave.period = 5.0;
  wave.heading = 0.2;
  return wave;
}

/// A point element and two members, partly wet, in the waves and a current.
inline void add_morison(model::Scene& scene) {
  if (!scene.hydro) {
    scene.environment.water_density = 2.0;
    scene.environment.water_depth = 20.0;
    scene.waves.push_back(swell());
  }
  scene.sea.current = {0.3, -0.2, 0.1};
  water::Morison point;
  point.name = "ball";
  point.body = "a";
  point.point = Vector3(0.2, -0.1, -0.3);
  point.diameter = 1.5;
  point.drag_coefficient = 0.7;
  point.added_mass_coefficient = 0.5;
  water::Morison member;
  member.name = "leg";
  member.body = "b";
  member.point_a = Vector3(1.6, 0.2, -2.0);
  member.point_b = Vector3(2.3, 0.9, 1.0);
  member.diameter = 0.4;
  member.drag_coefficient = 1.1;
  member.drag_axial = 0.3;
  member.added_mass_coefficient = 0.9;
  member.added_mass_axial = 0.2;
  member.segments = 5;
  scene.morison = {point, member};
  std::swap(member.point_a, member.point_b);
  member.name = "arm";
  member.surface = "instantaneous";
  scene.morison.push_back(member);
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

/// Another database whose added mass, and its blends, are positive.
inline std::shared_ptr<const hydro::Database> near(const hydro::Database& first, Random& random) {
  auto db = std::make_shared<hydro::Database>(*random_database(random));
  const auto mix = [&](MatrixX& own, const MatrixX& other) { own = other + 0.05 * own; };
  mix(db->added_mass_inf, first.added_mass_inf);
  mix(db->fits[0].added_mass_inf, first.fits[0].added_mass_inf);
  for (std::size_t w = 0; w < db->added_mass.size(); ++w)
    mix(db->added_mass[w], first.added_mass[w]);
  return db;
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
  Random random;
  const std::vector<std::vector<std::string>> motions = {
      {"rigid"}, {"planar"}, {"surge", "sway", "heave", "yaw"}};
  const std::vector<std::string> poses = {"heave", "roll", "pitch", "yaw"};
  std::size_t next_pose = 0;
  for (const joint::JointType& type : joint::joint_types())
    for (const auto& motion : motions)
      for (const std::string hydro : {"dry", "body", "mean", "yaw", "round", "constant",
                                      "convolution", "poses", "poses, constant"}) {
        // Rows on three axes of rotation overdetermine a body that has one.
        if (motion.size() > 1 && type.rows.size() > 3)
          continue;
        model::Scene scene = two_bodies(type, motion, random);
        if (hydro != "dry")
          add_hydro(scene,
                    hydro == "round"                    ? "yaw"
                    : hydro == "mean" || hydro == "yaw" ? hydro
                                                        : "body",
                    hydro.ends_with("constant") ? "constant"
                    : hydro == "convolution"    ? hydro
                                                : "exponential",
                    random);
        if (hydro == "round")
          scene.database = all_round(*scene.database);
        if (hydro == "mean" || hydro == "constant" || hydro == "round" || hydro == "poses")
          scene.sea.phase = "moving";
        if (hydro.starts_with("poses")) {
          scene.hydro->axes = std::vector{"mean", "body", "yaw"}[next_pose % 3];
          add_pose_tables(scene, poses[next_pose++ % 4], random);
        }
        add_every_force(scene, random, hydro == "convolution");
        add_morison(scene);
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
