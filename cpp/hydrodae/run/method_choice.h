#pragma once
/// Choice by `solver.method = "auto"`: the first method of a scene, and those that replace it if it
/// fails.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/solver_options.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::run {

/// Properties of a scene that decide on its method.
struct SceneTraits {
  double fastest_rate = 0.0; ///< fastest rate of the equations, linearised at the start [1/s]
  double motion_rate = 0.0;  ///< rate of motion of the bodies at the start [1/s]
  double end_time = 0.0;     ///< [s]
  bool damped = false;       ///< true: forces may dissipate energy in every group of bodies
  std::string costly;        ///< expensive part of the evaluation, for messages; empty: none
};

/// Methods in the order of trial, and the reason for the first one.
struct MethodOrder {
  std::vector<std::string> methods;
  std::string reason;
  bool weighs = false; ///< do explicit_rk and radau change places where the other is cheaper?
};

/// Order of the methods. radau takes every scene that any method takes in the stability map, the
/// attack suite and the charts of tests/, but is not always the cheapest:
///
/// - Where nothing is stiff, explicit_rk has the cheapest digits, up to four times as cheap; after
///   it comes radau, then ida.
/// - Stiff is what is 50 times as fast as the motion: an explicit step, about 6 over the fastest
///   rate, is then shorter than a tenth of a radian of the motion, and one of radau takes less.
///   There explicit_rk also spends energy on what hardly moves. After radau comes ida only.
/// - The start does not show everything: the memory of waves bounds the steps of explicit_rk, and
/// lines that
///   snap taut those of radau. In both cases above the two are weighed as the run goes on.
/// - What a scene calls at every evaluation (Python, the nearest point of a path) counts more than
///   the algebra: radau evaluates half as often as explicit_rk, or less.
/// - Without damping the errors of all steps pile up. At the same tolerance those of radau are 10
///   to 100 times smaller, so that it lasts through runs of more than 2000 radians.
MethodOrder order_methods(const SceneTraits& traits);

/// Traits of a scene at its start, with consistent y, y'.
SceneTraits find_traits(const system::Regime& system, const system::Pattern& pattern,
                        const SolverOptions& options, const VectorX& y, const VectorX& yp);

/// Decision to replace a method by the next one of the order.
struct MethodChange {
  enum class Cause {
    cost,  ///< the other method has less work, or is tried
    stop,  ///< the method can make no step
    guard, ///< a guard has refused a step of the method
  };
  Cause cause = Cause::cost;
  std::string method; ///< the one that is left
  double time = 0.0;  ///< [s]
  std::string reason; ///< what happened
  std::string to;     ///< the one that follows
};

/// Message "radau gave up: the step has become too short"; for a decision on costs, its reason.
std::string in_words(const MethodChange& change);

/// Message "radau at t = 1.5 s: the step has become too short".
std::string with_time(const MethodChange& change);

/// The method at work in a run, those before it and those that are left. A method that could not
/// go on, or whose step a guard refused, is given up: what it could not pass may come again.
///
/// explicit_rk and radau also change places by their costs, operations per simulated second over
/// ten steps. The other one is tried where it may win:
/// - radau, where its own error does not bound the steps of explicit_rk: stability does (their
///   length times the fastest rate of the equations is near the limit), or instants of the scene
///   do, as those of a sampled controller;
/// - explicit_rk, where steps as long as those of radau, and no longer than its stability allows,
///   would take less than 1/1.5 of the operations.
/// A trial is 20 steps. The method of the trial stays if its last ten cost less than the ten steps
/// before the trial; else the run changes back, and the next trial waits until ten times the
/// operations of this one have been made, then twice as many each time.
class MethodChoice {
public:
  /// Single method of this name.
  explicit MethodChoice(std::string method);

  /// Methods of an order, beginning with the first.
  explicit MethodChoice(MethodOrder order);

  const std::string& method() const { return candidates_[state_.at]; }
  const MethodOrder& order() const { return order_; }

  /// Returns whether "auto" chose the method.
  bool chosen() const { return order_.methods.size() > 1; }

  /// Is there another method to go on with where this one stops?
  bool more() const { return follower() < candidates_.size(); }

  /// Goes on with another method, after a decision on costs with the other of the two that are
  /// weighed; else with the first of the order that is left, of which there must be one.
  void next(const MethodChange& change);

  /// Change after an error of the present method. Throws SolverError with the list of tried methods
  /// if none is left.
  MethodChange after(const SolverError& error, MethodChange::Cause cause) const;

  /// Takes an accepted step of the length h [s], after so many operations since the start of the
  /// run.
  /// @param own the method chose its end; else an event, a controller or the end of the run did
  void accept(double h, bool own, double operations);

  /// Are there ten more steps to weigh, and two methods?
  bool weighs() const;

  /// Weighs the last ten steps.
  /// @param t        time now [s]
  /// @param of_step  operations of one step of explicit_rk
  /// @param fastest  rate of the equations [1/s], asked for where it decides
  /// @returns the change to the other method, for a trial or back from it
  std::optional<MethodChange> weigh(double t, double of_step,
                                    const std::function<double()>& fastest);

  /// A method from a time on, and why, in words.
  struct Part {
    std::string method;
    double from = 0.0; ///< [s]
    std::string reason;
  };
  std::vector<Part> parts() const;

  struct State {
    std::size_t at = 0;                ///< in the candidates
    std::vector<std::size_t> given_up; ///< candidates that are
    std::vector<MethodChange> changes; ///< so far
    int bounded = 0;                   ///< steps of the window whose end the method did not choose
    int steps = 0;                     ///< in the window that is weighed next
    double time = 0.0;                 ///< that they took [s]
    double operations = 0.0, window_from = 0.0; ///< at the last step, at the start of the window
    int trial = 0;            ///< windows made of a trial, from 1 on; 0: no trial is on
    double trial_from = 0.0;  ///< operations at its start
    double cost_before = 0.0; ///< of the method before the trial [1/s]
    double patience = 10.0;   ///< operations from a trial to the next over those of the trial
    double next_look = 0.0;   ///< operations at which the next trial may begin
  };
  const State& state() const { return state_; }

  /// Throws Error for the state of another order.
  void set(State state);

private:
  std::size_t follower() const;
  std::size_t rival() const;
  bool is_left(std::size_t k) const;
  void open_window();
  std::optional<std::string> judge_trial(double cost);
  std::optional<std::string> promise(double of_step, const std::function<double()>& fastest);

  MethodOrder order_;
  std::vector<std::string> candidates_; ///< those of the order, then the rival that it lacks
  State state_;
};

/// Message "auto: explicit_rk (nothing is stiff), radau from t = 1.2 s because ..."; for a method
/// set by name, its name.
std::string in_words(const MethodChoice& choice);

} // namespace hydrodae::run
