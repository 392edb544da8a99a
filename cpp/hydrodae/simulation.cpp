#include "hydrodae/simulation.h"

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
#include "hydrodae/run_output.h"
#include "hydrodae/solve/verification.h"
#include "hydrodae/system/linear_limits.h"

namespace hydrodae {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The scene at a tenth of the tolerance, or at half the step.
model::Scene more_exact(model::Scene scene) {
  scene.solver.rtol *= 0.1;
  if (scene.solver.step > 0.0)
    scene.solver.step *= 0.5;
  return scene;
}

/// One run from the start to the end: a simulation makes steps, and rows of a file of them.
class Session {
public:
  /// @param other  run whose samples this one is compared with
  Session(const model::Scene& scene, const Progress& progress, solve::Verification* other = nullptr)
      : progress_(progress), other_(other), simulation_(scene),
        limits_(system::linear_limits(scene, simulation_.system())), row_(simulation_.width()) {
    statistics_.unknowns = simulation_.regime().n;
    statistics_.nonzeros = simulation_.nonzeros();
    statistics_.notes = simulation_.notes();
    statistics_.setup_time = seconds_since(started_);
  }

  /// The file of a run from the start.
  void open(const std::string& path) {
    file_ = std::make_unique<io::ResultsFile>(path, simulation_.channels(),
                                              header(scene(), statistics_.notes));
  }

  /// Goes on from a checkpoint, with the rows that were written before it.
  void resume(const std::string& path, const run::Checkpoint& from) {
    simulation_.restore(from.state);
    restore(from.output, "session", *this);
    statistics_.end_time = last_sample_;
    const auto count = static_cast<std::size_t>(next_);
    const io::EarlierRows before(path, simulation_.channels(), count, last_sample_);
    open(path);
    before.copy(*file_);
    file_->flush();
    before.drop();
  }

