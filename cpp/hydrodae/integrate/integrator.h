#pragma once
/// Interface of all integrators: steps on F(t, y, y') = 0, and the solution inside the last step.

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
  /// and the worst unknowns or equations.
  /// @param end  latest end [s], after the time reached; a step that would nearly reach it ends
  /// there exactly
  /// @param bound  further latest end [s]; methods of fixed step ignore it
  virtual double step(double end, double bound) = 0;

  /// Continues from consistent y, y' at t [s], for example after a load has jumped. Only the length
  /// of the last step and matrices that still serve are kept. The layout of y must be the same.
  /// Returns false if the method cannot; a new one is then needed.
  virtual bool restart(double, const VectorX&, const VectorX&) { return false; }

  /// Data that the next steps depend on besides t, y and y' at the end of the last step: for
  /// one-step methods the step, its error and the polynomial. `set` it in an integrator of the same
  /// system and options that was made with that t, y and y'.
  virtual Memory state() const = 0;
  virtual void set(const Memory& state) = 0;

  /// Computes y and y' at a time inside the last step. The velocity part of y' is always valid; the
  /// rest if the method knows it.
  virtual void interpolate(double t, VectorX& y, VectorX& yp) = 0;

  /// Interpolation for powers: multipliers, which do no work, may be those at the end of the step.
  virtual void look_inside(double t, VectorX& y, VectorX& yp) { interpolate(t, y, yp); }

  /// Interpolation of positions and velocities only; they miss the constraints by at most the error
  /// of the method.
  virtual void follow_motion(double t, VectorX& y, VectorX& yp) { interpolate(t, y, yp); }

  /// Degree in time of the velocities of `interpolate` inside the last step.
  virtual int degree() const = 0;

  /// Weights of a quadrature over the last step by the method's stages. `stage` gives the state of
  /// stage i > 0 and returns its time [s]; the first stage is the start of the step. Empty: no
  /// stages, or loads do not all follow from positions, velocities and states there.
  virtual std::span<const double> stage_weights() const { return {}; }
  virtual double stage(std::size_t, VectorX&, VectorX&) { return 0.0; }

  virtual linalg::Statistics statistics() const = 0;

  /// Largest part of the next step between two evaluations of the loads, both ends included; 1 for
  /// fixed steps, which must be short beside waves anyway.
  virtual double gap() const { return 1.0; }

  /// Number of nodes for a quadrature over one step that is as exact as the method.
  virtual int quadrature_nodes() const { return 3; }

protected:
  /// Largest gap between nodes in [0, 1], given in any order.
  static double largest_gap(std::vector<double> nodes) {
    nodes.insert(nodes.end(), {0.0, 1.0});
    std::sort(nodes.begin(), nodes.end());
    double out = 0.0;
    for (std::size_t i = 1; i < nodes.size(); ++i)
      out = std::max(out, nodes[i] - nodes[i - 1]);
    return out;
  }
};

/// Integrator of the method `options.method`, at time `t0` [s] with consistent y, y'. The system
/// and the pattern must outlive it. Throws SolverError if the method cannot start.
std::unique_ptr<Integrator> make_integrator(const system::Regime& system,
                                            const system::Pattern& pattern,
                                            const SolverOptions& options, double t0,
                                            const VectorX& y, const VectorX& yp);

} // namespace hydrodae::integrate
