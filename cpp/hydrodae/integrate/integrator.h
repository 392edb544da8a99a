#pragma once
/// What all integrators have in common: they make steps on F(t, y, y') = 0, and give the solution
/// inside the last step.

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/solver_options.h"
#include "hydrodae/integrate/memory.h"
#include "hydrodae/linalg/statistics.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::integrate {

class Integrator {
public:
  virtual ~Integrator() = default;

  /// Makes one step and returns the time reached [s]. Throws SolverError with the time, the reason,
  /// and the unknowns or equations that are worst.
  /// @param end [s] later than the time reached: no step goes beyond it, and one that nearly gets
  ///   there ends there exactly
  /// @param bound [s] likewise, but methods of a fixed step keep their step
  virtual double step(double end, double bound) = 0;

  /// Goes on from consistent y, y' at t [s], as after a load has jumped: of the last step only its
  /// length stays, and what matrices serve. The layout of y must be the same. False where the
  /// method cannot: another one is to be made.
  virtual bool restart(double, const VectorX&, const VectorX&) { return false; }

  /// What the next steps depend on besides t, y and y' at the end of the last: of one-step methods
  /// the step, its error and the polynomial of the last step. To be set in an integrator of the
  /// same system and options that was made with that t, y and y'.
  virtual Memory state() const = 0;
  virtual void set(const Memory& state) = 0;

  /// y and y' at a time inside the last step. Of y', the velocities' part is always meant to be
  /// read; the rest where the method knows it.
  virtual void interpolate(double t, VectorX& y, VectorX& yp) = 0;

  /// The same where only powers are asked for: multipliers, which do no work, may be those of the
  /// end of the step.
  virtual void look_inside(double t, VectorX& y, VectorX& yp) { interpolate(t, y, yp); }

  /// The same where positions and velocities alone are read: they need not meet the constraints by
  /// more than the error of the method.
  virtual void follow_motion(double t, VectorX& y, VectorX& yp) { interpolate(t, y, yp); }

  /// Degree in time of the velocities that `interpolate` gives inside the last step.
  virtual int degree() const = 0;

  /// Weights with which the method's own stages sum up a quadrature over the last step, and the
  /// state of stage i > 0, whose time it returns [s]; the first stage is the start of the step.
  /// Empty: no stages, or not all loads follow from positions, velocities and states there.
  virtual std::span<const double> stage_weights() const { return {}; }
  virtual double stage(std::size_t, VectorX&, VectorX&) { return 0.0; }

  virtual linalg::Statistics statistics() const = 0;

  /// Largest part of the next step between two times at which it asks for the loads, its ends among
  /// them; 1 of fixed steps, which are to be short beside waves whatever that is.
  virtual double gap() const { return 1.0; }

  /// Nodes that a quadrature over one step needs to be as exact as the method.
  virtual int quadrature_nodes() const { return 3; }

protected:
  /// Of nodes in [0, 1], in any order.
  static double largest_gap(std::vector<double> nodes) {
    nodes.insert(nodes.end(), {0.0, 1.0});
    std::sort(nodes.begin(), nodes.end());
    double out = 0.0;
    for (std::size_t i = 1; i < nodes.size(); ++i)
      out = std::max(out, nodes[i] - nodes[i - 1]);
    return out;
  }
};

/// The integrator that `options.method` names, at time `t0` [s] with consistent y, y'. The system
/// and the pattern must outlive it. Throws SolverError when the method cannot start.
std::unique_ptr<Integrator> make_integrator(const system::Regime& system,
                                            const system::Pattern& pattern,
                                            const SolverOptions& options, double t0,
                                            const VectorX& y, const VectorX& yp);

} // namespace hydrodae::integrate
