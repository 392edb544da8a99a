#pragma once
/// A run that somebody else drives: step by step, saved and restored, read and written by name.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/run/channels.h"
#include "hydrodae/run/controllers.h"
#include "hydrodae/run/events.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/run/inputs.h"
#include "hydrodae/run/method_at_work.h"
#include "hydrodae/run/problem.h"
#include "hydrodae/run/state.h"
#include "hydrodae/run/step_bound.h"

namespace hydrodae::run {

/// One run of a checked scene. Every accepted step is judged by the guards of the scene.
///
/// `state` and `restore` are exact: what follows depends on the State alone, bit for bit, whether
/// the run that gave it goes on, goes back to it, or another one of the same scene takes it over.
/// To that end `state` makes the method start again from it in the run itself, too: one-step
/// methods go on with their step, order and polynomial and factorise their matrices again; ida
/// begins at order 1. So a run whose state was taken differs from one left alone, within the
/// tolerance.
///
/// Controllers of the scene are sampled when the run goes on from a sampling instant: what is read
/// there before is what holds up to it.
class Simulation {
public:
  /// At the start of the run. Throws ModelError or SolverError when the scene cannot start.
  /// @param looser tolerance over that of the run which this one is to judge: steps that something
  ///   else bounds change as those that the tolerance bounds; below 1 whatever it is, above 1 where
  ///   waves do
  explicit Simulation(model::Scene scene, double looser = 1.0);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  double time() const { return now_.t; }      ///< of the last accepted step [s]
  const VectorX& y() const { return now_.y; } ///< all unknowns there
  bool finished() const { return now_.t >= problem_.options.end_time; }

  /// Called with every accepted step while `sample` may ask for times inside it.
  using Inside = std::function<void()>;

  /// Makes one accepted step: as long as the method likes, to an event of a stop or of dry
  /// friction, or to `limit` [s], where it ends exactly. Does nothing at the end of the run, or
  /// where `limit` is not later than the time. Throws SolverError when the step cannot be made, or
  /// a guard does not trust the motion; only `restore` goes on from there.
  void advance(double limit = INFINITY, const Inside& inside = {});

  /// The guards' last look, at the end of the run. Throws SolverError.
  void finish();

  /// Informs controllers that are other programs that the run ends here; with the message of the
  /// error that ended it, if any.
  void close(const std::string& error = "") { controllers_.finish(error); }

  /// All that the run is now; see above.
  State state();

  /// Goes to a state of the same scene, back or ahead. Throws CaseError for that of another.
  void restore(const State& state);

  /// Every column that `sample` fills, in its order.
  const std::vector<Channel>& channels() const { return channels_.all(); }
  std::size_t width() const { return channels_.width(); }

  /// One row of all channels at a time inside the step (see `advance`), or now.
  void sample(double t, std::span<double> row);

  /// The unknowns alone at a time inside the step, or now.
  void look(double t, VectorX& y);

  /// The values of a channel now: one, three or four; one of a component, "velocity.z". Changes
  /// nothing. Throws CaseError, with the nearest name, for an unknown one.
  std::span<const double> read(const std::string& channel);

  /// What may be written, by name; see Input.
  const std::vector<Input>& inputs() const { return inputs_; }

  /// Holds an input at a value from now on: accelerations jump, and the method starts again. Throws
  /// CaseError for an unknown name or a value that it cannot have.
  void write(const std::string& input, double value);

  // What a results file states of a run.
  const model::Scene& scene() const { return problem_.scene; }
  const system::System& system() const { return problem_.system; }
  const system::Regime& regime() const { return problem_.regime; }
  const std::vector<std::string>& notes() const { return problem_.notes; } ///< of the start
  const observe::Recorder& recorder() const { return channels_.recorder(); }
  const measure::Measure& measured() const { return measure_; }
  const ImpactOutput& impacts() const { return channels_.impacts(); }
  const MethodChoice& methods() const { return method_.choice(); }
  const events::Switching* switching() const { return events_.switching(); }
  std::vector<Controllers::Cost> controller_costs() const { return controllers_.costs(); }
  /// Of controllers; complete once they were sampled.
  std::vector<std::string> unit_notes() const { return controllers_.unit_notes(); }
  linalg::Statistics statistics() const { return method_.statistics(); }
  double solver_time() const { return standing_.solver_time; } ///< wall time in the method [s]
  long nonzeros() const { return problem_.pattern.nonzeros(); }
  long events() const { return events_.count(); } ///< without the start
  /// Has nothing moved by more than rounding?
  bool at_rest() const { return scale_.at_rest(); }
  double relative_balance_error() const; ///< the largest so far, of `energy_scale` [-]
  /// Energy exchanged so far, no less than that of errors within the tolerance [J].
  double energy_scale() const;
  std::vector<std::string> scale_notes() const { return scale_.notes(); }

private:
  /// What of a run is no part of its state: it is asked for between two steps.
  struct Standing {
    Instant before;           ///< the start of the last step, where it may be taken back
    bool cut = false;         ///< the last step ends before that of the method
    bool written = false;     ///< inputs that the motion does not know yet
    bool failed = false;      ///< in the middle of a step: only `restore` goes on
    std::vector<double> row;  ///< of the present instant; empty: not asked for yet
    double solver_time = 0.0; ///< [s]
  };

  void require_going() const;
  void ask_controllers();
  void take_control();
  void take_inputs();
  Step take_step(double end);
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
  void restart();
  void set(const State& state);
  std::span<const double> row_now();
  Channels::Counts counts() const;
  integrate::Integrator& integrator() { return method_.integrator(); }

  Problem problem_;
  std::vector<Input> inputs_;
  Instant now_; ///< the end of the last step
  Course course_;
  Standing standing_;
  StepBound bound_;
  system::MotionScale scale_; ///< adapts the tolerances
  RunEvents events_;
  MethodAtWork method_;
  measure::Measure measure_;
  Guards guards_;
  Channels channels_;
  Controllers controllers_;
  std::vector<std::unique_ptr<Follower>> parts_; ///< that belong to rooms below
  std::vector<Follower*> followers_;             ///< all, in the order in which they are called
};

} // namespace hydrodae::run
