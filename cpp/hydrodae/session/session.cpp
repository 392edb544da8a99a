#include "hydrodae/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hydrodae/control/law.h"
#include "hydrodae/core/error.h"
#include "hydrodae/core/text.h"
#include "hydrodae/cosim/fmu.h"
#include "hydrodae/cosim/tcp.h"
#include "hydrodae/io/output_place.h"
#include "hydrodae/io/results_rows.h"
#include "hydrodae/run/checkpoint.h"
#include "hydrodae/run/simulation.h"
#include "hydrodae/session/linear_limits.h"
#include "hydrodae/session/output.h"
#include "hydrodae/session/sea_sample.h"
#include "hydrodae/session/second_run.h"

namespace hydrodae {

namespace session {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Run from start to end: a simulation makes steps and writes rows to a file.
class Session {
public:
  Session(const model::Scene& scene, const Progress& progress)
      : progress_(progress), simulation_(scene),
        limits_(linear_limits(scene, simulation_.system())),
        sea_sample_(scene, simulation_.channels()), row_(simulation_.width()) {
    statistics_.unknowns = simulation_.regime().n;
    statistics_.nonzeros = simulation_.nonzeros();
    statistics_.notes = simulation_.notes();
    statistics_.setup_time = seconds_since(started_);
  }

  /// Opens the file of a run from the start.
  void open(const std::string& path) {
    file_ = std::make_unique<io::ResultsFile>(path, simulation_.channels(),
                                              header(scene(), statistics_.notes));
  }

  /// Continues from a checkpoint, with the rows written before it.
  void resume(const std::string& path, const run::Checkpoint& from) {
    simulation_.restore(from.state);
    set(from_bytes<State>(from.output));
    statistics_.end_time = last_sample_;
    const auto count = static_cast<std::size_t>(next_);
    const io::EarlierRows before(path, simulation_.channels(), count, last_sample_);
    open(path);
    before.copy(*file_);
    file_->flush();
    before.drop();
  }

  /// Starts a second run to estimate the error, or continues it from its part of a checkpoint.
  void compare_with(SecondRunPlan plan, const run::Checkpoint* from) {
    comparison_ = std::make_unique<accuracy::Comparison>(simulation_.regime(), plan.afterwards);
    second_ = std::make_unique<SecondRun>(std::move(plan), *comparison_, from);
  }

  /// Sets the reason why the error is not estimated.
  void do_not_estimate(const std::string& why) { statistics_.accuracy.missing = why; }

  RunStatistics operator()(const std::string& path, const RunOptions& options) {
    path_ = path;
    checkpoint_ = options.checkpoint;
    verify_ = options.verify;
    try {
      statistics_.status = march() ? "completed" : "interrupted";
      simulation_.close();
      if (second_ && statistics_.status == "completed")
        second_->finish([this] { return asked_to_go_on(); });
      close(statistics_.status == "completed" ? "" : "stopped on request");
    } catch (const control::Stopped& stopped) {
      statistics_.status = "interrupted";
      simulation_.close();
      close(stopped.what());
    } catch (const std::exception& error) {
      statistics_.status = "failed";
      simulation_.close(error.what());
      close(error.what());
      throw;
    }
    if (statistics_.status == "completed" && !path_.empty())
      run::remove_checkpoint(path_);
    return statistics_;
  }

  /// State after the rows so far.
  struct State {
    long next = 0;            ///< next sample
    double last_sample = 0.0; ///< time of the last sample [s]
    LinearLimits::State limits;
    SeaSample::State sea;
    double solver = 0.0, wall = 0.0; ///< wall time inside the method, and in total [s]
  };
  State state() const {
    return {next_,
            last_sample_,
            limits_.state,
            sea_sample_.state(),
            solver_before_ + simulation_.solver_time(),
            wall_before_ + seconds_since(started_)};
  }
  void set(State state) {
    next_ = state.next;
    last_sample_ = state.last_sample;
    limits_.state = std::move(state.limits);
    sea_sample_.set(std::move(state.sea));
    solver_before_ = state.solver;
    wall_before_ = state.wall;
  }

private:
  const model::Scene& scene() const { return simulation_.scene(); }

  bool asked_to_go_on() const { return !progress_ || progress_(simulation_.time(), end()); }
  double end() const { return scene().solver.end_time; }

