#pragma once
/// What loads the bodies, weight apart: lists of equal laws. A law knows no bodies. Its port says
/// what it sees of their motion and what its loads act on; the system gathers that motion into
/// numbers, and the list answers with loads and with the rates of the states that its laws have.
///
///   port             x, v: what is seen                                   load
///   along_joint      coordinate s of a joint with one motion, s'          f on s [N, N m]
///   along_distance   distance of two points, its rate                     f, pushes apart [N]
///   on_body          displacement from the reference pose, twist          force and moment about
///   the
///                    (6 each, earth axes)                                 centre of gravity
///   between          displacement and rotation vector of marker B seen    force and moment on B
///   about
///                    from marker A, relative velocities (6 each)          its marker
///   points           places of n points of bodies or the ground, their    force on each (3 n) [N]
///                    velocities (3 n each, earth axes)
///
/// The power of a load is load . v in all of them.

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/types.h"
#include "hydrodae/math/dual.h"

namespace hydrodae::element {

enum class Port { along_joint, along_distance, on_body, between, points };

constexpr bool is_along(Port p) { return p == Port::along_joint || p == Port::along_distance; }
/// Does the system keep the gradients of what such a port sees? Others are simple.
constexpr bool has_rows(Port p) { return is_along(p) || p == Port::between; }
constexpr int width(Port p, int n_points = 0) {
  return p == Port::points ? 3 * n_points : is_along(p) ? 1 : 6;
}

/// A state z of a law, z' = what the law answers.
struct Unknown {
  std::string name, unit;
  double scale = 1.0; ///< what one unit of tolerance means, beside the relative one
  double start = 0.0;
};

/// What a law reports beside its load.
struct Quantity {
  std::string_view name, unit, doc;
};

/// A number that a law is given from outside, held until it is written again; without a name: by
/// the system itself.
struct Signal {
  std::string_view name, unit;
  double least = -INFINITY;
};

/// Of "N or N m": the first along a displacement, the second along an angle.
std::string unit_along(std::string_view unit, bool angle);

/// A function of time that a law follows, known ahead: no step passes over what it does.
struct Schedule {
  std::string what;    ///< for messages: "the winch of rope ..."
  double finest = 0.0; ///< time within which it may change [s]
  std::function<double(double)> at;
};

/// What one law sees.
template <class S> struct In {
  double t;              ///< [s]
  const S *x, *v;        ///< (width,)
  const S* z;            ///< (n_states,)
  const double* signals; ///< (n_signals,)
};

/// What it answers.
template <class S> struct Out {
  S* load;  ///< (width,)
  S* z_dot; ///< (n_states,)
};

/// Numbers of one law of a list.
struct Shape {
  Port port = Port::on_body;
  int width = 6, n_states = 0, n_signals = 0;
  int n_in() const { return 2 * width + n_states; } ///< x, v, z
  int n_out() const { return width + n_states; }    ///< load, z'
};

/// A list of laws of one type: one virtual call for all of them. Arrays hold one law after the
/// other.
class Elements {
public:
  virtual ~Elements() = default;

  std::string_view type; ///< as in case files; "hydrostatic" and such for those of the water
  Shape shape;
  bool absorbs = false;           ///< a power take-off: what it takes is a device's output
  std::string_view at_rest_only;  ///< why its slope at rest tells little; empty: it does not
  std::vector<std::string> names; ///< (n,)
  std::vector<Unknown> unknowns;  ///< (n n_states,)
  std::vector<Quantity> channels; ///< of each law
  std::vector<Signal> inputs;     ///< of each law (n_signals,)
  std::vector<double> signals;    ///< what they are at the start (n n_signals,)
  bool timed = false;             ///< do loads depend on the time by themselves?
  std::vector<Schedule> schedules;

  std::size_t size() const { return names.size(); }

  /// @param in       (n n_in,)
  /// @param signals  (n n_signals,)
  /// @param out      (n n_out,)
  virtual void evaluate(double t, const double* in, const double* signals, double* out) const = 0;

  /// The same on dual numbers: the oracle of tests.
  virtual void evaluate(double t, const Dual* in, const double* signals, Dual* out) const = 0;

  /// @param jacobian  (n n_out n_in,) d out / d in of each law, column by column
  virtual void jacobian(double t, const double* in, const double* signals,
                        double* jacobian) const = 0;

  /// Stored energy of each law [J] (n,), that a potential gives back.
  virtual void energy(const double* in, const double* signals, double* joules) const = 0;

  /// Values of `channels` (n n_channels,); `out`: of `evaluate`.
  virtual void observe(double t, const double* in, const double* signals, const double* out,
                       double* values) const = 0;

  /// Does this law have a load that has no slope at rest (so that no linear model has it)?
  virtual bool lost_at_rest(std::size_t law) const = 0;
};

/// A law about rest at x (zero where it is empty), z and signals at their starts.
struct AtRest {
  VectorX load;               ///< (width,)
  MatrixX stiffness, damping; ///< (width, width) -d load / dx, -d load / dv
};
AtRest at_rest(const Elements& list, std::size_t law, const VectorX& x = {});

} // namespace hydrodae::element
