#pragma once
/// The method that makes the steps of a run, and how another one takes over.

#include <memory>
#include <optional>

#include "hydrodae/integrate/integrator.h"
#include "hydrodae/integrate/sample_closing.h"
#include "hydrodae/run/method_choice.h"
#include "hydrodae/run/problem.h"
#include "hydrodae/run/step.h"

namespace hydrodae::run {

class MethodAtWork : public Follower {
public:
  /// Chosen by the start where the method is "auto". The options of the problem are those of the
  /// method at work.
  MethodAtWork(Problem& problem, const Instant& start);

  integrate::Integrator& integrator() { return *integrator_; }
  const integrate::Integrator& integrator() const { return *integrator_; }
  const MethodChoice& choice() const { return choice_; }
  integrate::SampleClosing* closing() { return closing_.get(); } ///< null: no rows, or they drift

  /// Do its steps end at events, since its polynomial inside a step is of a lower order, or its
  /// steps are fixed?
  bool approaches_events() const;

  /// Another integrator goes on; the counts of this one stay.
  void renew(const Instant& at);

  /// The method goes on from y, y', which have the layout of the last step.
  void restart_at(const Instant& at);

  /// The next method goes on from an accepted instant.
  void change(const MethodChange& change, const Instant& at);

  /// The change to a method that makes the steps with less work, if there is one.
  std::optional<MethodChange> cheaper(const Instant& at);

  /// The closing knows on which turn the angles are.
  void judge(const Step& step) override;

  /// The step is weighed.
  void accept(const Step& step) override;

  linalg::Statistics statistics() const;

  void save(State& out) const override;
  void set(const State& from) override;

private:
  void use();
  void make(const Instant& at);
  double operations() const;
  double operations_of_explicit_step() const;

  Problem& problem_;
  MethodChoice choice_;
  linalg::Statistics before_; ///< of the integrators before this one
  std::unique_ptr<integrate::Integrator> integrator_;
  std::unique_ptr<integrate::SampleClosing> closing_;
};

} // namespace hydrodae::run
