#pragma once
/// Loads on the bodies (weight excluded) as lists of equal laws. A law knows no bodies. Its port
/// defines the motion that it reads and the coordinates that it loads. The system collects the
/// inputs; the list returns loads and the rates of its states.
///
/// - along_joint: coordinate s of a joint with one motion, and s'; load f on s [N, N m]. Optional:
/// the
///   reaction of the joint on body B at its marker (force and moment, axes of marker A)
/// - along_coordinates: n motions of joints, or amplitudes of modes, and their rates; one load on
///   each [N, N m]
/// - along_distance: distance of two points and its rate; f pushes them apart [N]
/// - on_body: displacement from the reference pose, twist (6 each, earth axes); force and moment
///   about the centre of gravity
/// - between: displacement and rotation vector of marker B seen from marker A, relative velocities
///   (6 each); force and moment on B about its marker
/// - points: places of n points of bodies or the ground, their velocities (3 n each, earth axes);
///   a force on each [N]
/// - in_water: pose, velocities and accelerations of a body (body_state.h); force in world axes and
///   moment in body axes about the centre of gravity
///
/// The power of a load is load . v for all ports except in_water.

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
/// Returns whether the system keeps the gradients of the inputs of this port.
constexpr bool has_rows(Port p) {
  return is_along(p) || p == Port::between || p == Port::along_coordinates;
}
/// @param n  number of points or of coordinates
constexpr int width(Port p, int n = 0) {
  if (p == Port::along_coordinates)
    return n;
  return p == Port::points ? 3 * n : is_along(p) ? 1 : 6;
}

/// Part of a load's work in the energy balance.
enum class Work {
  spent, ///< may take energy out of the motion permanently
  lent,  ///< comes from outside, or is returned
  fluid, ///< counted in the kinetic energy of the fluid
  part   ///< counted in the work of another load
};

/// Unknown z of a law: a state with z' = h(x, v, z), or algebraic with 0 = h(x, v, z).
struct Unknown {
  std::string name, unit;
  double scale = 1.0; ///< size of one unit of tolerance, besides the relative tolerance
  double start = 0.0;
  /// Size of h that matters; 0: scale over the time scale of the body (state), or scale (algebraic)
  double rate = 0.0;
  bool algebraic = false;
  /// True: the tolerance follows `scale` alone, not the value or the motion of the bodies
  bool absolute = false;
  /// Length that displacements of a point are relative to [m], on the first of its six unknowns
  /// (place and velocity); 0 for others
  double length = 0.0;
};

/// Quantity that a law reports besides its load.
struct Quantity {
  std::string_view name, unit, doc;
  int width = 1;
};

/// Largest number of points of a law with a sparse Jacobian.
inline constexpr std::size_t most_sparse_points = 2;

/// Input that a law receives from outside, held until it is written again. An empty name: the
/// system writes it.
struct Signal {
  std::string_view name, unit;
  double least = -INFINITY;
};

/// Unit from "N or N m": the first for a displacement, the second for an angle.
std::string unit_along(std::string_view unit, bool angle);

/// Law that sticks and slips. It sticks (s' = 0) while the reaction is at most `hold`. It slips
/// with a load or coefficient `slide` against the motion, its signal. Events locate both changes.
struct Stick {
  double hold = 0.0, slide = 0.0; ///< loads [N or N m], or coefficients of the bearing load [-]
};

/// Function of time that a law follows, known in advance: no step passes over its changes.
struct Schedule {
  std::string what;    ///< name in messages: "the winch of rope ..."
  double finest = 0.0; ///< shortest time in which it may change [s]
  std::function<double(double)> at;
};

/// Inputs of one law.
template <class S> struct In {
  double t;                      ///< [s]
  const S *x, *v;                ///< (width,)
  const S* z;                    ///< (n_states,)
  const double* signals;         ///< (n_signals,)
  const S* r = nullptr;          ///< (n_reaction,) force and moment [N, N m]
  const double* sides = nullptr; ///< (n_kinks,) see Elements::kinks

  /// Returns whether the law is on the positive side of kink k, whose number is `now`.
  bool beyond(int k, const S& now) const {
    return sides && sides[k] != 0.0 ? sides[k] > 0.0 : now > S(0);
  }
};

