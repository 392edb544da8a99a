#pragma once
/// The second run of a scene, by which the error of the first is estimated.

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

/// How the second run differs from the first one.
struct SecondRunPlan {
  model::Scene scene;
  double ratio = 1.0;      ///< of the tolerances or steps; 1: the second run is the more exact one
  double looser = 1.0;     ///< of the tolerances, whichever run is the more exact one
  std::string how;         ///< "a second run at rtol = 1e-05"
  std::string missing;     ///< why there can be none; empty: there can be
  bool afterwards = false; ///< not beside the first: it calls Python, or repeats recorded answers
};

/// Changes `scene` so that the answers of controllers outside the kernel are recorded, and returns
/// the plan of the second run. It has 10 rtol, or twice the fixed step; where that is beyond the
/// largest tolerance, or where something bounds the steps that no longer one may pass, a tenth of
/// rtol. Steps that waves or such bounds end change as those that the tolerance bounds: else both
/// runs would make the same error.
/// @param method of the second run at the tolerance of the first; empty: the method of the first
SecondRunPlan plan_second_run(model::Scene& scene, const std::string& method);

/// Runs it, in a thread of its own unless the plan says afterwards. The comparison must outlive it.
class SecondRun {
public:
  /// @param from that it goes on from; null: from the start
  SecondRun(SecondRunPlan plan, accuracy::Comparison& comparison,
            const run::Checkpoint* from = nullptr);
  ~SecondRun();
  SecondRun(const SecondRun&) = delete;
  SecondRun& operator=(const SecondRun&) = delete;

  /// Adds to a checkpoint what this run goes on from: it is stopped between two steps meanwhile.
  void save(run::Checkpoint& checkpoint);

  /// The first run has reached its end: waits for the second, or makes it now.
  /// @param ask called now and then; false: stop
  void finish(const std::function<bool()>& ask);

  /// The first run has failed or was stopped: the second stops soon.
  void give_up();

  /// The estimate, with how it was made, and where it ends.
  /// @param order of the method of the first run
  accuracy::Estimate estimate(int order) const;

private:
  void march(const std::function<bool()>& ask);
  void stop_for_save(run::Simulation& simulation, long next);
  void end();

  SecondRunPlan plan_;
  accuracy::Comparison& comparison_;
  std::atomic<bool> given_up_ = false;
  std::string stopped_; ///< why the second run did not reach the end; empty: it did
  std::optional<run::State> from_, saved_;
  long next_ = 0; ///< sample, where `saved_` is or `from_` was
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> asked_ = false;       ///< for `saved_`
  bool waits_ = false, has_ended_ = true; ///< has_ended_: no thread is at work
  std::thread thread_;
};

} // namespace hydrodae::session
