#pragma once
/// The equations of motion of a scene, in the stabilised index-2 form of Gear, Gupta and Leimkuhler
/// (J. Comput. Appl. Math. 12-13 (1985) 77-90):
///
///   q' = E(q) (u + G^T mu) + sigma p            p.p = 1 for each quaternion
///   M(q) u' = f(t, q, u, z) + G^T lambda
///   0 = g(q)        0 = G(q) u
///   z' = h(q, u, z)                             states of elements, radiation memory last
///
/// State vector y = [q | u | z | lambda | mu | sigma]; the row of an algebraic unknown holds the
/// equation it belongs to: lambda - velocity constraint, mu - position constraint, sigma - norm.
/// A System is built once and constant from then on; which of its rows hold at a time of a run, and
/// where their multipliers stand in y, is held by a Regime (regime.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/element/elements.h"
#include "hydrodae/element/friction_loads.h"
#include "hydrodae/joint/basic.h"
#include "hydrodae/math/drive.h"
#include "hydrodae/sea/kinematics.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::system {

/// Coordinates of one body. Tangent components 0..2 are translations (world axes), 3..5 rotations
/// (body axes); only the free ones are unknowns.
struct BodyData {
  enum class Rotation { locked, about_axis, free };
  std::string name;
  enum class Kind { whole, mode, attachment } kind = Kind::whole; ///< see model/deformation.h
  bool is_mode() const { return kind == Kind::mode; }             ///< its x is the amplitude
  double mass = 0.0;                                              ///< [kg]
  Matrix3 inertia = Matrix3::Zero();          ///< about the centre of gravity, body axes [kg m2]
  Vector3 reference = Vector3::Zero();        ///< centre of gravity in the reference pose [m]
  Vector3 position = Vector3::Zero();         ///< start, and for ever along locked translations [m]
  Vector4 orientation{1, 0, 0, 0};            ///< start, and for ever if the rotation is locked
  Vector3 velocity = Vector3::Zero();         ///< start [m/s]
  Vector3 angular_velocity = Vector3::Zero(); ///< start, body axes [rad/s]
  Rotation rotation = Rotation::locked;
  int axis = 1;                 ///< of Rotation::about_axis
  std::array<int, 6> active{};  ///< tangent component of each velocity unknown
  int n_active = 0;             ///< number of velocity unknowns
  int n_translations = 0;       ///< how many of them are translations (they come first)
  int n_position = 0;           ///< number of position unknowns (n_active, or 7)
  Index q0 = 0, u0 = 0;         ///< offsets into y
  Index norm = -1;              ///< of its quaternion, among those of all bodies; -1 if absent
  double length_scale = 1.0;    ///< [m], what a position error is measured by
  double lever = 1.0;           ///< [m], turns lengths into angles
  double arm = 1.0;             ///< [m], to its farthest joint; the lever where no joint is off it
  bool time_scale_known = true; ///< else taken from the start (no gravity, none given)
  double time_scale = 1.0;      ///< [s], turns lengths into velocities
  double scale_mass = 1.0;      ///< [kg], its own, or without one the largest of its group
  int followed = -1;            ///< its rotation in System::rotations; -1: not free, or locked
  int mechanism = -1;           ///< of bodies that constraint rows hold together; -1: cannot move
  int group = -1; ///< of bodies that move each other in any way: by rows, forces, or the water
};

inline constexpr Index redundant = -1; ///< in place of a multiplier: the row follows from others

/// A row of constraint, with two multipliers while it holds.
struct Row {
  std::size_t number = 0; ///< among all rows
  bool dropped = false;   ///< it follows from others, and never holds
};

/// A row of a joint that restricts a free coordinate.
struct RowData : Row {
  joint::BasicRow kind;
  explicit RowData(const joint::BasicRow& basic) : kind(basic) {}
};

struct JointData {
  std::string name;
  const joint::JointType* type = nullptr;
  joint::Marker A, B;
  joint::Parameters parameters;
  std::vector<RowData> rows; ///< rows that restrict a free coordinate
  int first_motion = 0;      ///< of its motions in System::motions
  bool hidden = false;       ///< stands for a coordinate of a body; not reported
};

/// A coordinate along a free motion of a joint. Angles are followed over turns: Workspace::turns
/// holds the value at the last accepted step.
struct MotionData {
  int joint = 0;
  joint::FreeMotion motion;
  std::string name;   ///< angle, displacement, angle_2, ...
  double start = 0.0; ///< near the value at the start: fixes the turn of an angle
};

/// A rotation that a law or the results see as a vector: of a body from its reference pose turned
/// by `turn`, or of marker B of a joint against marker A. Followed over turns as angles are.
struct RotationData {
  int body = -1, joint = -1;
  Vector4 turn{1, 0, 0, 0};
};

