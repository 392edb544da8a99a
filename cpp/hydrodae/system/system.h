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
/// A System is constant once built. A Regime (regime.h) holds which rows apply at a time of a run,
/// and the places of their multipliers in y.

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
  /// True: a mode, whose x is its amplitude
  bool is_mode() const { return kind == Kind::mode; }
  double mass = 0.0;                   ///< [kg]
  Matrix3 inertia = Matrix3::Zero();   ///< inertia about the centre of gravity, body axes [kg m2]
  Vector3 reference = Vector3::Zero(); ///< centre of gravity in the reference pose [m]
  /// Position at the start; constant along locked translations [m]
  Vector3 position = Vector3::Zero();
  /// Orientation at the start; constant if the rotation is locked
  Vector4 orientation{1, 0, 0, 0};
  Vector3 velocity = Vector3::Zero();         ///< velocity at the start [m/s]
  Vector3 angular_velocity = Vector3::Zero(); ///< angular velocity at the start, body axes [rad/s]
  Rotation rotation = Rotation::locked;
  int axis = 1;                ///< axis of Rotation::about_axis
  std::array<int, 6> active{}; ///< tangent component of each velocity unknown
  int n_active = 0;            ///< number of velocity unknowns
  int n_translations = 0;      ///< number of translations among them (they come first)
  int n_position = 0;          ///< number of position unknowns (n_active, or 7)
  Index q0 = 0, u0 = 0;        ///< offsets into y
  /// Number of its quaternion among those of all bodies; -1: no quaternion
  Index norm = -1;
  double length_scale = 1.0; ///< length that position errors are relative to [m]
  double lever = 1.0;        ///< lever that converts lengths into angles [m]
  /// Arm to its farthest joint [m]; the lever if all joints are at its centre
  double arm = 1.0;
  /// False: taken from the motion at the start (no gravity, no scale given)
  bool time_scale_known = true;
  double time_scale = 1.0; ///< time that converts lengths into velocities [s]
  /// Mass of the body, or if that is zero the largest mass of its group [kg]
  double scale_mass = 1.0;
  /// Index of its rotation in System::rotations; -1: not free, or locked
  int followed = -1;
  /// Number of its mechanism (bodies connected by constraint rows); -1: fixed
  int mechanism = -1;
  /// Number of its group (bodies that act on each other by rows, forces or the water)
  int group = -1;
};

/// Index in place of a multiplier: the row follows from others
inline constexpr Index redundant = -1;

/// Constraint row, with two multipliers while it holds.
struct Row {
  std::size_t number = 0; ///< number among all rows
  bool dropped = false;   ///< true: the row follows from others and never holds
};

/// Row of a joint that restricts a free coordinate.
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
  int first_motion = 0;      ///< index of its first motion in System::motions
  bool hidden = false;       ///< true: stands for a coordinate of a body; not reported
};

/// Coordinate along a free motion of a joint. Angles count full turns: Workspace::turns holds the
/// value at the last accepted step.
struct MotionData {
  int joint = 0;
  joint::FreeMotion motion;
  std::string name;   ///< angle, displacement, angle_2, ...
  double start = 0.0; ///< approximate value at the start: selects the turn of an angle
};

/// Rotation that a law or the results use as a vector: of a body from its reference pose rotated by
/// `turn`, or of marker B of a joint against marker A. It counts full turns as angles do.
struct RotationData {
  int body = -1, joint = -1;
  Vector4 turn{1, 0, 0, 0};
};

/// Prescribed value or rate of a motion at the start; the assembly solves for it together with the
/// joints.
struct MotionStart {
  int motion = 0;
  std::optional<double> value, rate;
};

/// Condition on motions: sum_k factor_k s_k = offset + f(t), or on their rates: = f(t).
struct CouplerData : Row {
  struct Term {
    int motion = 0;
    double factor = 1.0;
  };
  std::string name;
  std::vector<Term> terms;
  double offset = 0.0;
  Drive drive;
  bool velocity_level = false; ///< true: a condition on rates, without mu
  bool keeps_start = false;    ///< true: the offset is the sum of the terms at the start
  int of_switch = -1;          ///< index in System::switches; -1: the coupler always holds
  bool hidden = false;         ///< true: holds an attachment; not reported
};