/// Outputs of one law.
template <class S> struct Out {
  S* load;  ///< (width,)
  S* z_dot; ///< (n_states,) rates z', or residuals of algebraic unknowns
};

/// Sizes of one law of a list. Laws in water have no states; the columns of their Jacobian are
/// virtual displacements (world axes; rotations in body axes), velocities and accelerations of the
/// body, six each.
struct Shape {
  Port port = Port::on_body;
  int width = 6, n_states = 0, n_signals = 0;
  int n_algebraic = 0; ///< number of algebraic unknowns, the last ones of the n_states
  int n_reaction = 0;  ///< 6: the law reads the reaction of its joint
  /// Laws in water, true: reads velocities and accelerations; false: only the pose
  bool feels_rates = true;
  bool in_water() const { return port == Port::in_water; }
  int n_in() const { ///< x, v, reaction, z
    return in_water() ? body_numbers : 2 * width + n_reaction + n_states;
  }
  int n_columns() const { return in_water() ? 18 : n_in(); } ///< columns of the Jacobian
  int n_out() const { return width + n_states; }             ///< load, z'
};

/// Waves that a list reads: their components, and their load on each body.
struct WavesFelt {
  VectorX omega, amplitude; ///< (n,) [rad/s], [m]
  /// Load amplitudes of each law (6, n); empty: the law moves with the water
  std::vector<MatrixX> loads;
};

/// Load from the motion of the water at one point, linear in it.
struct WaterLoad {
  Vector3 point; ///< world axes
  /// Derivatives by velocity (3), acceleration (3) and elevation; loads as in Port::in_water
  Eigen::Matrix<double, 6, 7> load;
};

/// List of laws of one type: one virtual call evaluates all. Arrays hold one law after the other.
class Elements {
public:
  virtual ~Elements() = default;

  std::string_view type; ///< type as in case files; for loads of the water "hydrostatic" and others
  Shape shape;
  bool buoyant = false; ///< true: includes the pressure of still water
  /// True: a mooring matrix; laws between points count as moorings, too
  bool moors = false;
  /// True: a power take-off, whose absorbed power is the output of the device
  bool absorbs = false;
  Work work = Work::spent;       ///< part of its work in the energy balance
  std::string_view at_rest_only; ///< reason why the slope at rest says little; empty: no reason
  std::string lost;              ///< effect that a linear model lacks, for laws that `lost_at_rest`
  /// Parts of a load on a body that are reported besides the load
  std::vector<std::string_view> parts;
  std::vector<std::string> names;     ///< (n,)
  std::string_view folder = "forces"; ///< folder of its channels in the results
  std::vector<Unknown> unknowns;      ///< (n n_states,)
  std::vector<Quantity> channels;     ///< channels of each law
  std::vector<Signal> inputs;         ///< inputs of each law (n_signals,)
  std::vector<double> signals;        ///< signals at the start (n n_signals,)
  bool timed = false;                 ///< true: loads depend explicitly on time
  bool tells_unknowns = true;         ///< true: unknowns are reported one by one
  /// Laws on points: (row, column) of the nonzeros of the Jacobian; empty: the Jacobian is full
  std::vector<std::array<int, 2>> sparsity;
  std::vector<Schedule> schedules;
  std::vector<Stick> sticks; ///< sticking law along each joint; empty: none sticks
  int n_kinks = 0;           ///< number of kinks of each law; see `kinks`
  int side_at = 0;           ///< index of the first side of a kink among the signals of a law

