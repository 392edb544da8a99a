#pragma once
/// Run controlled by its caller: step by step, saved and restored, read and written by name.

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

/// Run of a checked scene. The guards of the scene judge every accepted step.
///
/// `state` and `restore` are exact: the continuation depends on the State alone, bit for bit, in
/// the same run or in another one of the same scene. `state` therefore restarts the method in the
/// run itself, too. One-step methods keep their step, order and polynomial and factorise again; ida
/// restarts at order 1. A run whose state was taken thus differs from one left alone, within the
/// tolerance.
///
/// Controllers are sampled when the run continues from a sampling instant: values read before that
/// are those that held up to it.
class Simulation {
public:
  /// Run at its start. Throws ModelError or SolverError if the scene cannot start.
  /// @param looser  tolerance relative to that of the run which this run checks. Steps bounded by
  /// other limits change as those bounded by the tolerance: all of them for values below 1, those
  /// bounded by waves for values above 1.
  explicit Simulation(model::Scene scene, double looser = 1.0);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  double time() const { return now_.t; }      ///< time of the last accepted step [s]
  const VectorX& y() const { return now_.y; } ///< all unknowns at that time
  bool finished() const { return now_.t >= problem_.options.end_time; }

  /// Function called after every accepted step, when `sample` may read times inside it.
  using Inside = std::function<void()>;

  /// Makes one accepted step of the method's length, or to an event of a stop or of dry friction,
  /// or to `limit` [s] exactly. Does nothing at the end of the run, or if `limit` is not after the
  /// present time. Throws SolverError if the step fails or a guard rejects the motion; afterwards
  /// only `restore` can continue.
  void advance(double limit = INFINITY, const Inside& inside = {});

  /// Last check of the guards at the end of the run. Throws SolverError.
  void finish();

  /// Informs controllers in other programs that the run ends, with the message of its error, if
  /// any.
  void close(const std::string& error = "") { controllers_.finish(error); }

  /// Complete state of the run; see above.
  State state();

  /// Sets a state of the same scene, earlier or later. Throws CaseError for another scene.
  void restore(const State& state);

  /// Channels that `sample` fills, in their order.
  const std::vector<Channel>& channels() const { return channels_.all(); }
  std::size_t width() const { return channels_.width(); }

  /// Writes one row of all channels, at a time inside the step (see `advance`), or now.
  void sample(double t, std::span<double> row);

  /// Writes the unknowns at a time inside the step, or now.
  void look(double t, VectorX& y);

  /// Values of a channel now: one, three or four; one for a component, "velocity.z". Changes
  /// nothing. Throws CaseError with the nearest name for an unknown channel.
  std::span<const double> read(const std::string& channel);

  /// Inputs that may be written; see Input.
  const std::vector<Input>& inputs() const { return inputs_; }

  /// Holds an input at a value from now on: accelerations jump, and the method restarts. Throws
  /// CaseError for an unknown name or an invalid value.
  void write(const std::string& input, double value);

  // Properties of a run for its results file.
  const model::Scene& scene() const { return problem_.scene; }
  const system::System& system() const { return problem_.system; }
  const system::Regime& regime() const { return problem_.regime; }
  const std::vector<std::string>& notes() const { return problem_.notes; } ///< notes on the start
  const observe::Recorder& recorder() const { return channels_.recorder(); }
  const measure::Measure& measured() const { return measure_; }
  const ImpactOutput& impacts() const { return channels_.impacts(); }
  const MethodChoice& methods() const { return method_.choice(); }
  const events::Switching* switching() const { return events_.switching(); }
  std::vector<Controllers::Cost> controller_costs() const { return controllers_.costs(); }
  /// Notes of controllers on units; complete once they were sampled.
  std::vector<std::string> unit_notes() const { return controllers_.unit_notes(); }
  linalg::Statistics statistics() const { return method_.statistics(); }
  double solver_time() const { return standing_.solver_time; } ///< wall time in the method [s]
  long nonzeros() const { return problem_.pattern.nonzeros(); }
  long events() const { return events_.count(); } ///< number of events after the start
  /// Returns whether nothing has moved by more than rounding.
  bool at_rest() const { return scale_.at_rest(); }
  double relative_balance_error() const; ///< largest error so far, relative to `energy_scale` [-]
  /// Energy exchanged so far, at least that of errors within the tolerance [J].
  double energy_scale() const;
  std::vector<std::string> scale_notes() const { return scale_.notes(); }

private:
  /// Data of a run outside its state: the state is taken between two steps.
  struct Standing {
    Instant before;           ///< start of the last step, to undo it
    bool cut = false;         ///< true: the last step ends before that of the method
    bool written = false;     ///< true: inputs have changed and the accelerations have not
    bool failed = false;      ///< true: inside a step; only `restore` can continue
    std::vector<double> row;  ///< row of the present instant; empty: not computed yet
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
  Instant now_; ///< end of the last step
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
  std::vector<std::unique_ptr<Follower>> parts_; ///< followers of parts in lower layers
  std::vector<Follower*> followers_;             ///< all followers in calling order
};

} // namespace hydrodae::run