/// Connection of a law to the bodies: along one or several motions, on a body, or between the
/// markers of a (hidden) joint.
struct PortData {
  std::string component; ///< name of the component in the results
  int motion = -1;       ///< index in System::motions
  int delay = -1;        ///< index in System::delays; -1: no delay
  int body = -1;         ///< index in System::bodies
  /// Body whose state the law of a port in the water reads; -1: `body`. The waves on a mode follow
  /// the pose of the body that deforms.
  int carrier = -1;
  int seen() const { return carrier < 0 ? body : carrier; }
  int joint = -1; ///< index in System::joints; for a motion, its joint
  /// Index in System::rotations of the rotation that the law reads as a vector; -1: none
  int followed = -1;
  /// Rotation from the body's reference pose to that of the law, a quaternion
  Vector4 turn{1, 0, 0, 0};
  std::vector<joint::Marker> points; ///< points of Port::points
  /// Motions of Port::along_coordinates, indices in System::motions
  std::vector<int> motions;
  std::vector<int> bodies; ///< bodies of `motions`, each once; -1: the ground

  /// Row of a joint that loads body B by lambda `on_b`: force and moment at marker B, in the axes
  /// of marker A.
  struct Pressing {
    std::size_t row = 0; ///< index in JointData::rows
    Vector6 on_b = Vector6::Zero();
  };
  /// Reaction rows of the joint, for laws that depend on them
  std::vector<Pressing> reaction;
  /// Bearing, for friction laws that depend on the reaction
  std::optional<element::Bearing> bearing;
};

/// Laws of one type, with their ports.
struct ElementList {
  std::shared_ptr<const element::Elements> laws;
  std::vector<PortData> ports; ///< one port for each law
  Index z0 = 0;                ///< offset of the states of the first law in y
};

/// Motion that a force reads with a delay.
struct DelayData {
  int motion = 0;
  double time = 0.0; ///< delay tau [s]
};

/// Point of a body whose motion is reported.
struct MarkerData {
  std::string name;
  int body = 0;
  Vector3 point = Vector3::Zero(); ///< position relative to the centre of gravity, body axes [m]
  bool body_axes = false;          ///< true: velocity and acceleration are in body axes
};

/// Place where the elevation is reported.
struct GaugeData {
  std::string name;
  double x = 0.0, y = 0.0;   ///< position [m]
  int marker = -1;           ///< index in System::markers of the marker that carries it; -1: fixed
  std::vector<double> ahead; ///< lead times of forecasts [s]
};

/// Coupler that holds only at times. While open, it has no multipliers and costs nothing.
///   stop      lower <= s <= upper; its load pushes back only
///   friction  stick: s' = 0 while |load| <= static_load; slip: load -+ kinetic_load (the signal of
///   its law). With a bearing both are coefficients.
struct SwitchData {
  enum class Kind { stop, friction };
  enum class State { open, lower, upper, stick, forward, backward };
  Kind kind = Kind::stop;
  std::size_t number = 0; ///< index in System::switches
  int coupler = 0;        ///< index in System::couplers
  int motion = 0;         ///< index in System::motions
  double lower = -INFINITY, upper = INFINITY, restitution = 0.0;
  double static_load = 0.0, kinetic_load = 0.0; ///< [N or N m], or coefficients [-]
  std::optional<double> contact_time;           ///< duration of an impact [s]
  /// Indices of a friction law: list in System::elements, law in the list
  int list = -1, law = -1;
  static bool holds(State state) {
    return state == State::lower || state == State::upper || state == State::stick;
  }
};

/// States of one element, contiguous in y.
struct StateBlock {
  std::string owner; ///< "force pto": name in the list of costs
  std::string path;  ///< "forces/pto": prefix of the names of the states
  Index first = 0;   ///< offset in y
  int body = -1;     ///< moving body whose group and time scale the states take; -1: none
  std::vector<element::Unknown> unknowns;
};