  std::size_t size() const { return names.size(); }
  /// Path of a channel or an input of one law, "forces/pto/damping". A name that begins with "/" is
  /// a complete path.
  std::string path(std::size_t law, std::string_view name) const {
    if (name.starts_with('/'))
      return std::string(name.substr(1));
    return std::string(folder) + "/" + names[law] + (name.empty() ? "" : "/") + std::string(name);
  }
  bool has_kinks() const { return n_kinks > 0; }
  /// Number of stored Jacobian entries of one law.
  std::size_t jacobian_size() const {
    return sparsity.empty() ? static_cast<std::size_t>(shape.n_out() * shape.n_columns())
                            : sparsity.size();
  }
  /// Number of values in the `channels` of one law.
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

  /// Evaluation on dual numbers, as the reference of tests.
  virtual void evaluate(double t, const Dual* in, const double* signals, Dual* out) const = 0;

  /// @param jacobian  (n jacobian_size,) d out / d in of each law, column by column, or in the
  /// order of `sparsity`
  virtual void jacobian(double t, const double* in, const double* signals,
                        double* jacobian) const = 0;

  /// Stored energy of each law [J] (n,), which its potential returns.
  virtual void energy(const double* in, const double* signals, double* joules) const = 0;

  /// Values of `channels` (n channel_size,). `out`: result of `evaluate`.
  virtual void observe(double t, const double* in, const double* signals, const double* out,
                       double* values) const = 0;

  /// Loads on bodies for the results, including locked coordinates, and their parts: (n, 1 +
  /// n_parts, 6). The default is the load alone. `out`: result of `evaluate`.
  virtual void report(double t, const double* in, const double* out, double* loads) const;

  /// Reason why the load of this law is not a number; empty: unknown.
  virtual std::string trouble(std::size_t /*law*/, const double* /*in*/) const { return {}; }

  /// Returns whether a load of this law has no slope at rest, so that no linear model contains it.
  virtual bool lost_at_rest(std::size_t law) const = 0;

  /// Laws whose unknowns start in equilibrium at the present pose, in calm water; null: they start
  /// as declared. `in`: as in `evaluate`, without the unknowns. Throws ModelError.
  virtual std::shared_ptr<const Elements> started(const double*) const { return nullptr; }
  /// Laws without unknowns, with the same loads at rest in calm water; null: the list itself.
  virtual std::shared_ptr<const Elements> statics() const { return nullptr; }

  /// Switching functions, which change sign where the load of a law or its slope jumps (n
  /// n_kinks,). Signals hold the side of each, 1 or -1: up to the event the law continues smoothly
  /// from that side; 0: the sign decides. A function that jumps need not cross zero.
  virtual void kinks(double, const double* /*in*/, const double* /*signals*/,
                     double* /*out*/) const {}

  /// Laws without the data that only reports need, for a run that reports no loads; null: the list
  /// itself.
  virtual std::shared_ptr<const Elements> unreported() const { return nullptr; }

  // Functions for laws that read waves:
  virtual WavesFelt waves() const { return {}; }         ///< empty for laws without waves
  virtual double elevation(double) const { return 0.0; } ///< elevation at the origin at time t [m]
  /// Loads of the water motion on one law, with inputs as in `evaluate`, for the linear model.
  virtual std::vector<WaterLoad> by_water(std::size_t, const double*) const { return {}; }
  /// Laws without waves; null: the list itself.
  virtual std::shared_ptr<const Elements> calm() const { return nullptr; }
  /// Laws in fully grown waves, with phase pi `draw()` for each component; null: the list itself.
  virtual std::shared_ptr<const Elements> stirred(const std::function<double()>&) const {
    return nullptr;
  }
};

/// Law linearised at rest.
struct AtRest {
  VectorX load;               ///< (width,)
  MatrixX stiffness, damping; ///< (width, width) -d load / dx, -d load / dv
};

/// Laws of a list linearised at rest at x (n width,), or at zero if x is empty, with z and signals
/// at their start values; laws in water: zero.
std::vector<AtRest> at_rest(const Elements& list, const VectorX& x = {});

} // namespace hydrodae::element
