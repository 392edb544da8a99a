#pragma once
/// The joint table: every joint is a row of data.

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/joint/rows.h"

namespace hydrodae::joint {

/// Free motion of a joint with its own coordinate, along or about an axis of marker A (`turns_b`:
/// about an axis of marker B).
struct FreeMotion {
  enum class Kind { turns, turns_b, slides, stretches, travels } kind = Kind::turns;
  int axis = Z;
  bool is_angle() const { return kind == Kind::turns || kind == Kind::turns_b; }
};
constexpr FreeMotion turns(Axis i) { return {FreeMotion::Kind::turns, i}; }
constexpr FreeMotion turns_b(Axis i) { return {FreeMotion::Kind::turns_b, i}; }
constexpr FreeMotion stretches() { return {FreeMotion::Kind::stretches, Z}; } ///< distance |B - A|
/// Arc length along the curve
constexpr FreeMotion travels() { return {FreeMotion::Kind::travels, Z}; }
constexpr FreeMotion slides(Axis i) { return {FreeMotion::Kind::slides, i}; }

struct JointType {
  std::string_view name;
  std::vector<BasicRow> rows;
  std::vector<FreeMotion> motions; ///< the first angle and the first slide are the main ones
  bool needs_axis = false;         ///< the case must give the axis (z of both markers)
  std::string_view doc = {};       ///< one sentence of meaning

  bool turns() const { return has(true); }
  bool slides() const { return has(false); }
  bool welds() const { return rows.size() == 6; }
  /// Returns whether its only translation is along one axis.
  bool guides() const {
    return rows.size() == 5 && motions.size() == 1 && motions[0].kind == FreeMotion::Kind::slides;
  }
  /// Returns whether it connects two different points of A and B.
  bool has_two_points() const {
    for (const FreeMotion& motion : motions)
      if (motion.kind == FreeMotion::Kind::stretches)
        return true;
    return has_row<DistanceRow>();
  }
  /// Returns whether it has a row of this kind.
  template <class Kind> bool has_row() const {
    return std::any_of(rows.begin(), rows.end(),
                       [](const BasicRow& row) { return std::holds_alternative<Kind>(row); });
  }
  /// Returns whether it has a row that restricts a rotation.
  bool holds_turns() const { return std::any_of(rows.begin(), rows.end(), needs_turns); }

private:
  bool has(bool angle) const {
    for (const FreeMotion& motion : motions)
      if (motion.is_angle() == angle)
        return true;
    return false;
  }
};

/// Joint table. A new joint made of the basic rows is one more line here.
inline const std::vector<JointType>& joint_types() {
  static const std::vector<JointType> table = {
      {"spherical",
       {span(X), span(Y), span(Z)},
       {},
       false,
       "Ball joint: the bodies share one point and turn about it freely."},
      {"revolute",
       {span(X), span(Y), span(Z), perp(X, Z), perp(Y, Z)},
       {turns(Z)},
       true,
       "Hinge: body B turns about the axis."},
      {"prismatic",
       {span(X), span(Y), perp(X, Y), perp(Y, Z), perp(Z, X)},
       {slides(Z)},
       true,
       "Slider: body B moves along the axis and does not turn."},
      {"fixed",
       {span(X), span(Y), span(Z), perp(X, Y), perp(Y, Z), perp(Z, X)},
       {},
       false,
       "Weld: the bodies move as one."},
      {"universal",
       {span(X), span(Y), span(Z), perp(X, Y)},
       {turns(X), turns_b(Y)},
       true,
       "Cardan joint: body B turns about two crossed axes, x of body A and y of body B."},
      {"cylindrical",
       {span(X), span(Y), perp(X, Z), perp(Y, Z)},
       {turns(Z), slides(Z)},
       true,
       "Body B turns about the axis and moves along it."},
      {"planar",
       {span(Z), perp(X, Z), perp(Y, Z)},
       {turns(Z), slides(X), slides(Y)},
       true,
       "Body B moves in the plane across the axis and turns in it."},
      {"sliding",
       {span(X), span(Y)},
       {slides(Z)},
       true,
       "A point of body B moves along the axis, which body A carries; all rotations are free."},
      {"screw",
       {span(X), span(Y), perp(X, Z), perp(Y, Z), screw()},
       {turns(Z), slides(Z)},
       true,
       "Body B turns about the axis and advances along it by `pitch` for each turn."},
      {"distance",
       {distance()},
       {},
       false,
       "Massless rod between two points; `one_sided`: an inextensible rope."},
      {"telescope",
       {},
       {stretches()},
       false,
       "Two points whose distance is free: holds nothing, but forces act along the distance."},
      {"path",
       {across(0), across(1)},
       {travels()},
       false,
       "A point of body B moves along a curve that body A carries."},
  };
  return table;
}

/// Joint type with this name, or null.
inline const JointType* find_joint_type(std::string_view name) {
  for (const JointType& type : joint_types())
    if (type.name == name)
      return &type;
  return nullptr;
}

inline std::vector<std::string_view> joint_type_names() {
  std::vector<std::string_view> names;
  for (const JointType& type : joint_types())
    names.push_back(type.name);
  return names;
}

/// Names of the motions, in their order: angle, angle_2, ... and displacement, displacement_2, ...
inline std::vector<std::string> motion_names(const JointType& type) {
  std::vector<std::string> names;
  std::array<int, 2> count{};
  for (const FreeMotion& motion : type.motions) {
    const int k = ++count[motion.is_angle() ? 0 : 1];
    std::string& name = names.emplace_back(motion.is_angle() ? "angle" : "displacement");
    if (k > 1)
      name.append("_").append(std::to_string(k));
  }
  return names;
}

} // namespace hydrodae::joint
