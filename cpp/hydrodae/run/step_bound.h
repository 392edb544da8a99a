#pragma once
/// Largest length of a step.

#include "hydrodae/integrate/integrator.h"
#include "hydrodae/run/problem.h"
#include "hydrodae/run/state.h"
#include "hydrodae/system/forcing.h"

namespace hydrodae::run {

/// Bound on steps from known loads and located events: no step passes over them.
class StepBound {
public:
  /// @param looser  tolerance relative to that of the run which this run checks; see Simulation
  StepBound(const Problem& problem, double looser);

  /// Expected motion of the bodies; see Forcing.
  const VectorX& motion() const { return forcing_.motion(); }

  /// Start of a step, and the objects that limit it.
  struct From {
    double t = 0.0; ///< [s]
    const system::Turns& turns;
    const integrate::Integrator& integrator;
    double next_control = INFINITY; ///< next instant of a controller [s]
  };

  /// Latest end of the step [s]. Throws SolverError for a fixed step that is too long.
  double find(const From& from, Course& course);

  /// Returns whether t is in the middle of a step, where the polynomial is of lower order than at
  /// the ends, so that events would leave its error: for stages of radau and fixed steps. A load
  /// that begins with the event, such as a rope that parts, has also changed the stages.
  static bool is_inside(double start, double t, double end);

private:
  double stretch(const integrate::Integrator& integrator, Course& course) const;

  const Problem& problem_;
  const double looser_;
  system::Forcing forcing_;
};

} // namespace hydrodae::run
