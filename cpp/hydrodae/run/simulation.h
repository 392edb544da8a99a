#pragma once
/// Run controlled by its caller: step by step, saved and restored, read and written by name.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/run/channels.h"
#include "hydrodae/run/controllers.h"
#include "hydrodae/run/followers.h"
#include "hydrodae/run/inputs.h"
#include "hydrodae/run/stepper.h"

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

  double time() const { return steps_.now().t; }      ///< time of the last accepted step [s]
  const VectorX& y() const { return steps_.now().y; } ///< all unknowns at that time
  bool finished() const { return time() >= steps_.problem().options.end_time; }

  /// Function called after every accepted step, when `sample` may read times inside it.
  using Inside = std::function<void()>;

  /// Makes one accepted step of the method's length, or to an event of a stop or of dry friction,
  /// or to `limit` [s] exactly. Does nothing at the end of the run, or if `limit` is not after the
  /// present time. Throws SolverError if the step fails or a guard rejects the motion; afterwards
  /// only `restore` can continue.
  void advance(double limit = INFINITY, const Inside& inside = {});

  /// Last check of the guards at the end of the run. Throws SolverError.
  void finish() { steps_.finish(); }

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
  void look(double t, VectorX& y) { steps_.look(t, y); }

  /// Values of a channel now: one, three or four; one for a component, "velocity.z". Changes
  /// nothing. Throws CaseError with the nearest name for an unknown channel.
  std::span<const double> read(const std::string& channel);

  /// Inputs that may be written; see Input.
  const std::vector<Input>& inputs() const { return inputs_; }

  /// Holds an input at a value from now on: accelerations jump, and the method restarts. Throws
  /// CaseError for an unknown name or an invalid value.
  void write(const std::string& input, double value);

  // Properties of a run for its results file.
  const model::Scene& scene() const { return steps_.problem().scene; }
  const system::System& system() const { return steps_.problem().system; }
  const system::Regime& regime() const { return steps_.problem().regime; }
  /// Notes on the start
  const std::vector<std::string>& notes() const { return steps_.problem().notes; }
  const observe::Recorder& recorder() const { return channels_.recorder(); }
  const measure::Measure& measured() const { return steps_.measured(); }
  const ImpactOutput& impacts() const { return channels_.impacts(); }
  const MethodChoice& methods() const { return steps_.method().choice(); }
  const events::Switching* switching() const { return steps_.events().switching(); }
  std::vector<Controllers::Cost> controller_costs() const { return controllers_.costs(); }
  /// Notes of controllers on units; complete once they were sampled.
  std::vector<std::string> unit_notes() const { return controllers_.unit_notes(); }
  linalg::Statistics statistics() const { return steps_.method().statistics(); }
  double solver_time() const { return steps_.solver_time(); } ///< wall time in the method [s]
  long nonzeros() const { return steps_.problem().pattern.nonzeros(); }
  long events() const { return steps_.events().count(); } ///< number of events after the start
  /// Returns whether nothing has moved by more than rounding.
  bool at_rest() const { return steps_.scale().at_rest(); }
  /// Largest error so far, relative to `energy_scale` [-]
  double relative_balance_error() const { return steps_.relative_balance_error(); }
  /// Energy exchanged so far, at least that of errors within the tolerance [J].
  double energy_scale() const { return steps_.energy_scale(); }
  std::vector<std::string> scale_notes() const { return steps_.scale().notes(); }

private:
  void require_going() const;
  void ask_controllers();
  void take_control();
  void take_inputs();
  void set(const State& state);
  std::span<const double> row_now();
  Channels::Counts counts() const;

  Stepper steps_;
  std::vector<Input> inputs_;
  Channels channels_;
  Controllers controllers_;
  ControlFollower control_;
  bool written_ = false;    ///< true: inputs have changed and the accelerations have not
  bool failed_ = false;     ///< true: inside a step; only `restore` can continue
  std::vector<double> row_; ///< row of the present instant; empty: not computed yet
};

} // namespace hydrodae::run
