#pragma once
/// What loads the bodies, weight apart: lists of equal laws. A law knows no bodies. Its port says
/// what it sees of their motion and what its loads act on; the system gathers that motion into
/// numbers, and the list answers with loads and with the rates of the states that its laws have.
///
/// - along_joint: the coordinate s of a joint with one motion, s'; f on s [N, N m]; if wanted, what
///   the rows of the joint load body B with at its marker (force and moment, axes of marker A)
/// - along_coordinates: n motions of joints, or amplitudes of modes, and their rates; a load on
/// each
///   [N, N m]
/// - along_distance: the distance of two points, its rate; f pushes them apart [N]
/// - on_body: displacement from the reference pose, twist (6 each, earth axes); force and moment
///   about the centre of gravity
/// - between: displacement and rotation vector of marker B seen from marker A, relative velocities
///   (6 each); force and moment on B about its marker
/// - points: places of n points of bodies or the ground, their velocities (3 n each, earth axes);
///   a force on each [N]
/// - in_water: pose, velocities and accelerations of a body (body_state.h); force in world axes and
///   moment in body axes about the centre of gravity
///
/// The power of a load is load . v in all but the last.

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/element/body_state.h"
#include "hydrodae/math/dual.h"

namespace hydrodae::element {

enum class Port {
  along_joint,
  along_coordinates,
  along_distance,
  on_body,
  between,
  points,
  in_water
};

constexpr bool is_along(Port p) { return p == Port::along_joint || p == Port::along_distance; }
constexpr bool is_on_body(Port p) { return p == Port::on_body || p == Port::in_water; }
/// Does the system keep the gradients of what such a port sees? Others are simple.
constexpr bool has_rows(Port p) {
  return is_along(p) || p == Port::between || p == Port::along_coordinates;
}
/// @param n  number of points or of coordinates
constexpr int width(Port p, int n = 0) {
  if (p == Port::along_coordinates)
    return n;
  return p == Port::points ? 3 * n : is_along(p) ? 1 : 6;
}

/// How the work of a load counts in the balance of energy.
enum class Work {
  spent, ///< may take energy out of the motion for good
  lent,  ///< comes from outside, or comes back
  fluid, ///< is in the kinetic energy of the fluid
  part   ///< is in that of another load
};

/// An unknown z of a law: a state, z' = what the law answers, or algebraic, 0 = what it answers.
struct Unknown {
  std::string name, unit;
  double scale = 1.0; ///< what one unit of tolerance means, beside the relative one
  double start = 0.0;
  double rate = 0.0; ///< size of what the law answers where it counts; 0: of a state the scale over
                     ///< the time of the body, of an algebraic unknown the scale
  bool algebraic = false;
  bool absolute = false; ///< the scale alone says what counts, not its value, nor how far the
                         ///< bodies move
  double length = 0.0;   ///< of the first of six that are place and velocity of a point: what its
                         ///< displacements are measured by [m]; 0 for others
};

/// What a law reports beside its load.
struct Quantity {
  std::string_view name, unit, doc;
  int width = 1;
};

/// Points of a law with a sparse Jacobian, at most.
inline constexpr std::size_t most_sparse_points = 2;

/// A number that a law is given from outside, held until it is written again; without a name: by
/// the system itself.
struct Signal {
  std::string_view name, unit;
  double least = -INFINITY;
};

/// Of "N or N m": the first along a displacement, the second along an angle.
std::string unit_along(std::string_view unit, bool angle);

/// A law that sticks: s' = 0 while what holds it is at most `hold`, and slips with a load (or
/// coefficient) of `slide` against the motion, which is its signal. Both happen at located events.
struct Stick {
  double hold = 0.0, slide = 0.0; ///< [N or N m], or coefficients of what the joint presses [-]
};

/// A function of time that a law follows, known ahead: no step passes over what it does.
struct Schedule {
  std::string what;    ///< for messages: "the winch of rope ..."
  double finest = 0.0; ///< time within which it may change [s]
  std::function<double(double)> at;
};

/// What one law sees.
template <class S> struct In {
  double t;                      ///< [s]
  const S *x, *v;                ///< (width,)
  const S* z;                    ///< (n_states,)
  const double* signals;         ///< (n_signals,)
  const S* r = nullptr;          ///< (n_reaction,) force and moment [N, N m]
  const double* sides = nullptr; ///< (n_kinks,) see Elements::kinks

  /// Is the law on the positive side of kink k, whose number is `now`?
  bool beyond(int k, const S& now) const {
    return sides && sides[k] != 0.0 ? sides[k] > 0.0 : now > S(0);
  }
};

/// What it answers.
template <class S> struct Out {
  S* load;  ///< (width,)
  S* z_dot; ///< (n_states,) z', and what is to be zero
};

/// Numbers of one law of a list. Those in the water have no states; the columns of their Jacobian
/// are virtual displacements (world axes; rotations in body axes), velocities and accelerations of
/// the body, six each.
struct Shape {
  Port port = Port::on_body;
  int width = 6, n_states = 0, n_signals = 0;
  int n_algebraic = 0;     ///< of the n_states unknowns: the last ones
  int n_reaction = 0;      ///< 6: it feels the reaction of its joint
  bool feels_rates = true; ///< in the water: velocities and accelerations, else the pose alone
  bool in_water() const { return port == Port::in_water; }
  int n_in() const { ///< x, v, reaction, z
    return in_water() ? body_numbers : 2 * width + n_reaction + n_states;
  }
  int n_columns() const { return in_water() ? 18 : n_in(); } ///< of the Jacobian
  int n_out() const { return width + n_states; }             ///< load, z'
};

/// The waves that a list feels: their components, and what forces these put on each body.
struct WavesFelt {
  VectorX omega, amplitude;   ///< (n,) [rad/s], [m]
  std::vector<MatrixX> loads; ///< of each law (6, n), amplitudes; empty: it moves with the water
};

/// A load by the motion of the water at one point, linear in it.
struct WaterLoad {
  Vector3 point;                    ///< world axes
  Eigen::Matrix<double, 6, 7> load; ///< by velocity (3), acceleration (3) and elevation; on the
                                    ///< body, as in Port::in_water
};

/// A list of laws of one type: one virtual call for all of them. Arrays hold one law after the
/// other.
class Elements {
public:
  virtual ~Elements() = default;

