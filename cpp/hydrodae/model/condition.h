#pragma once
/// Condition of a constraint on coordinates of joints or bodies.

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/math/drive.h"

namespace hydrodae::model {

/// Condition: the sum of factor * s over the terms equals f(t), or its rate does, or it keeps its
/// start; or s of one term stays within bounds, with impacts.
struct Condition {
  struct Term {
    std::optional<std::string> joint, body; ///< exactly one is given
    std::optional<std::string> coordinate;  ///< coordinate; default: the first of a joint
    double factor = 1.0;
    std::string joint_key = "joint", coordinate_key = "coordinate"; ///< keys in the case file
  };
  struct Bounds {
    double lower = -INFINITY, upper = INFINITY; ///< [m] or [rad]
    double restitution = 0.0;
    std::optional<double> contact_time;
  };
  std::vector<Term> terms;
  Drive drive;
  bool velocity_level = false;
  bool keeps_start = false;
  std::optional<Bounds> bounds;
};

/// Members of every table [[constraint]]. A type is a struct that derives from this one, with
///
///   type, doc, fields()    as every typed table (core/one_of.h)
///   condition()            its condition
///   text(motion)           description; motion(term) names a coordinate: "angle of hinge"
///   fault()                optional: fault in its values
///
/// and one entry in the list of model/constraint.h. Types with `drive` or with bounds in m or deg
/// (`lower_angle`) have these checked.
struct Conditional {
  static constexpr std::string_view list_doc = "A condition on coordinates of joints or bodies.";
  std::string name;
};

using MotionText = std::function<std::string(const Condition::Term&)>;

template <class C> Fields<C> conditional_fields() {
  return {{"name", &C::name, "-", "Name of the constraint in the results.", true}};
}

template <class C> Field<C> coordinate_field() {
  return {"coordinate", &C::coordinate, "-",
          "Which one: surge ... yaw of a body; angle, displacement (angle_2, ...) of a joint. By "
          "default the first of the joint."};
}

} // namespace hydrodae::model
