#pragma once
/// How far the motion of a run is to be trusted: the piled-up error of its steps, body by body,
/// against the size of the motion.

#include <memory>
#include <string>

#include "hydrodae/model/solver_options.h"
#include "hydrodae/solve/error_growth.h"
#include "hydrodae/solve/integrator.h"
#include "hydrodae/system/motion_scale.h"

namespace hydrodae::solve {

class Trust {
public:
  Trust(const system::System& system, const system::Pattern& pattern,
        const model::SolverOptions& options);

  /// Adds the last step of the integrator, which ends at t. Throws SolverError when the error is
  /// above `error_guard` of the motion.
  /// @param reached size of the motion so far, by group (system::MotionScale)
  void accept(double t, Integrator& integrator, const VectorX& reached, const VectorX& y);

  /// Rows of the system came or went at t: the error is carried on by the equations from there.
  void restart(const system::Pattern& pattern, double t);

  /// Largest error of a group of bodies over the run, relative to its motion [-], no less than what
  /// the tolerance leaves inside each step; the body that is off most.
  struct Estimate {
    double error = 0.0;
    std::string body;
    double time = 0.0; ///< when it was largest [s]
  };
  Estimate estimate(const VectorX& reached) const;

private:
  double size(Index group, const VectorX& reached) const;
  void measure(const VectorX& y, const VectorX& reached);
  void look(double t, const VectorX& reached);
  const system::BodyData& worst_of(Index group) const;

  const system::System& s_;
  std::unique_ptr<ErrorGrowth> growth_;
  int every_;
  double allowed_, rtol_;
  VectorX unit_;           ///< of each position and velocity (z0,)
  VectorX fastest_;        ///< by group: largest speed so far, in levers per s or rad/s
  VectorX largest_, when_; ///< by group: of the error in levers or rad, time [s]
};

} // namespace hydrodae::solve