/// Unknowns that guards and estimates judge together: of a body, of points that move by themselves
/// (nodes of a line), or other states of one element.
struct Block {
  std::string name;   ///< "buoy", "forces/chain"
  int body = -1;      ///< index in System::bodies, or -1
  int states = -1;    ///< index in System::states, or -1
  int group = -1;     ///< index of its error group, see System::error_group; -1: fixed
  bool moves = false; ///< true for bodies and points: the errors are displacements
};

struct System {
  // Defined in system.cpp once: the class is large, and many files use it.
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

  Index n_q = 0, n_u = 0, n_z = 0;   ///< number of positions, velocities, states of elements
  Index u0 = 0, z0 = 0, lambda0 = 0; ///< offsets of velocities, states and multipliers in y
  Index memory0 = 0;      ///< offset of the condensed states: linear with constant coefficients
  Index n_norms = 0;      ///< number of quaternions
  std::size_t n_rows = 0; ///< number of constraint rows, including those that never hold or not now
  std::vector<StateBlock> states;
  std::vector<Block> blocks;          ///< bodies, then existing states, each in their order
  int n_mechanisms = 0, n_groups = 0; ///< numbers for the bodies that can move (mechanisms.h)
  std::vector<int> group;             ///< (lambda0,) group of each position, velocity and state
  /// (lambda0,) error group: as `group`, but absolute states have their own
  std::vector<int> error_group;
  VectorX group_size; ///< (n_error_groups,) number of unknowns in each
  /// True: scales follow the motion; false: length_scale was given
  bool scales_follow = true;
  std::vector<std::string> notes; ///< notes of the build to the user
  std::vector<GaugeData> gauges;
  sea::WaveField gauged; ///< waves at the gauges; without terms if there are no gauges

  Index n_error_groups() const { return group_size.size(); }
  bool has_memory() const { return memory0 < lambda0; }
  bool has_waves() const; ///< true if any element reads waves.
};

/// Visits all constraint rows in the order of their multipliers: visit(row, velocity_level).
template <class Anysystem, class Visitor> void for_each_row(Anysystem& s, Visitor&& visit) {
  for (auto& j : s.joints)
    for (auto& row : j.rows)
      visit(row, false);
  for (auto& coupler : s.couplers)
    visit(coupler, coupler.velocity_level);
}

/// Visits all lists that load the bodies (weight excluded), in the order of states and results:
/// visit(list). Each type of list has a declaration (declare.h), loads and residuals (`add_loads`),
/// derivatives (`Assembly::add`) and observations (`Observer::observe`).
template <class Anysystem, class Visitor> void for_each_list(Anysystem& s, Visitor&& visit) {
  for (auto& list : s.elements)
    visit(list);
  if (s.hydro.n_moving > 0)
    visit(s.hydro);
}

/// Visits the points of a block of states: visit(place, velocity, length). The first two are
/// offsets in y; displacements are relative to `length` [m].
template <class Visitor> void for_each_point(const StateBlock& states, Visitor&& visit) {
  for (std::size_t k = 0; k < states.unknowns.size(); k += 6) {
    const Index place = states.first + static_cast<Index>(k);
    visit(place, place + 3, states.unknowns[k].length);
  }
}

/// Visits all laws: visit(list, index of the law, port).
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

/// Returns whether a point of Port::points is the first one on its body.
inline bool is_first_of_its_body(const PortData& port, std::size_t point) {
  for (std::size_t i = 0; i < point; ++i)
    if (port.points[i].body == port.points[point].body)
      return false;
  return true;
}

/// Removes the waves.
void calm(System& system);

/// Sets the offsets of positions, velocities and states and the numbers of rows and groups, after
/// bodies, rows or elements were added.
void number(System& system);

/// Sets the missing time scales of bodies from velocities and accelerations at the start: the time
/// in which a body moves, or accelerates, by its own length.
void take_time_scales(System& system, const VectorX& y, const VectorX& yp);

} // namespace hydrodae::system
