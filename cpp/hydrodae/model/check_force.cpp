#include "hydrodae/joint/types.h"
#include "hydrodae/model/check.h"

namespace hydrodae::model {
namespace {

/// The joint has one motion, along which the force acts.
void check_single_motion(const Scene& scene, const Entry& entry, const std::string& name) {
  check_reference(entry, "joint", name, names_of(scene.joints), "joint");
  const Joint& joint = *find_named(scene.joints, name);
  const std::size_t n = joint::find_joint_type(joint.type)->motions.size();
  if (n != 1)
    refuse(entry, "joint",
           "a " + joint.type + " joint has " + (n == 0 ? "no motion" : "more than one motion") +
               " of its own to act along; use a joint that turns or slides");
}

/// What a force refers to is read off its members: `body` names a body, `joint` a joint, `body_a`
/// and `body_b` the two ends.
template <class Force> void check_force(const Scene& scene, const Force& force) {
  const Entry entry{"force", force.name};
  if constexpr (requires { force.body; })
    check_reference(entry, "body", force.body, names_of(scene.bodies), "body");
  if constexpr (requires { force.joint; })
    check_single_motion(scene, entry, force.joint);
  if constexpr (requires { force.pressure_high; }) {
    if (force.pressure_low > force.pressure_high)
      refuse(entry, "pressure_low", "the low accumulator has more pressure than the high one");
  }
  if constexpr (requires { force.kinetic_load; }) {
    if (force.kinetic_load && *force.kinetic_load > force.static_load)
      refuse(entry, "kinetic", "the kinetic friction must not be above the static one");
  }
  if constexpr (requires { force.body_a; }) {
    check_ends(scene, entry, force.body_a, force.body_b);
    if constexpr (requires { force.point_a; })
      if (coincide(force.point_a, force.point_b))
        refuse(entry, "point_b",
               "point_a and point_b coincide in the reference pose: the force has no direction");
  }
  if constexpr (requires { force.axis_x; }) {
    const Vector3 z = force.axis.value_or(Vector3::UnitZ());
    if (z.isZero(0.0))
      refuse(entry, "axis", "the axis has no length");
    if (force.axis_x && force.axis_x->normalized().cross(z.normalized()).norm() < 1e-6)
      refuse(entry, "axis_x", "axis_x must have a length and a direction other than the axis");
  }
}

} // namespace

void check_forces(const Scene& scene) {
  const auto check_all = [&](const auto& list) {
    for (const auto& force : list)
      check_force(scene, force);
  };
  std::apply([&](const auto&... list) { (check_all(list), ...); }, scene.forces);
}

} // namespace hydrodae::model