  /// Makes steps until the end; returns false if the progress callback requested a stop.
  bool march() {
    const double dt = scene().output.step;
    const auto samples = static_cast<long>(std::floor(end() / dt * (1.0 + 1e-12)));
    long steps_since_asked = 0;
    bool going = true;
    if (comparison_)
      comparison_->moved(simulation_.y(), simulation_.measured().turns().value);
    if (next_ == 0)
      going = sample(0.0);
    // A run that stops with a checkpoint has all rows up to it.
    const auto samples_inside = [&] {
      if (comparison_)
        comparison_->moved(simulation_.y(), simulation_.measured().turns().value);
      const double t = simulation_.time();
      while ((going || checkpoint_ >= 0.0) && next_ <= samples &&
             static_cast<double>(next_) * dt <= t * (1.0 + 1e-14))
        going = sample(std::min(static_cast<double>(next_) * dt, t)) && going;
    };
    while (going && !simulation_.finished()) {
      simulation_.advance(end(), samples_inside);
      if (file_)
        file_->flush_if_due();
      // Requests to stop are also checked between distant samples.
      if (++steps_since_asked >= 1000 && progress_ && going) {
        steps_since_asked = 0;
        going = progress_(simulation_.time(), end());
      }
      write_checkpoint(!going);
    }
    if (going)
      simulation_.finish();
    return going;
  }

  /// Writes the next row of the file. @returns false if a stop is requested
  bool sample(double t) {
    simulation_.sample(t, row_);
    const std::vector<system::BodyState<double>>& bodies = simulation_.recorder().bodies();
    watch(limits_, t, bodies);
    sea_sample_.take(t, simulation_.measured().averaged_from(), row_);
    if (comparison_)
      comparison_->first(t, simulation_.recorder().state(), [this] { return asked_to_go_on(); });
    if (file_)
      file_->append(t, row_);
    statistics_.end_time = last_sample_ = t;
    ++next_;
    return !progress_ || progress_(t, end());
  }

  /// Writes a checkpoint if one is due or the run stops, after its rows are on disk.
  void write_checkpoint(bool stops) {
    if (checkpoint_ < 0.0 || simulation_.finished() ||
        (!stops && seconds_since(last_checkpoint_) < checkpoint_))
      return;
    file_->flush();
    run::Checkpoint checkpoint{simulation_.state(), to_bytes(state()), {}, "", 0, verify_, ""};
    if (second_)
      second_->save(checkpoint);
    run::write_checkpoint(path_, scene(), checkpoint);
    last_checkpoint_ = Clock::now();
  }

  void count() {
    const linalg::Statistics s = simulation_.statistics();
    statistics_.method = in_words(simulation_.methods());
    statistics_.steps = s.steps;
    statistics_.residual_calls = s.residual_calls;
    statistics_.jacobian_calls = s.jacobian_calls;
    statistics_.newton_iterations = s.newton_iterations;
    statistics_.error_test_failures = s.error_test_failures;
    statistics_.convergence_failures = s.convergence_failures;
    statistics_.events = simulation_.events();
    statistics_.solver_time = solver_before_ + simulation_.solver_time();
    statistics_.wall_time = wall_before_ + seconds_since(started_);
    statistics_.at_rest = simulation_.at_rest();
  }

  /// Ends the second run at its present time if the first has not reached its end.
  void take_estimate() {
    if (!second_)
      return;
    second_->give_up();
    statistics_.accuracy = second_->estimate(simulation_.statistics().last_order);
  }

