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
  bool may_weigh = false; ///< true: explicit_rk may follow the first method where it is cheaper
};

/// Order of the methods. radau takes every scene that any method takes in the stability map, the
/// attack suite and the charts of tests/, but is not always the cheapest:
///
/// - Not stiff: explicit_rk is up to four times as cheap at equal accuracy; then radau, then ida.
/// - Stiff, with a rate 50 times that of the motion: an explicit step, about 6 over the fastest
/// rate,
///   is shorter than a tenth of a radian of the motion, and a radau step costs less. explicit_rk
///   also spends energy on parts that hardly move. Only ida follows radau. When fast motion
///   develops (a line that snaps taut), radau needs short steps and many iterations; explicit_rk
///   takes over when it is cheaper.
/// - Expensive calls in every evaluation (Python, nearest point of a path) outweigh the algebra:
///   radau evaluates at most half as often as explicit_rk.
/// - No damping: errors of all steps add up. Those of radau are 10 to 100 times smaller at the same
///   tolerance, so that it is first for runs of more than 2000 radians.
MethodOrder order_methods(const SceneTraits& traits);

/// Traits of a scene at its start, with consistent y, y'.
SceneTraits find_traits(const system::Regime& system, const system::Pattern& pattern,
                        const SolverOptions& options, const VectorX& y, const VectorX& yp);

/// Decision to replace a method by the next one of the order.
struct MethodChange {
  enum class Cause {
    cost,  ///< the next method has less work
    stop,  ///< the method cannot make a step
    guard, ///< a guard has refused a step of the method
  };
  Cause cause = Cause::cost;
  std::string method; ///< method that is replaced
  double time = 0.0;  ///< time of the change [s]
  std::string reason; ///< description of the cause
};

/// Message "radau gave up: the step has become too short"; for a decision on costs, its reason.
std::string in_words(const MethodChange& change);

/// Message "radau at t = 1.5 s: the step has become too short".
std::string with_time(const MethodChange& change);

/// Method of a run, with those before it and those left. Each method is given up at most once,
/// because the difficulty that stopped it may return.
class MethodChoice {
public:
  /// Single method of this name.
  explicit MethodChoice(std::string method);

  /// Methods of an order, beginning with the first.
  explicit MethodChoice(MethodOrder order);

  const std::string& method() const { return method(state_.at); }
  const MethodOrder& order() const { return order_; }

  /// Returns whether "auto" chose the method.
  bool chosen() const { return order_.methods.size() > 1; }

  /// Returns whether another method is left.
  bool more() const { return state_.at + 1 < size(state_.turns); }

  /// Continues with the next method, which must exist.
  void next(const MethodChange& change);

  /// Change after an error of the present method. Throws SolverError with the list of tried methods
  /// if none is left.
  MethodChange after(const SolverError& error, MethodChange::Cause cause) const;

  /// Takes an accepted step of length h [s] at the rate of motion [1/s], with the number of
  /// operations since the start of the run.
  /// @param own  true: the method chose the end of the step; otherwise h is no evidence
  void accept(double h, double rate, bool own, double operations);

  /// Change at time t [s] to a method with longer steps, if the last steps of explicit_rk were so
  /// short against the motion that stability must limit them.
  std::optional<MethodChange> labours(double t) const;

  /// True every 10 steps in a scene that was stiff at its start: the costs of explicit_rk and radau
  /// are then compared.
  bool weighs() const;

  /// Compares costs. explicit_rk follows if it needs less than half of the operations (counts are
  /// exact to a factor of 2), and radau follows it again. The explicit steps are as long as those
  /// of radau, within the stability limit. The turn takes ten times the operations of the compared
  /// steps, and twice those of the last turn if radau was not cheaper at once.
  /// @param t        present time [s]
  /// @param of_step  operations of one step of explicit_rk
  /// @param fastest  fastest rate of the equations [1/s]; called only if steps of any length would
  /// do
  /// @returns the change to explicit_rk, if it is cheaper
  std::optional<MethodChange> weigh(double t, double of_step,
                                    const std::function<double()>& fastest);

  /// Change back to radau at time t [s], at the end of the turn of explicit_rk.
  std::optional<MethodChange> returns(double t) const;

  /// Method from a time on, with the reason.
  struct Part {
    std::string method;
    double from = 0.0; ///< [s]
    std::string reason;
  };
  std::vector<Part> parts() const;

  struct State {
    std::size_t at = 0;
    std::vector<MethodChange> changes; ///< changes so far, one for each earlier method
    int short_steps = 0;               ///< number of short steps in a row
    std::size_t turns = 0;             ///< number of turns of explicit_rk, each followed by radau
    double turn = 0.0;                 ///< number of steps of the last turn
    double turn_steps = 0.0;           ///< steps made in that turn
    bool again = false;                ///< true: no steps of radau compared since the last turn
    int weighed_steps = 0;             ///< number of steps since the last `weigh`
    double weighed_time = 0.0;         ///< duration of these steps [s]
    /// Operations at the last step, and at the last `weigh`
    double operations = 0.0, weighed_from = 0.0;
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

/// Message "auto: explicit_rk (nothing is stiff), radau from t = 1.2 s because ..."; for a method
/// set by name, its name.
std::string in_words(const MethodChoice& choice);

} // namespace hydrodae::run