  std::string_view type; ///< as in case files; "hydrostatic" and such for those of the water
  Shape shape;
  bool buoyant = false;          ///< the pressure of still water
  bool moors = false;            ///< a mooring as a matrix; what acts between points moors, too
  bool absorbs = false;          ///< a power take-off: what it takes is a device's output
  Work work = Work::spent;       ///< of the loads
  std::string_view at_rest_only; ///< why its slope at rest says little; empty: no reason
  std::string lost; ///< of laws that `lost_at_rest`: what a linear model lacks, in words
  std::vector<std::string_view> parts;      ///< of a load on a body, that are reported beside it
  std::vector<std::string> names;           ///< (n,)
  std::string_view folder = "forces";       ///< where the results list its channels
  std::vector<Unknown> unknowns;            ///< (n n_states,)
  std::vector<Quantity> channels;           ///< of each law
  std::vector<Signal> inputs;               ///< of each law (n_signals,)
  std::vector<double> signals;              ///< what they are at the start (n n_signals,)
  bool timed = false;                       ///< do loads depend on the time by themselves?
  bool tells_unknowns = true;               ///< are they reported one by one?
  std::vector<std::array<int, 2>> sparsity; ///< of laws on points: (row, column) of each entry of
                                            ///< the Jacobian that can differ from 0; empty: all can
  std::vector<Schedule> schedules;
  std::vector<Stick> sticks; ///< of each law along a joint; empty: none ever sticks
  int n_kinks = 0;           ///< of each law; see `kinks`
  int side_at = 0;           ///< place among the signals of a law of the sides of its kinks

