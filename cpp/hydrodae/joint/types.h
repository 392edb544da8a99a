#pragma once
/// The joint table: every joint is a row of data.
///
/// Two basic scalar rows between a marker on body A (axes a_x, a_y, a_z, origin A) and one on body
/// B (axes b_x, b_y, b_z, origin B) give the standard joints (Haug, Computer Aided Kinematics and
/// Dynamics of Mechanical Systems, 1989, ch. 9: "dot-1" and "dot-2" constraints):
///
///   span(i):    a_i . (B - A) = 0   [m]     the origins do not part along a_i
///   perp(i,j):  a_i . b_j     = 0   [-]     two axes stay perpendicular
///
/// Both markers coincide in the reference pose. `perp` rows also vanish when a body is flipped by
/// 180 degrees; the branch is checked at the start of a run.

#include <array>
#include <string_view>
#include <vector>

namespace hydrodae::joint {

enum Axis : int { X = 0, Y = 1, Z = 2 };

struct BasicRow {
  enum class Kind { span, perp } kind = Kind::span;
  int i = 0; ///< axis of marker A
  int j = 0; ///< axis of marker B (perp only)
};
constexpr BasicRow span(Axis i) { return {BasicRow::Kind::span, i, 0}; }
constexpr BasicRow perp(Axis i, Axis j) { return {BasicRow::Kind::perp, i, j}; }

/// A motion that a joint leaves free and that has a coordinate of its own, along or about the axis
/// of marker A.
struct FreeMotion {
  enum class Kind { turns, slides } kind = Kind::turns;
  int axis = Z;
};
constexpr FreeMotion turns(Axis i) { return {FreeMotion::Kind::turns, i}; }
constexpr FreeMotion slides(Axis i) { return {FreeMotion::Kind::slides, i}; }

struct JointType {
  std::string_view name;
  std::vector<BasicRow> rows;
  std::vector<FreeMotion> motions; ///< at most one `turns` and one `slides`
  bool needs_axis = false;         ///< the case must give the axis (z of both markers)

  bool turns() const { return has(FreeMotion::Kind::turns); }
  bool slides() const { return has(FreeMotion::Kind::slides); }

private:
  bool has(FreeMotion::Kind kind) const {
    for (const FreeMotion& motion : motions)
      if (motion.kind == kind)
        return true;
    return false;
  }
};

/// The table. A new joint made of the basic rows is one line here, and nothing else.
inline const std::vector<JointType>& joint_types() {
  static const std::vector<JointType> table = {
      {"spherical", {span(X), span(Y), span(Z)}, {}, false},
      {"revolute", {span(X), span(Y), span(Z), perp(X, Z), perp(Y, Z)}, {turns(Z)}, true},
      {"prismatic", {span(X), span(Y), perp(X, Y), perp(Y, Z), perp(Z, X)}, {slides(Z)}, true},
      {"fixed", {span(X), span(Y), span(Z), perp(X, Y), perp(Y, Z), perp(Z, X)}, {}, false},
  };
  return table;
}

/// The row of the table with this name, or null.
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

} // namespace hydrodae::joint