  void close(const std::string& message) {
    count();
    take_estimate();
    for (const std::string& note : simulation_.scale_notes())
      statistics_.notes.push_back(note);
    const std::vector<std::string> limits = notes(limits_);
    statistics_.notes.insert(statistics_.notes.end(), limits.begin(), limits.end());
    const std::vector<std::string> units = simulation_.unit_notes();
    statistics_.notes.insert(statistics_.notes.end(), units.begin(), units.end());
    statistics_.mean_power_from = simulation_.measured().averaged_from();
    for (const measure::Measure::Absorbed& pto : simulation_.measured().absorbed())
      statistics_.mean_power.emplace_back(pto.name, pto.mean_power);
    sea_sample_.write(statistics_);
    for (const run::Controllers::Cost& cost : simulation_.controller_costs())
      statistics_.controllers.push_back(
          {cost.name, cost.calls,
           cost.calls > 1 ? cost.time / static_cast<double>(cost.calls - 1) : 0.0});
    if (!file_)
      return;
    io::Attributes all = attributes(statistics_, scene(), simulation_);
    all["beyond_linear_theory"] = lines_of(limits);
    all["unit_conversions"] = lines_of(units);
    write_methods(simulation_.methods(), all);
    write_impacts(simulation_, *file_);
    write_accuracy(statistics_.accuracy, *file_);
    file_->close(statistics_.status, message, all);
  }

  const Progress& progress_;
  Clock::time_point started_ = Clock::now(), last_checkpoint_ = started_;
  run::Simulation simulation_;
  LinearLimits limits_;
  SeaSample sea_sample_;
  std::string path_, verify_; ///< verify_: requested method of the second run
  std::unique_ptr<io::ResultsFile> file_;
  std::vector<double> row_;
  RunStatistics statistics_;
  std::unique_ptr<accuracy::Comparison> comparison_; ///< null: the error is not estimated
  std::unique_ptr<SecondRun> second_;                ///< null: the error is not estimated
  long next_ = 0;                                    ///< next sample
  double last_sample_ = 0.0;                         ///< time of the last sample [s]
  /// Wall time between checkpoints [s]; negative: no checkpoints
  double checkpoint_ = -1.0;
  double solver_before_ = 0.0, wall_before_ = 0.0; ///< wall times before a resume [s]
};

void check_options(const model::Scene& scene, const std::string& path, const RunOptions& options) {
  const std::vector<std::string> methods = adaptive_methods();
  if (!options.verify.empty() &&
      std::find(methods.begin(), methods.end(), options.verify) == methods.end())
    throw CaseError("--verify " + options.verify + ": expected a method that chooses its steps" +
                    suggestion(options.verify, methods));
  const bool resumable = options.checkpoint >= 0.0 || options.resume;
  if (resumable)
    cosim::require_fmu_states(scene);
  if (resumable && path.empty())
    throw CaseError("a checkpoint stands beside the results file: name one");
  if (options.strict && scene.solver.accuracy == "none")
    throw CaseError(
        "--strict needs an estimate of the error, which solver.accuracy = \"none\" leaves "
        "out; leave out one of them");
  if (options.verify.empty())
    return;
  if (options.resume)
    throw CaseError(
        "a run that goes on from a checkpoint keeps its second run, whose method cannot "
        "change; leave out --verify, or --resume");
  if (scene.solver.accuracy == "none")
    throw CaseError("--verify is an estimate of the error, which solver.accuracy = \"none\" leaves "
                    "out; leave out one of them");
}

} // namespace
} // namespace session

RunStatistics simulate(const model::Scene& given, const std::string& output_path,
                       const Progress& progress, const RunOptions& asked) {
  session::check_options(given, output_path, asked);
  RunOptions options = asked;
  model::Scene scene = given;
  cosim::join_tcp(scene);
  cosim::join_fmus(scene);
  if (options.checkpoint >= 0.0)
    run::require_checkpoint_place(output_path);
  if (!output_path.empty()) {
    std::vector<std::string> inputs{scene.path};
    for (const model::InputFile& file : scene.files)
      inputs.push_back(file.path);
    io::check_output(output_path, inputs);
  }
  std::optional<run::Checkpoint> from;
  if (options.resume) {
    from = run::read_checkpoint(output_path, scene);
    options.verify = from->verify;
  }
  std::optional<session::SecondRunPlan> plan;
  if (scene.solver.accuracy != "none")
    plan = session::plan_second_run(scene, options.verify);
  session::Session session(scene, progress);
  if (plan)
    session.compare_with(std::move(*plan), from ? &*from : nullptr);
  else
    session.do_not_estimate("solver.accuracy = \"none\"");
  if (from)
    session.resume(output_path, *from);
  else if (!output_path.empty())
    session.open(output_path);
  if (!options.resume && !output_path.empty())
    run::remove_checkpoint(output_path); // its rows no longer exist
  return session(output_path, options);
}

} // namespace hydrodae