  RunStatistics operator()(const std::string& path, const RunOptions& options) {
    path_ = path;
    checkpoint_ = options.checkpoint;
    try {
      if (options.verify)
        own_ = std::make_unique<solve::Verification>(simulation_.regime());
      statistics_.status = march() ? "completed" : "interrupted";
      if (options.verify && statistics_.status == "completed" && !verify())
        statistics_.status = "interrupted";
      simulation_.close();
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

  /// What the rows so far have left behind.
  void remember(Archive& a) {
    a(next_, last_sample_, limits_);
    double solver = simulation_.solver_time() + solver_before_,
           wall = seconds_since(started_) + wall_before_;
    a(solver, wall);
    if (!a.saves()) {
      solver_before_ = solver;
      wall_before_ = wall;
    }
  }

private:
  const model::Scene& scene() const { return simulation_.scene(); }

  /// The second run; false when it was asked to stop. Throws SolverError when it does not confirm
  /// the first.
  bool verify() {
    const model::Scene second_scene = more_exact(scene());
    const std::string how = second_scene.solver.step > 0.0
                                ? "step = " + number_text(second_scene.solver.step) + " s"
                                : "rtol = " + number_text(second_scene.solver.rtol);
    try {
      Session second(second_scene, progress_, own_.get());
      if (!second.march())
        return false;
    } catch (const SolverError& error) {
      throw SolverError(error.time, "not verified: the second run, with " + how + ", " +
                                        std::string(error.what()));
    }
    const solve::Verification::Difference d = own_->largest();
    statistics_.verified_error = d.error;
    statistics_.verified_error_of = d.block;
    statistics_.verified_error_time = d.time;
    if (const double allowed = scene().solver.error_guard; allowed > 0.0 && d.error > allowed)
      throw SolverError(d.time, "not verified: a second run, with " + how + ", has " +
                                    in_quotes(d.block) + " off by " + rounded_text(d.error) +
                                    " of the motion at t = " + number_text(d.time) +
                                    " s, more than " + number_text(allowed) +
                                    " (solver.error_guard); a smaller tolerance or step may do");
    return true;
  }

  /// Steps until the end; false when the progress callback asked to stop.
  bool march() {
    const double end = scene().solver.end_time, dt = scene().output.step;
    const auto samples = static_cast<long>(std::floor(end / dt * (1.0 + 1e-12)));
    long steps_since_asked = 0;
    bool going = true;
    if (next_ == 0)
      going = sample(0.0);
    // A run that stops with a checkpoint has all rows up to it.
    const auto samples_inside = [&] {
      const double t = simulation_.time();
      while ((going || checkpoint_ >= 0.0) && next_ <= samples &&
             static_cast<double>(next_) * dt <= t * (1.0 + 1e-14))
        going = sample(std::min(static_cast<double>(next_) * dt, t)) && going;
    };
    while (going && !simulation_.finished()) {
      simulation_.advance(end, samples_inside);
      if (file_)
        file_->flush_if_due();
      // Between samples that are far apart in steps, a request to stop is heard as well.
      if (++steps_since_asked >= 1000 && progress_ && going) {
        steps_since_asked = 0;
        going = progress_(simulation_.time(), end);
      }
      write_checkpoint(!going);
    }
    if (going)
      simulation_.finish();
    return going;
  }

  /// The next row of the file. @returns false when the run is asked to stop
  bool sample(double t) {
    simulation_.sample(t, row_);
    const std::vector<system::BodyState<double>>& bodies = simulation_.recorder().bodies();
    system::watch(limits_, t, bodies);
    if (own_)
      own_->keep(t, bodies, simulation_.recorder().state());
    if (other_)
      other_->compare(bodies, simulation_.recorder().state());
    if (file_)
      file_->append(t, row_);
    statistics_.end_time = last_sample_ = t;
    ++next_;
    return !progress_ || progress_(t, scene().solver.end_time);
  }

  /// Where one is due, or the run stops: after the rows that it follows are on disk.
  void write_checkpoint(bool stops) {
    if (checkpoint_ < 0.0 || simulation_.finished() ||
        (!stops && seconds_since(last_checkpoint_) < checkpoint_))
      return;
    file_->flush();
    run::Checkpoint checkpoint{simulation_.state(), {}};
    save(checkpoint.output, "session", *this);
    run::write_checkpoint(path_, scene(), checkpoint);
    last_checkpoint_ = Clock::now();
  }

  void count() {
    const solve::Statistics s = simulation_.statistics();
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
    const solve::Trust::Estimate estimate = simulation_.estimate();
    statistics_.estimated_error = estimate.error;
    statistics_.estimated_error_of = estimate.block;
    statistics_.estimated_error_time = estimate.time;
    statistics_.at_rest = simulation_.at_rest();
  }

  void close(const std::string& message) {
    count();
    for (const std::string& note : simulation_.scale_notes())
      statistics_.notes.push_back(note);
    const std::vector<std::string> limits = system::notes(limits_);
    statistics_.notes.insert(statistics_.notes.end(), limits.begin(), limits.end());
    const std::vector<std::string> units = simulation_.unit_notes();
    statistics_.notes.insert(statistics_.notes.end(), units.begin(), units.end());
    statistics_.mean_power_from = simulation_.recorder().averaged_from();
    for (const system::Recorder::Absorbed& pto : simulation_.recorder().absorbed())
      statistics_.mean_power.emplace_back(pto.name, pto.mean_power);
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
    file_->close(statistics_.status, message, all);
  }

  const Progress& progress_;
  solve::Verification* other_;               ///< run to compare with
  std::unique_ptr<solve::Verification> own_; ///< where this run is to be verified
  Clock::time_point started_ = Clock::now(), last_checkpoint_ = started_;
  run::Simulation simulation_;
  system::LinearLimits limits_;
  std::string path_;
  std::unique_ptr<io::ResultsFile> file_;
  std::vector<double> row_;
  RunStatistics statistics_;
  long next_ = 0;                                  ///< sample
  double last_sample_ = 0.0;                       ///< time of the one before [s]
  double checkpoint_ = -1.0;                       ///< wall time between checkpoints [s]; < 0: none
  double solver_before_ = 0.0, wall_before_ = 0.0; ///< of what was resumed [s]
};

void check_options(const model::Scene& scene, const std::string& path, const RunOptions& options) {
  for (const model::Controller& c : scene.controllers)
    if (options.verify && c.type == "tcp")
      throw CaseError("a run with controller " + in_quotes(c.name) +
                      " cannot be verified: the other program would have to begin anew");
  const bool resumable = options.checkpoint >= 0.0 || options.resume;
  if (resumable)
    cosim::require_fmu_states(scene);
  if (resumable && path.empty())
    throw CaseError("a checkpoint stands beside the results file: name one");
  if (resumable && options.verify)
    throw CaseError("a run that is verified can have no checkpoint: its second run would have to "
                    "begin anew; leave out --verify, or --checkpoint and --resume");
}

} // namespace

RunStatistics simulate(const model::Scene& given, const std::string& output_path,
                       const Progress& progress, const RunOptions& options) {
  check_options(given, output_path, options);
  model::Scene scene = given;
  cosim::join_tcp(scene);
  cosim::join_fmus(scene);
  if (options.checkpoint >= 0.0)
    run::require_checkpoint_place(output_path);
  if (!output_path.empty())
    io::check_output(output_path, {scene.path, scene.database ? scene.database->path : ""});
  std::optional<run::Checkpoint> from;
  if (options.resume)
    from = run::read_checkpoint(output_path, scene);
  Session session(scene, progress);
  if (from)
    session.resume(output_path, *from);
  else if (!output_path.empty())
    session.open(output_path);
  if (!options.resume && !output_path.empty())
    run::remove_checkpoint(output_path); // the rows that it followed are gone
  return session(output_path, options);
}

} // namespace hydrodae
