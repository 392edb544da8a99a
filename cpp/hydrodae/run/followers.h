#pragma once
/// Adapters that connect parts of lower layers to the steps of a run.

#include "hydrodae/run/controllers.h"
#include "hydrodae/run/state.h"
#include "hydrodae/run/step.h"

namespace hydrodae::run {

class ControlFollower : public FollowerOf<&State::controllers, Controllers> {
public:
  using FollowerOf::FollowerOf;
  void accept(const Step& step) override { part_.accept(step.end, step.y, step.yp); }
};

/// Follower of the measure; the angles of the regime then are on the measured turns.
class MeasureFollower : public FollowerOf<&State::measure, measure::Measure> {
public:
  MeasureFollower(measure::Measure& measure, system::Regime& regime)
      : FollowerOf(measure), regime_(regime) {}
  void accept(const Step&) override {
    part_.accept();
    regime_.nearby = part_.turns().value;
  }
  void restart(const Restart& from) override { part_.restart(from.y, from.yp, from.work); }
  void set(const State& from) override {
    FollowerOf::set(from);
    regime_.nearby = part_.turns().value;
  }

private:
  system::Regime& regime_;
};

class ScaleFollower : public FollowerOf<&State::scales, system::MotionScale> {
public:
  using FollowerOf::FollowerOf;
  void accept(const Step& step) override { part_.accept(step.end, step.y); }
};

class HistoryFollower : public FollowerOf<&State::history, system::History> {
public:
  using FollowerOf::FollowerOf;
  void accept(const Step& step) override {
    part_.append(
        step.end, step.y, step.yp,
        [&step](double t, VectorX& y, VectorX& yp) { step.integrator.follow_motion(t, y, yp); },
        step.integrator.degree());
  }
  void restart(const Restart& from) override { part_.append(from.t, from.y, from.yp); }
};

} // namespace hydrodae::run
