#pragma once
/// Forces, lines and ropes of every kind, made from the type lists themselves.

#include <memory>
#include <string>
#include <vector>

#include "databases.h"
#include "hydrodae/joint/types.h"
#include "hydrodae/model/forces.h"
#include "hydrodae/model/scene.h"

namespace hydrodae::test {

/// Fills every field of a force from its own declaration, within its range.
template <class Law> Law random_force(Random& random, const std::string& name) {
  Law law;
  for (const AnyField& field : Law::fields()) {
    auto number = [&] {
      const double low = std::isfinite(field.range.min) ? field.range.min : -3.0;
      const double high = std::isfinite(field.range.max) ? field.range.max : low + 6.0;
      return low + (high - low) * (0.5 + 0.45 * random());
    };
    std::visit(
        [&](auto* member) {
          auto& value = *member;
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
        field.in(&law));
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
          if constexpr (std::is_same_v<Law, line::CatenaryLine>)
            for (Law& law : list) { // a part that floats would lie on the surface
              law.weight = {1.5 + 0.5 * random(), 2.0 + random()};
              law.dry_weight = {2.5, 3.5};
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
      scene.forces->lists);
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

} // namespace hydrodae::test
