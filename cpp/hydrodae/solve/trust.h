#pragma once
/// How far the motion of a run is to be trusted, against the size of the motion, group by group of
/// bodies, and line by line. Three witnesses, of which the worst counts:
/// 1. the errors of the steps, carried along by the linearised equations and added (ErrorGrowth);
/// 2. the energy that is missing: a part e of the kinetic energy is e / 2 of the speed, and as
///    frequencies depend on amplitudes, the motion gets out of step the longer it lasts;
/// 3. what the interpolant of fixed steps misses inside a step.

#include <memory>
#include <string>

#include "hydrodae/model/solver_options.h"
#include "hydrodae/solve/error_growth.h"
#include "hydrodae/solve/impact_error.h"
#include "hydrodae/solve/integrator.h"
#include "hydrodae/system/motion_scale.h"
#include "hydrodae/system/recorder.h"

namespace hydrodae::solve {

class Trust {
public:
  /// @param y, yp state at the start
  Trust(const system::Regime& system, const system::Pattern& pattern,
        const model::SolverOptions& options, const VectorX& y, const VectorX& yp);

  /// Adds the last step of the integrator, which ends at t. Throws SolverError when the error may
  /// be above `error_guard` of the motion.
  /// @param reached size of the motion so far, by group (system::MotionScale)
  /// @param event rows of the system come or go at t; `restart` follows
  /// @param recorder its energies at t
  void accept(double t, Integrator& integrator, const VectorX& reached, const VectorX& y,
              bool event, const system::Recorder& recorder);

  /// Throws SolverError when the error may have been above `error_guard` of what moved in the whole
  /// run, which ends at t.
  void finish(double t) const;

  /// From the next `restart` on the steps are those of another method.
  void use(const model::SolverOptions& options);

  /// A stop of a mechanism was struck.
  void strike(int mechanism);

  /// What the impact that has just been makes of the error; `restart` follows.
  void carry_over(const ImpactError& impact) { growth_->carry_over(impact, unit_); }

  /// From t on other rows hold: the error is carried on by them, from the state (y, yp).
  void restart(const system::Pattern& pattern, double t, const VectorX& y, const VectorX& yp);

  /// Largest error of a group over the run, relative to its motion [-], no less than what the
  /// tolerance leaves inside each step; the body or line that is off most.
  struct Estimate {
    double error = 0.0;
    std::string block;
    double time = 0.0; ///< when it was largest [s]
  };
  Estimate estimate() const;

  /// Has nothing moved by more than rounding? Then an error relative to the motion tells nothing.
  bool at_rest() const;

  /// To be restored after `restart` with the same rows.
  void remember(Archive& a);

private:
  double least(int mechanism) const;
  double size(Index group) const;
  double expected(Index group) const;
  double moved(Index group) const;
  double piled_now(Index group) const;
  bool has_steps(Index group, double most) const;
  [[noreturn]] void fail(double t, Index group, double off, const std::string& then) const;
  void measure(const VectorX& y, const VectorX& reached);
  void measure_points(const system::Block& block, const VectorX& y);
  void look(double t, const system::Recorder& recorder);
  double lasting(Index group, double now);
  void take_energy(double t, const system::Recorder& recorder);
  struct Energy;
  bool tells_less(const Energy& energy) const;
  double remembered(Energy& energy, double phase, const system::Recorder::Balance& now);
  void find_guided();
  void take_inner(double t, const VectorX& errors);
  void take(Index group, double t, double error);
  const std::string& worst_of(Index group) const;

  const system::Regime& s_;
  std::unique_ptr<ErrorGrowth> growth_;
  int every_;
  ErrorGrowth::Way way_;
  bool exact_;   ///< steps are fixed, and nothing was located so far
  double doubt_; ///< factor within which the estimate is meant; of fixed steps it is rougher
  double allowed_;
  double least_;           ///< what the tolerance leaves [-]
  VectorX unit_;           ///< of each position and velocity, those of points too (lambda0,)
  VectorX reached_;        ///< by group: largest displacement so far, in levers or rad
  VectorX fastest_;        ///< by group: largest speed so far, in levers per s or rad/s
  VectorX largest_, when_; ///< by group: of the error in levers or rad, time [s]
  MatrixX piled_;          ///< by group: the error piled up, at the last three looks
  VectorX missing_;        ///< by group: what the missing energy has put off, now
  VectorX most_missing_;   ///< the most of it so far
  VectorX damped_;         ///< by group: what dampers leave of an error since the last look
  VectorX rates_;          ///< by group: of the motion [1/s]
  VectorX displaced_;      ///< by group: largest displacement so far [levers]
  VectorX start_;          ///< q, u, z (lambda0,)
  struct Energy {          ///< of a mechanism
    int group = 0;
    bool struck = false;  ///< between impacts the time goes as 1 / speed
    bool guided = false;  ///< altogether, by drives: what is missing tells nothing of its motion
    double seen = 0.0;    ///< error of its balance at the last look [J]
    double missing = 0.0; ///< what has not faded of the changes of it [J]
    double late = 0.0;    ///< phase that this has cost [rad]
    double kinetic = 0.0; ///< its mean over some swings [J]
    double given = 0.0;   ///< that dampers had taken at the last look [J]
    double spent = 0.0;   ///< that they took in the last swings [J]
    void remember(Archive& a) { a(struck, seen, missing, late, kinetic, given, spent); }
  };
  std::vector<Energy> energies_;
  double looked_ = 0.0; ///< time of the last look [s]
};

} // namespace hydrodae::solve