/// What a motion is to be at the start; met by the assembly together with the joints.
struct MotionStart {
  int motion = 0;
  std::optional<double> value, rate;
};

/// A condition on motions: sum_k factor_k s_k = offset + f(t), or on their rates: = f(t).
struct CouplerData : Row {
  struct Term {
    int motion = 0;
    double factor = 1.0;
  };
  std::string name;
  std::vector<Term> terms;
  double offset = 0.0;
  Drive drive;
  bool velocity_level = false; ///< then it has no mu
  bool keeps_start = false;    ///< the offset is what the terms sum up to at the start
  int of_switch = -1;          ///< in System::switches, -1: it always holds
  bool hidden = false;         ///< holds an attachment; not reported
};

/// Where a law is joined to the bodies: along a motion or several, on a body, or between the
/// markers of a (hidden) joint.
struct PortData {
  std::string component;    ///< under which the results list its loads
  int motion = -1;          ///< in System::motions
  int delay = -1;           ///< in System::delays, -1: none
  int body = -1;            ///< in System::bodies
  int joint = -1;           ///< in System::joints; of a motion: its own
  int followed = -1;        ///< in System::rotations, of what it sees as a vector; -1: nothing
  Vector4 turn{1, 0, 0, 0}; ///< the law's reference pose over that of the body, a quaternion
  std::vector<joint::Marker> points; ///< of Port::points
  std::vector<int> motions;          ///< of Port::along_coordinates, in System::motions
  std::vector<int> bodies;           ///< of these motions, each once; -1: the ground

  /// A row of the joint that loads body B by lambda `on_b`: force and moment at B's marker, axes of
  /// marker A.
  struct Pressing {
    std::size_t row = 0; ///< in JointData::rows
    Vector6 on_b = Vector6::Zero();
  };
  std::vector<Pressing> reaction;          ///< of laws that feel that of their joint
  std::optional<element::Bearing> bearing; ///< of those among them that are friction
};

/// Laws of one type with their ports.
struct ElementList {
  std::shared_ptr<const element::Elements> laws;
  std::vector<PortData> ports; ///< one a law
  Index z0 = 0;                ///< states of the first law, in y
};

/// A motion that a force feels some time later.
struct DelayData {
  int motion = 0;
  double time = 0.0; ///< tau [s]
};

/// A point of a body whose motion is reported.
struct MarkerData {
  std::string name;
  int body = 0;
  Vector3 point = Vector3::Zero(); ///< from the centre of gravity, body axes [m]
  bool body_axes = false;          ///< of velocity and acceleration
};

/// A place where the elevation is reported.
struct GaugeData {
  std::string name;
  double x = 0.0, y = 0.0;   ///< where it stands [m]
  int marker = -1;           ///< in System::markers, with which it goes; -1: none
  std::vector<double> ahead; ///< of forecasts [s]
};

/// A coupler that holds at times only. While it is open it has no multipliers, and costs nothing.
///   stop      lower <= s <= upper; its load pushes back only
///   friction  stick: s' = 0 while |load| <= static_load; slip: load -+ kinetic_load (the signal of
///   its law). Of a law that the joint presses both are coefficients.
struct SwitchData {
  enum class Kind { stop, friction };
  enum class State { open, lower, upper, stick, forward, backward };
  Kind kind = Kind::stop;
  std::size_t number = 0; ///< in System::switches
  int coupler = 0;        ///< in System::couplers
  int motion = 0;         ///< in System::motions
  double lower = -INFINITY, upper = INFINITY, restitution = 0.0;
  double static_load = 0.0, kinetic_load = 0.0; ///< [N or N m], or coefficients [-]
  std::optional<double> contact_time;           ///< of an impact [s]
  int list = -1, law = -1;                      ///< of friction: in System::elements, and in there
  static bool holds(State state) {
    return state == State::lower || state == State::upper || state == State::stick;
  }
};

/// States of one element, one after the other in y.
struct StateBlock {
  std::string owner; ///< "force pto": in a list of costs
  std::string path;  ///< "forces/pto": their names begin with it
  Index first = 0;   ///< in y
  int body = -1;     ///< that moves, whose group and time are theirs too; -1: none
  std::vector<element::Unknown> unknowns;
};

/// Unknowns that guards and estimates judge together: of a body, of points that move by themselves
/// (nodes of a line), or other states of one element.
struct Block {
  std::string name;   ///< "buoy", "forces/chain"
  int body = -1;      ///< in System::bodies, or
  int states = -1;    ///< in System::states
  int group = -1;     ///< in System::error_group; -1: it cannot move
  bool moves = false; ///< a body, or points: its errors are displacements
};

