#pragma once
/// All events of a run: where they are inside a step, and what holds from them on.

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
  /// At the start, whose y, y' come out as the rows that hold have them.
  RunEvents(Problem& problem, Instant& start);

  /// Adds those that controllers hear.
  void add(const std::vector<events::Source*>& sources);

  bool any() const { return !sources_.empty(); }

  /// The first event inside a step, if any.
  /// @param end the end of the step; y, y' come out there where no event is found
  std::optional<double> locate(double start, Instant& end, integrate::Integrator& integrator);

  /// What parts does so at an event; else laws may have left their kink.
  void accept(const Step& step) override;

  /// Rows and loads that hold from `at` on, with y, y' that belong to them.
  /// @returns the work of all rows through their impulses [J], where something struck
  std::optional<double> settle(Instant& at);

  /// y, y' by the loads at a time; false: no finite rates exist.
  bool restore(double t, VectorX& y, VectorX& yp);

  /// What is made from now on knows on which turn the angles are.
  void follow(const system::Turns& turns);

  const events::Switching* switching() const { return switching_.get(); }
  long count() const { return switching_ ? switching_->events() - 1 : 0; } ///< without the start

  void save(State& out) const override;
  void set(const State& from) override;

private:
  statics::Consistency& consistency();

  Problem& problem_;
  std::unique_ptr<events::Switching> switching_; ///< where stops or dry friction are
  std::optional<events::LawEvents> laws_;
  std::vector<events::Source*> sources_;              ///< of events: all there are
  std::unique_ptr<statics::Consistency> consistency_; ///< null: none was needed since a restore
};

} // namespace hydrodae::run
