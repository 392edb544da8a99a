#pragma once
/// How far a step may go.

#include "hydrodae/integrate/integrator.h"
#include "hydrodae/run/problem.h"
#include "hydrodae/run/state.h"
#include "hydrodae/system/forcing.h"

namespace hydrodae::run {

/// No step may pass over what is known ahead of time, nor over an event that was found.
class StepBound {
public:
  /// @param looser tolerance over that of the run which this one is to judge; see Simulation
  StepBound(const Problem& problem, double looser);

  /// How far the bodies will about be moved; see Forcing.
  const VectorX& motion() const { return forcing_.motion(); }

  /// Where a step is from, and what knows how far it may go.
  struct From {
    double t = 0.0; ///< [s]
    const system::Turns& turns;
    const integrate::Integrator& integrator;
    double next_control = INFINITY; ///< the next instant of a controller [s]
  };

  /// Time beyond which a step is not to go [s]. Throws SolverError for a fixed step that is too
  /// long.
  double find(const From& from, Course& course);

  /// Is a time in the middle of a step, where the polynomial is of a lower order than the end, so
  /// that each event would leave its error? It is that through the stages of radau, or what fixed
  /// steps have. A load that begins with the event, as of a rope that is caught and parts, has
  /// changed the stages, too.
  static bool is_inside(double start, double t, double end);

private:
  double stretch(const integrate::Integrator& integrator, Course& course) const;

  const Problem& problem_;
  const double looser_;
  system::Forcing forcing_;
};

} // namespace hydrodae::run
