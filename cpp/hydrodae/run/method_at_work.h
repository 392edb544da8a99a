#pragma once
/// Integration method of a run, and its replacement by another one.

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
  /// Method for the start; "auto" chooses it. The options of the problem become those of the
  /// method.
  MethodAtWork(Problem& problem, const Instant& start);

  integrate::Integrator& integrator() { return *integrator_; }
  const integrate::Integrator& integrator() const { return *integrator_; }
  const MethodChoice& choice() const { return choice_; }
  /// Null: no rows, or drifting rows
  integrate::SampleClosing* closing() { return closing_.get(); }

  /// Returns whether steps end at events, because the polynomial inside a step is of lower order or
  /// the steps are fixed.
  bool approaches_events() const;

  /// Makes a new integrator; the counts of the old one are kept.
  void renew(const Instant& at);

  /// Continues from y, y' in the layout of the last step.
  void restart_at(const Instant& at);

  /// Continues with the next method from an accepted instant.
  void change(const MethodChange& change, const Instant& at);

  /// Change to a cheaper method, if there is one.
  std::optional<MethodChange> cheaper(const Instant& at);

  /// Sets the turns of the angles for the closing of samples.
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
  linalg::Statistics before_; ///< statistics of the integrators before this one
  std::unique_ptr<integrate::Integrator> integrator_;
  std::unique_ptr<integrate::SampleClosing> closing_;
};

} // namespace hydrodae::run