  std::size_t size() const { return names.size(); }
  /// Path of a channel or an input of one law: "forces/pto/damping". A name that begins with "/" is
  /// a whole path.
  std::string path(std::size_t law, std::string_view name) const {
    if (name.starts_with('/'))
      return std::string(name.substr(1));
    return std::string(folder) + "/" + names[law] + (name.empty() ? "" : "/") + std::string(name);
  }
  bool has_kinks() const { return n_kinks > 0; }
  /// Numbers of the Jacobian of one law.
  std::size_t jacobian_size() const {
    return sparsity.empty() ? static_cast<std::size_t>(shape.n_out() * shape.n_columns())
                            : sparsity.size();
  }
  /// Numbers of `channels` of one law.
  std::size_t channel_size() const {
    std::size_t n = 0;
    for (const Quantity& q : channels)
      n += static_cast<std::size_t>(q.width);
    return n;
  }

  /// @param in       (n n_in,)
  /// @param signals  (n n_signals,)
  /// @param out      (n n_out,)
  virtual void evaluate(double t, const double* in, const double* signals, double* out) const = 0;

  /// The same on dual numbers: the oracle of tests.
  virtual void evaluate(double t, const Dual* in, const double* signals, Dual* out) const = 0;

  /// @param jacobian  (n jacobian_size,) d out / d in of each law, column by column, or in the
  /// order of `sparsity`
  virtual void jacobian(double t, const double* in, const double* signals,
                        double* jacobian) const = 0;

  /// Stored energy of each law [J] (n,), that a potential gives back.
  virtual void energy(const double* in, const double* signals, double* joules) const = 0;

  /// Values of `channels` (n channel_size,); `out`: of `evaluate`.
  virtual void observe(double t, const double* in, const double* signals, const double* out,
                       double* values) const = 0;

  /// Loads on bodies as they are reported, also along coordinates that do not move, and their
  /// parts: (n, 1 + n_parts, 6); by default the load alone. `out`: of `evaluate`.
  virtual void report(double t, const double* in, const double* out, double* loads) const;

  /// Why this law has a load that is no number, in words; empty: nothing is known of it.
  virtual std::string trouble(std::size_t /*law*/, const double* /*in*/) const { return {}; }

  /// Does this law have a load that has no slope at rest (so that no linear model has it)?
  virtual bool lost_at_rest(std::size_t law) const = 0;

  /// The same whose unknowns start at rest where the laws are, in calm water; null: they start as
  /// declared. `in`: as in `evaluate`, its unknowns are not read. Throws ModelError.
  virtual std::shared_ptr<const Elements> started(const double*) const { return nullptr; }
  /// Laws without unknowns, with the loads of these laws at rest in calm water; null: they are the
  /// same.
  virtual std::shared_ptr<const Elements> statics() const { return nullptr; }

  /// Numbers that change their sign where the load of a law, or its slope, jumps (n n_kinks,). Its
  /// signals hold the side of each, 1 or -1: there the law is what it is on that side, smoothly
  /// continued, until the event; 0: it is as the numbers say. Where they jump need not be at zero.
  virtual void kinks(double, const double* /*in*/, const double* /*signals*/,
                     double* /*out*/) const {}

  /// The same for a run that reports no loads, without what reports alone need; null: it is the
  /// same.
  virtual std::shared_ptr<const Elements> unreported() const { return nullptr; }

  // Of what feels the waves:
  virtual WavesFelt waves() const { return {}; }         ///< without any: nothing
  virtual double elevation(double) const { return 0.0; } ///< at the origin, at time t [m]
  /// What the water does to one law, seen as in `evaluate`, for the linear model.
  virtual std::vector<WaterLoad> by_water(std::size_t, const double*) const { return {}; }
  /// The same without waves; null: it is the same.
  virtual std::shared_ptr<const Elements> calm() const { return nullptr; }
  /// The same in fully grown waves, each component at a phase pi `draw()`; null: it is the same.
  virtual std::shared_ptr<const Elements> stirred(const std::function<double()>&) const {
    return nullptr;
  }
};

/// A law about rest.
struct AtRest {
  VectorX load;               ///< (width,)
  MatrixX stiffness, damping; ///< (width, width) -d load / dx, -d load / dv
};

/// All laws of a list about rest at x (n width,), zero where it is empty, z and signals at their
/// starts; in the water: zero.
std::vector<AtRest> at_rest(const Elements& list, const VectorX& x = {});

} // namespace hydrodae::element
