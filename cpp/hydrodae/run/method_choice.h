#pragma once
/// `solver.method = "auto"`: with which method a scene begins, and which follow where that one
/// cannot go on.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hydrodae/core/error.h"
#include "hydrodae/core/solver_options.h"
#include "hydrodae/system/jacobian.h"

namespace hydrodae::run {

/// What decides about the method of a scene.
struct SceneTraits {
  double fastest_rate = 0.0; ///< of the equations linearised at the start [1/s]
  double motion_rate = 0.0;  ///< at which the bodies move there [1/s]
  double end_time = 0.0;     ///< [s]
  bool damped = false;       ///< energy may be taken out of the motion of every group of bodies
  std::string costly;        ///< what is expensive to evaluate, in words; empty: nothing
};

/// Methods in the order in which they are tried, and why the first is the first.
struct MethodOrder {
  std::vector<std::string> methods;
  std::string reason;
  bool may_weigh = false; ///< may explicit_rk follow the first where it is cheaper?
};

/// The choice, by what the stability map, the attack suite and the charts of tests/ show. radau
/// takes every scene there that any method takes; it is not always the cheapest:
///
/// - Where nothing is stiff, explicit_rk has the cheapest digits, up to four times as cheap; after
///   it comes radau, then ida.
/// - Stiff is what is 50 times as fast as the motion: an explicit step, about 6 over the fastest
///   rate, is then shorter than a tenth of a radian of the motion, and one of radau takes less.
///   There explicit_rk also spends energy on what hardly moves. After radau comes ida only. Where
///   the fast rates come to life, as in a line that snaps taut, radau follows them with short steps
///   and many iterations: explicit_rk takes over once it is the cheaper one.
/// - What a scene calls at every evaluation (Python, the nearest point of a path) counts more than
///   the algebra: radau evaluates half as often as explicit_rk, or less.
/// - Without damping the errors of all steps pile up. At the same tolerance those of radau are 10
///   to 100 times smaller, so that it lasts through runs of more than 2000 radians.
MethodOrder order_methods(const SceneTraits& traits);

/// Of a scene at its start, where y, y' are consistent.
SceneTraits find_traits(const system::Regime& system, const system::Pattern& pattern,
                        const SolverOptions& options, const VectorX& y, const VectorX& yp);

/// The decision to leave a method for the next one of the order.
struct MethodChange {
  enum class Cause {
    cost,  ///< the next method has less work
    stop,  ///< the method can make no step
    guard, ///< a guard has refused a step of the method
  };
  Cause cause = Cause::cost;
  std::string method; ///< the one that is left
  double time = 0.0;  ///< [s]
  std::string reason; ///< what happened
};

/// "radau gave up: the step has become too short"; a decision on costs by its reason alone.
std::string in_words(const MethodChange& change);

/// "radau at t = 1.5 s: the step has become too short"
std::string with_time(const MethodChange& change);

/// The method at work in a run, those before it and those that are left. Each method is given up
/// once at most: what it could not pass may come again.
class MethodChoice {
public:
  /// The one of that name; none is left.
  explicit MethodChoice(std::string method);

  /// Those of an order, from the first on.
  explicit MethodChoice(MethodOrder order);

  const std::string& method() const { return method(state_.at); }
  const MethodOrder& order() const { return order_; }

  /// Was it chosen, rather than named?
  bool chosen() const { return order_.methods.size() > 1; }

  /// Is there another method to go on with?
  bool more() const { return state_.at + 1 < size(state_.turns); }

  /// Goes on with the next method, of which there must be one.
  void next(const MethodChange& change);

  /// The change that follows from an error of the method at work. Throws SolverError where no
  /// method is left, with all that were tried.
  MethodChange after(const SolverError& error, MethodChange::Cause cause) const;

  /// Takes an accepted step of the length h [s] at the rate of the motion [1/s], after so many
  /// operations since the start of the run.
  /// @param own the method chose its end; else h is no evidence
  void accept(double h, double rate, bool own, double operations);

  /// The change at time t [s] to a method with longer steps, where so many of the last steps of
  /// explicit_rk were so short against the motion that it must be stability that limits them.
  std::optional<MethodChange> labours(double t) const;

  /// Is it time to ask whether explicit_rk would do the work of radau with less? Once in so many
  /// steps, where the scene was stiff at its start.
  bool weighs() const;

  /// Lets explicit_rk follow, then radau again, if it would need less than half of the operations:
  /// the counts are good to a factor of 2. Its steps are as long as those of radau, and no longer
  /// than its stability allows. Its turn takes ten times the operations of the steps that were
  /// weighed, so that these count little, and twice those of its last turn if radau did no better
  /// at once.
  /// @param t        time now [s]
  /// @param of_step  operations of one step of explicit_rk
  /// @param fastest  rate of the equations [1/s], asked for where steps of any length would do
  /// @returns the change to explicit_rk, if so
  std::optional<MethodChange> weigh(double t, double of_step,
                                    const std::function<double()>& fastest);

  /// The change back to radau at time t [s], where the turn of explicit_rk is over.
  std::optional<MethodChange> returns(double t) const;

  /// A method from a time on, and why, in words.
  struct Part {
    std::string method;
    double from = 0.0; ///< [s]
    std::string reason;
  };
  std::vector<Part> parts() const;

  struct State {
    std::size_t at = 0;
    std::vector<MethodChange> changes; ///< so far, one for each method before
    int short_steps = 0;               ///< in a row
    std::size_t turns = 0;             ///< of explicit_rk, each with radau after it
    double turn = 0.0;                 ///< steps of the last
    double turn_steps = 0.0;           ///< made in it
    bool again = false;                ///< have no steps of radau been weighed since the last turn?
    int weighed_steps = 0;             ///< since the last `weigh`
    double weighed_time = 0.0;         ///< that they took [s]
    double operations = 0.0, weighed_from = 0.0; ///< at the last step, at the last `weigh`
  };
  const State& state() const { return state_; }

  /// Throws Error for the state of another order.
  void set(State state);

private:
  bool takes_turn() const { return state_.at % 2 == 1 && state_.at < 2 * state_.turns; }
  std::size_t size(std::size_t turns) const { return order_.methods.size() + 2 * turns; }
  const std::string& method(std::size_t at) const;

  MethodOrder order_;
  State state_;
};

/// "auto: explicit_rk (nothing is stiff), radau from t = 1.2 s because ..."; a method that was
/// named by its name alone.
std::string in_words(const MethodChoice& choice);

} // namespace hydrodae::run
