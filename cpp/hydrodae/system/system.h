#pragma once
/// The equations of motion of a scene (constant after `build`), in the stabilised index-2 form of
/// Gear, Gupta and Leimkuhler (J. Comput. Appl. Math. 12-13 (1985) 77-90):
///
///   q' = E(q) (u + G^T mu) + sigma p            p.p = 1 for each quaternion
///   M(q) u' = f(t, q, u, z) + G^T lambda
///   0 = g(q)        0 = G(q) u
///   z' = h(q, u, z)                             states of elements, radiation memory last
///
/// State vector y = [q | u | z | lambda | mu | sigma]; the row of an algebraic unknown holds the
/// equation it belongs to: lambda - velocity constraint, mu - position constraint, sigma - norm.

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
#include "hydrodae/model/scene.h"
#include "hydrodae/system/hydro_data.h"

namespace hydrodae::system {

/// Coordinates of one body. Tangent components 0..2 are translations (world axes), 3..5 rotations
/// (body axes); only the free ones are unknowns.
struct BodyData {
  enum class Rotation { locked, about_axis, free };
  std::string name;
  double mass = 0.0;                          ///< [kg]
  Matrix3 inertia = Matrix3::Zero();          ///< about the centre of gravity, body axes [kg m2]
  Vector3 reference = Vector3::Zero();        ///< centre of gravity in the reference pose [m]
  Vector3 position = Vector3::Zero();         ///< start, and for ever along locked translations [m]
  Vector4 orientation{1, 0, 0, 0};            ///< start, and for ever if the rotation is locked
  Vector3 velocity = Vector3::Zero();         ///< start [m/s]
  Vector3 angular_velocity = Vector3::Zero(); ///< start, body axes [rad/s]
  Rotation rotation = Rotation::locked;
  int axis = 1;                     ///< of Rotation::about_axis
  std::array<int, 6> active{};      ///< tangent component of each velocity unknown
  int n_active = 0;                 ///< number of velocity unknowns
  int n_translations = 0;           ///< how many of them are translations (they come first)
  int n_position = 0;               ///< number of position unknowns (n_active, or 7)
  Index q0 = 0, u0 = 0, sigma = -1; ///< offsets into y
  double length_scale = 1.0;        ///< [m], what a position error is measured by
  double lever = 1.0;               ///< [m], turns lengths into angles
  bool time_scale_known = true;     ///< else taken from the start (no gravity, none given)
  double time_scale = 1.0;          ///< [s], turns lengths into velocities
  int mechanism = -1; ///< of bodies that constraint rows hold together; -1: cannot move
  int group = -1;     ///< of bodies that move each other in any way: by rows, forces, or the water
};

inline constexpr Index redundant = -1; ///< in place of a multiplier: the row follows from others

/// One constraint row that restricts a free coordinate, with its two multipliers.
struct RowData {
  joint::BasicRow kind;
  Index lambda = 0, mu = 0;
  bool kept() const { return lambda != redundant; }
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
  double start = 0.0; ///< near the value at the start: tells the turn of an angle
};

/// What a motion is to be at the start; met by the assembly together with the joints.
struct MotionStart {
  int motion = 0;
  std::optional<double> value, rate;
};

/// A condition on motions: sum_k factor_k s_k = offset + f(t), or on their rates: = f(t).
struct CouplerData {
  struct Term {
    int motion = 0;
    double factor = 1.0;
  };
  std::string name;
  std::vector<Term> terms;
  double offset = 0.0;
  model::Drive drive;
  bool velocity_level = false; ///< then it has no mu
  Index lambda = 0, mu = 0;
  bool kept() const { return lambda != redundant; }
};

/// Where a law is joined to the bodies: along a motion, on a body, or between the markers of a
/// (hidden) joint.
struct PortData {
  std::string component;    ///< under which the results list its loads
  int motion = -1;          ///< in System::motions
  int delay = -1;           ///< in System::delays, -1: none
  int body = -1;            ///< in System::bodies
  int joint = -1;           ///< in System::joints; of a motion: its own
  Vector4 turn{1, 0, 0, 0}; ///< the law's reference pose over that of the body, a quaternion
  std::vector<joint::Marker> points; ///< of Port::points

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
  std::vector<double> signals; ///< held from event to event
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

/// A coupler that holds at times only. While it is open its multipliers are `redundant`, and it
/// costs nothing.
///   stop      lower <= s <= upper; its load pushes back only
///   friction  stick: s' = 0 while |load| <= static_load; slip: load -+ kinetic_load (the signal of
///   its law). Of a law that the joint presses both are coefficients.
struct SwitchData {
  enum class Kind { stop, friction };
  enum class State { open, lower, upper, stick, forward, backward };
  Kind kind = Kind::stop;
  State state = State::open;
  int coupler = 0; ///< in System::couplers
  int motion = 0;  ///< in System::motions
  double lower = -INFINITY, upper = INFINITY, restitution = 0.0;
  double static_load = 0.0, kinetic_load = 0.0; ///< [N or N m], or coefficients [-]
  std::optional<double> contact_time;           ///< of an impact [s]
  int list = -1, law = -1;                      ///< of friction: in System::elements, and in there
  bool holds() const {
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

/// Which equations the rows of the multipliers hold. In all but the first mu = 0.
///   stabilised   0 = g, 0 = G u               index 2 (Gear, Gupta and Leimkuhler)
///   index_2      0 = G u                      the gap g drifts
///   index_3      0 = g
///   index_1      0 = G u' + gamma + 2 b (G u) + b^2 g    Baumgarte's rate b [1/s], 0: none
/// Rows given at velocity level stay there, but in index 1.
enum class Formulation { stabilised, index_2, index_3, index_1 };

class History;

struct System {
  // Written once, in system.cpp: it holds much, and many files hold one.
  System();
  ~System();
  System(const System&);
  System(System&&) noexcept;
  System& operator=(const System&);
  System& operator=(System&&) noexcept;

  double gravity = 9.81;
  Formulation formulation = Formulation::stabilised;
  double baumgarte_rate = 0.0; ///< b of index 1 [1/s]
  std::vector<BodyData> bodies;
  std::vector<JointData> joints;
  std::vector<MotionData> motions;
  std::vector<CouplerData> couplers;
  std::vector<SwitchData> switches;
  std::vector<MarkerData> markers;
  std::vector<MotionStart> starts;
  std::vector<ElementList> elements;
  std::vector<DelayData> delays;
  HydroData hydro;

  /// What has happened up to the last accepted step (history.h); owned by the run. Null: all has
  /// been at rest for ever.
  const History* history = nullptr;

  Index n = 0;                     ///< unknowns
  Index n_q = 0, n_u = 0, n_z = 0; ///< positions, velocities, states of elements
  Index n_lambda = 0, n_mu = 0;    ///< rows at velocity level, those also at position level
  Index u0 = 0, z0 = 0, lambda0 = 0, mu0 = 0, sigma0 = 0;
  Index memory0 = 0; ///< states from there on are linear with constant coefficients, and condensed
  std::vector<StateBlock> states;
  int n_mechanisms = 0, n_groups = 0; ///< of the bodies that can move (mechanisms.h)
  std::vector<int> group;             ///< (lambda0,) of each position, velocity and state
  std::vector<int> error_group;       ///< (lambda0,) the same; absolute states have their own
  VectorX group_size;                 ///< (n_error_groups,) how many of these each has
  bool scales_follow = true;          ///< the motion; else length_scale was given
  VectorX motion_scale;               ///< (n_groups,) part of the full scales that its motion takes
  VectorX translation_scale;          ///< (n_groups,) of which its translations take so much
  VectorX scale;                      ///< (n,) what one unit of tolerance means for each unknown
  VectorX relative;                   ///< (n,) 1 where the tolerance also grows with |y|, else 0
  VectorX row_scale;                  ///< (n,) size of each residual row that matters, for messages
  std::vector<bool> algebraic;        ///< (n,) multipliers, and what elements declare so
  std::vector<std::string> names;     ///< (n,) of the unknowns, as channels
  std::vector<std::string> row_names; ///< (n,) of the equations
  std::vector<std::string> notes;     ///< what the build found worth telling

  Index n_error_groups() const { return group_size.size(); }
  /// A state whose scale does not follow the motion.
  bool is_absolute(Index i) const { return i >= z0 && i < lambda0 && relative[i] == 0.0; }
  bool is_algebraic(Index i) const { return algebraic[static_cast<std::size_t>(i)]; }
  bool has_memory() const { return memory0 < lambda0; }
  bool has_waves() const; ///< that any of the elements feels
};

/// Visits all constraint rows in the order of their multipliers: visit(lambda, mu, velocity_level).
template <class Anysystem, class Visitor> void for_each_row(Anysystem& s, Visitor&& visit) {
  for (auto& j : s.joints)
    for (auto& row : j.rows)
      visit(row.lambda, row.mu, false);
  for (auto& coupler : s.couplers)
    visit(coupler.lambda, coupler.mu, coupler.velocity_level);
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
}
/// Takes the waves away.
void calm(System& system);

/// Builds the system of a checked scene: dofs, markers, constraint rows that matter, hydrodynamics,
/// scales; the excitation of the sea is that of the start, or left out. Throws ModelError.
System build(const model::Scene& scene, bool with_excitation = true);

/// Puts a switch into a state: its coupler holds or not, its friction slips or not. Then
/// `lay_out` has to be called; of y only q, u, z keep their places.
void set_state(System& system, SwitchData& element, SwitchData::State state);

/// Offsets, scales and names of all unknowns, after rows came or went.
void lay_out(System& system);

/// Time scales of bodies that have none yet, from the velocities and accelerations of the start:
/// the time in which a body moves, or speeds up by, its own length. The tolerances follow.
void take_time_scales(System& system, const VectorX& y, const VectorX& yp);

/// The start: y with positions, velocities, states as declared and zero multipliers.
VectorX initial_state(const System& system);

} // namespace hydrodae::system
