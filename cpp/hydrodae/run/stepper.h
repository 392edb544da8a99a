#pragma once
/// Steps of a scene: its equations, method, events, measure and guards, without controllers and
/// results.

#include <memory>
#include <vector>

#include "hydrodae/run/events.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/run/method_at_work.h"
#include "hydrodae/run/problem.h"
#include "hydrodae/run/state.h"
#include "hydrodae/run/step_bound.h"

namespace hydrodae::run {

class Stepper {
public:
  /// Steps from the start. Throws ModelError or SolverError if the scene cannot start.
  /// @param looser  as of Simulation
  explicit Stepper(model::Scene scene, double looser);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Adds a follower, which comes before all others.
  void lead(Follower& follower) { followers_.insert(followers_.begin(), &follower); }

  /// Makes one step that all followers accept, and adds it to the sums. Under "auto" the next
  /// method repeats a rejected step. Throws SolverError if no method is left.
  /// @param end  latest end of the step [s]
  /// @param next_control  next action of a controller [s], which bounds the step
  Step take(double end, double next_control);

  /// Gives the step to the followers; after an event the motion restarts.
  void accept(const Step& made);

  /// Continues after an event or a change of inputs, with the rows and loads that now hold.
  void restart();

  /// Last check of the guards at the end of the run. Throws SolverError.
  void finish();

  State state();
  /// Throws CaseError if the state is that of another scene.
  void require_same(const State& state);
  /// Sets a state of the same scene.
  void set(const State& state);

  /// Unknowns and rates at a time inside the step; joints are closed to rounding.
  void interpolate(double t, VectorX& y, VectorX& yp);
  /// Unknowns at a time inside the step, as the method has them, or now.
  void look(double t, VectorX& y);

  double relative_balance_error() const; ///< largest error so far, relative to `energy_scale` [-]
  /// Energy exchanged so far, at least that of errors within the tolerance [J].
  double energy_scale() const;

  const Instant& now() const { return now_; } ///< end of the last step
  Course& course() { return course_; }
  Problem& problem() { return problem_; }
  const Problem& problem() const { return problem_; }
  measure::Measure& measured() { return measure_; }
  const measure::Measure& measured() const { return measure_; }
  RunEvents& events() { return events_; }
  const RunEvents& events() const { return events_; }
  const system::MotionScale& scale() const { return scale_; }
  const MethodAtWork& method() const { return method_; }
  double solver_time() const { return solver_time_; } ///< wall time in the method [s]

private:
  Step make_step(double end);
  Step step(bool event, bool own);
  double bound_of_step();
  double next_kink();
  void approach(double event);
  bool begins_to_move();
  void change_method(const MethodChange& change);
  void measure_step();
  bool has_samples() const;
  void choose_quadrature();
  integrate::Integrator& integrator() { return method_.integrator(); }

  Problem problem_;
  Instant now_;    ///< end of the last step
  Instant before_; ///< start of the last step, to undo it
  Course course_;
  bool cut_ = false;               ///< true: the last step ends before that of the method
  double next_control_ = INFINITY; ///< [s]
  double solver_time_ = 0.0;       ///< [s]
  StepBound bound_;
  system::MotionScale scale_; ///< adapts the tolerances
  RunEvents events_;
  MethodAtWork method_;
  measure::Measure measure_;
  Guards guards_;
  std::vector<std::unique_ptr<Follower>> parts_; ///< followers of parts in lower layers
  std::vector<Follower*> followers_;             ///< all followers in calling order
};

} // namespace hydrodae::run
