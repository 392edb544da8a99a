#pragma once
/// A run that somebody else drives: step by step, saved and restored, read and written by name.

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/channel.h"
#include "hydrodae/events/law_events.h"
#include "hydrodae/events/switching.h"
#include "hydrodae/integrate/sample_closing.h"
#include "hydrodae/measure/measure.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/observe/recorder.h"
#include "hydrodae/run/controllers.h"
#include "hydrodae/run/guards.h"
#include "hydrodae/run/impacts.h"
#include "hydrodae/run/inputs.h"
#include "hydrodae/run/method_choice.h"
#include "hydrodae/run/state.h"
#include "hydrodae/statics/consistent_start.h"
#include "hydrodae/system/forcing.h"
#include "hydrodae/system/history.h"
#include "hydrodae/system/motion_scale.h"

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

  double time() const { return t_; }      ///< of the last accepted step [s]
  const VectorX& y() const { return y_; } ///< all unknowns there
  bool finished() const { return t_ >= options_.end_time; }

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
  void close(const std::string& error = "");

  /// All that the run is now; see above.
  State state();

  /// Goes to a state of the same scene, back or ahead. Throws CaseError for that of another.
  void restore(const State& state);

  /// Which scene this is: digest of text, overrides and version, then `model::text_of_files`.
  const std::string& fingerprint();

  /// Every column that `sample` fills, in its order.
  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }

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
  const model::Scene& scene() const { return scene_; }
  const system::System& system() const { return system_; }
  const system::Regime& regime() const { return regime_; }
  const std::vector<std::string>& notes() const { return notes_; } ///< of the start
  const observe::Recorder& recorder() const { return *recorder_; }
  const measure::Measure& measured() const { return *measure_; }
  const ImpactOutput& impacts() const { return impacts_; }
  const MethodChoice& methods() const { return methods_; }
  const events::Switching* switching() const { return switching_.get(); }
  std::vector<Controllers::Cost> controller_costs() const;
  std::vector<std::string> unit_notes() const; ///< of controllers; complete once they were sampled
  linalg::Statistics statistics() const;
  double solver_time() const { return solver_time_; } ///< wall time inside the method [s]
  long nonzeros() const { return pattern_.nonzeros(); }
  long events() const { return switching_ ? switching_->events() - 1 : 0; } ///< without the start
  /// Has nothing moved by more than rounding?
  bool at_rest() const { return scale_->at_rest(); }
  double relative_balance_error() const; ///< the largest so far, of `energy_scale` [-]
  /// Energy exchanged so far, no less than that of errors within the tolerance [J].
  double energy_scale() const;
  std::vector<std::string> scale_notes() const { return scale_->notes(); }

private:
  friend class hydrodae::Archive;
  /// Of a scene: its system, and a consistent start.
  struct Start {
    system::System system;
    system::Pattern pattern;
    VectorX y, yp;
  };
  static Start begin(const model::Scene& scene);
  Simulation(Start start, model::Scene&& scene, double looser);
  void formulate();
  void begin_history();
  void make_channels();
  bool make_step(double end);
  std::optional<double> locate();
  double find_bound();
  double stretch_of_steps();
  bool inside_of_step(double t) const;
  void approach(double event);
  bool begins_to_move();
  void choose_quadrature();
  void choose_method();
  void use_method();
  void make_integrator();
  void renew_integrator();
  void restart_integrator();
  void find_sources();
  void make_closing();
  void change_method(const MethodChange& change);
  bool take_step(double end);
  bool has_samples() const;
  void measure_step();
  Step last_step(bool event);
  void take_back();
  void watch_steps(bool event, double end);
  double operations() const;
  double operations_of_explicit_step() const;
  void weigh_methods();
  void restart();
  statics::Consistency& consistency();
  void follow_turns();
  void take_inputs();
  void take_control();
  std::span<const double> row_now();
  void require_going() const;
  void fill_counts(std::span<double> row) const;
  void remember(Archive& a);
  void set(const State& state);
  void require_same(const std::string& scene); ///< throws CaseError naming what differs

  model::Scene scene_;
  const double looser_;
  SolverOptions options_; ///< of the method at work; steps as a history carries them
  MethodChoice methods_{options_.method};
  bool approaches_events_ = false; ///< with steps that end there
  std::string fingerprint_;        ///< empty: not asked for yet
  const system::System system_;
  system::Regime regime_{system_}; ///< what holds now
  system::Pattern pattern_;
  VectorX y_, yp_; ///< at the end of the last step
  std::vector<std::string> notes_;
  ImpactOutput impacts_{system_};
  std::vector<Input> inputs_;
  std::unique_ptr<Controllers> controllers_; ///< null: none
  bool cut_ = false;                         ///< the last step ends before that of the method
  bool event_here_ = false;                  ///< the last step has ended in an event
  bool written_ = false;                     ///< inputs that the motion does not know yet
  bool failed_ = false;                      ///< in the middle of a step: only `restore` goes on
  std::unique_ptr<events::Switching> switching_; ///< where stops or dry friction are
  std::unique_ptr<events::LawEvents> law_events_;
  std::vector<events::Source*> sources_;              ///< of events: all there are
  std::unique_ptr<statics::Consistency> consistency_; ///< null: none was needed since a restore
  std::unique_ptr<system::History> history_;          ///< where loads depend on the past
  std::unique_ptr<system::Forcing> forcing_;          ///< limits the steps
  std::unique_ptr<system::MotionScale> scale_;        ///< adapts the tolerances
  std::unique_ptr<integrate::Integrator> integrator_;
  std::unique_ptr<integrate::SampleClosing> closing_; ///< null: no rows, or rows that drift
  std::unique_ptr<measure::Measure> measure_;
  std::unique_ptr<observe::Recorder> recorder_;
  std::unique_ptr<Guards> guards_;
  std::vector<Channel> channels_;
  std::size_t width_ = 0;
  std::vector<double> now_;         ///< row of the present instant; empty: not asked for yet
  linalg::Statistics before_start_; ///< of the integrators before the last start
  double solver_time_ = 0.0;        ///< wall time inside the method [s]
  double t_ = 0.0, step_start_ = 0.0, last_start_ = 0.0;
  double event_near_ = INFINITY; ///< where the next steps end [s]
  double bound_ = INFINITY;      ///< beyond which the last step was not to go [s]
  VectorX y_start_, yp_start_;   ///< at the start of the step
  int quadrature_nodes_ = 3;
  int highest_order_ = 1;      ///< of the steps so far
  double control_since_ = 0.0; ///< when controllers acted last [s]
  events::Interpolant at_ = [this](double t, VectorX& y, VectorX& yp) {
    integrator_->interpolate(t, y, yp);
  };
  system::History::Inside motion_ = [this](double t, VectorX& y, VectorX& yp) {
    integrator_->follow_motion(t, y, yp);
  };
  measure::Measure::StageState stage_ = [this](std::size_t i, VectorX& y, VectorX& yp) {
    return integrator_->stage(i, y, yp);
  };
  events::Interpolant inside_ = [this](double t, VectorX& y, VectorX& yp) {
    integrator_->look_inside(t, y, yp);
  };
};

} // namespace hydrodae::run
