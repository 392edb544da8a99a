#pragma once
/// Second run of a scene, which estimates the error of the first.

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "hydrodae/accuracy/comparison.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/run/checkpoint.h"

namespace hydrodae::run {
class Simulation;
}

namespace hydrodae::session {

/// Differences of the second run from the first one.
struct SecondRunPlan {
  model::Scene scene;
  double ratio = 1.0;  ///< ratio of tolerances or steps; 1: the second run is more exact
  double looser = 1.0; ///< ratio of tolerances, whichever run is more exact
  std::string how;     ///< description: "a second run at rtol = 1e-05"
  std::string missing; ///< reason why there is no second run; empty: there is one
  /// True: after the first run, because it calls Python or repeats recorded outputs
  bool afterwards = false;
};

/// Plans the second run, and changes `scene` to record the outputs of controllers outside the
/// kernel. The second run has 10 rtol, or twice the fixed step. If that exceeds the largest
/// tolerance, or firm bounds limit the steps, it has a tenth of rtol. Steps limited by waves or
/// such bounds change in the same ratio: otherwise both runs would make the same error.
/// @param method  method of the second run at the tolerance of the first; empty: the same method
SecondRunPlan plan_second_run(model::Scene& scene, const std::string& method);

/// Second run, in its own thread unless the plan says afterwards. The comparison must outlive it.
class SecondRun {
public:
  /// @param from  checkpoint to continue from; null: from the start
  SecondRun(SecondRunPlan plan, accuracy::Comparison& comparison,
            const run::Checkpoint* from = nullptr);
  ~SecondRun();
  SecondRun(const SecondRun&) = delete;
  SecondRun& operator=(const SecondRun&) = delete;

  /// Adds the state of this run to a checkpoint; the run stops between two steps meanwhile.
  void save(run::Checkpoint& checkpoint);

  /// Completes the second run after the end of the first: waits for it, or makes it now.
  /// @param ask  called regularly; false: stop
  void finish(const std::function<bool()>& ask);

  /// Stops the second run soon, because the first has failed or was stopped.
  void give_up();

  /// Error estimate, with its method and end.
  /// @param order  order of the method of the first run
  accuracy::Estimate estimate(int order) const;

private:
  void march(const std::function<bool()>& ask);
  void stop_for_save(run::Simulation& simulation, long next);
  void end();

  SecondRunPlan plan_;
  accuracy::Comparison& comparison_;
  std::atomic<bool> given_up_ = false;
  std::string stopped_; ///< reason why the second run did not reach the end; empty: it did
  std::optional<run::State> from_, saved_;
  long next_ = 0; ///< sample number at `saved_` or `from_`
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> asked_ = false;       ///< true: `saved_` is requested
  bool waits_ = false, has_ended_ = true; ///< has_ended_: no thread is running
  std::thread thread_;
};

} // namespace hydrodae::session
