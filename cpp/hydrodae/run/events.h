#pragma once
/// Events of a run: their location inside a step, and the equations after them.

#include <memory>
#include <optional>
#include <vector>

#include "hydrodae/events/law_events.h"
#include "hydrodae/events/switching.h"
#include "hydrodae/run/problem.h"
#include "hydrodae/run/step.h"
#include "hydrodae/statics/consistent_start.h"

namespace hydrodae::run {

class RunEvents : public Follower {
public:
  /// @param start  start of the run; on return y, y' satisfy the rows that hold
  RunEvents(Problem& problem, Instant& start);

  /// Adds the event sources of controllers.
  void add(const std::vector<events::Source*>& sources);

  bool any() const { return !sources_.empty(); }

  /// First event inside a step, if any.
  /// @param end  end of the step; without an event y, y' are set to those at the end
  std::optional<double> locate(double start, Instant& end, integrate::Integrator& integrator);

  /// Handles lines that part at an event; otherwise laws may have left their kink.
  void accept(const Step& step) override;

  /// Finds the rows and loads that hold from `at` on, with consistent y, y'.
  /// @returns the work of all rows through their impulses [J], if an impact occurred
  std::optional<double> settle(Instant& at);

  /// Makes y, y' consistent with the loads at time t; false: no finite rates exist.
  bool restore(double t, VectorX& y, VectorX& yp);

  /// Sets the turns of the angles for objects made from now on.
  void follow(const system::Turns& turns);

  const events::Switching* switching() const { return switching_.get(); }
  /// Number of events after the start
  long count() const { return switching_ ? switching_->events() - 1 : 0; }

  void save(State& out) const override;
  void set(const State& from) override;

private:
  statics::Consistency& consistency();

  Problem& problem_;
  std::unique_ptr<events::Switching> switching_; ///< null without stops and dry friction
  std::optional<events::LawEvents> laws_;
  std::vector<events::Source*> sources_;              ///< sources of all events
  std::unique_ptr<statics::Consistency> consistency_; ///< null: not needed since a restore
};

} // namespace hydrodae::run