struct System {
  // Written once, in system.cpp: it holds much, and many files hold one.
  System();
  ~System();
  System(const System&);
  System(System&&) noexcept;
  System& operator=(const System&);
  System& operator=(System&&) noexcept;

  double gravity = 9.81;
  std::vector<BodyData> bodies;
  std::vector<JointData> joints;
  std::vector<MotionData> motions;
  std::vector<RotationData> rotations;
  std::vector<CouplerData> couplers;
  std::vector<SwitchData> switches;
  std::vector<MarkerData> markers;
  std::vector<MotionStart> starts;
  std::vector<ElementList> elements;
  std::vector<DelayData> delays;
  HydroData hydro;

  Index n_q = 0, n_u = 0, n_z = 0;   ///< positions, velocities, states of elements
  Index u0 = 0, z0 = 0, lambda0 = 0; ///< where the last two begin in y, and the multipliers
  Index memory0 = 0; ///< states from there on are linear with constant coefficients, and condensed
  Index n_norms = 0; ///< of quaternions
  std::size_t n_rows = 0; ///< of constraint, those among them that never hold or not now
  std::vector<StateBlock> states;
  std::vector<Block> blocks;          ///< bodies, then states that there are, each in their order
  int n_mechanisms = 0, n_groups = 0; ///< of the bodies that can move (mechanisms.h)
  std::vector<int> group;             ///< (lambda0,) of each position, velocity and state
  std::vector<int> error_group;       ///< (lambda0,) the same; absolute states have their own
  VectorX group_size;                 ///< (n_error_groups,) how many of these each has
  bool scales_follow = true;          ///< the motion; else length_scale was given
  std::vector<std::string> notes;     ///< what the build found worth a note
  std::vector<GaugeData> gauges;
  sea::WaveField gauged; ///< what these see; without terms if there are no gauges

  Index n_error_groups() const { return group_size.size(); }
  bool has_memory() const { return memory0 < lambda0; }
  bool has_waves() const; ///< that any of the elements feels
};

/// Visits all constraint rows in the order of their multipliers: visit(row, velocity_level).
template <class Anysystem, class Visitor> void for_each_row(Anysystem& s, Visitor&& visit) {
  for (auto& j : s.joints)
    for (auto& row : j.rows)
      visit(row, false);
  for (auto& coupler : s.couplers)
    visit(coupler, coupler.velocity_level);
}

/// Visits all that loads the bodies, weight apart, in the order of states and results:
/// visit(list). Each type of list has a declaration (declare.h), loads and residuals (`add_loads`),
/// derivatives (`Assembly::add`) and observations (`Observer::observe`).
template <class Anysystem, class Visitor> void for_each_list(Anysystem& s, Visitor&& visit) {
  for (auto& list : s.elements)
    visit(list);
  if (s.hydro.n_moving > 0)
    visit(s.hydro);
}

/// Visits the points of a block of states: visit(place, velocity, length), the first two where they
/// begin in y, the last what displacements are measured by [m].
template <class Visitor> void for_each_point(const StateBlock& states, Visitor&& visit) {
  for (std::size_t k = 0; k < states.unknowns.size(); k += 6) {
    const Index place = states.first + static_cast<Index>(k);
    visit(place, place + 3, states.unknowns[k].length);
  }
}

/// Visits all laws: visit(list, its index, port).
template <class Visitor> void for_each_law(const System& s, Visitor&& visit) {
  for (const ElementList& list : s.elements)
    for (std::size_t k = 0; k < list.ports.size(); ++k)
      visit(list, k, list.ports[k]);
}

/// Visits the bodies that a port joins, -1: the ground.
template <class Visitor>
void for_each_body(const System& s, const PortData& port, Visitor&& visit) {
  if (port.joint >= 0) {
    const JointData& j = s.joints[static_cast<std::size_t>(port.joint)];
    visit(j.A.body);
    visit(j.B.body);
  } else if (port.body >= 0) {
    visit(port.body);
  }
  for (const joint::Marker& point : port.points)
    visit(point.body);
  for (const int body : port.bodies)
    visit(body);
}

/// Is a point of Port::points the first of those on its body?
inline bool is_first_of_its_body(const PortData& port, std::size_t point) {
  for (std::size_t i = 0; i < point; ++i)
    if (port.points[i].body == port.points[point].body)
      return false;
  return true;
}

/// Takes the waves away.
void calm(System& system);

/// Offsets of positions, velocities and states, numbers of rows and groups, after bodies, rows or
/// elements were added.
void number(System& system);

/// Time scales of bodies that are still without one, from the velocities and accelerations of the
/// start: the time in which a body moves, or speeds up by, its own length.
void take_time_scales(System& system, const VectorX& y, const VectorX& yp);

} // namespace hydrodae::system
