#pragma once
/// What the accepted steps add up to: turns of angles, work of every load, energies of the scene
/// and of each mechanism. It has one owner, the run; guards and the recorder read it.

#include <functional>
#include <optional>
#include <span>

#include "hydrodae/measure/observer.h"

namespace hydrodae::measure {

/// Nodes on [0, 1], the ends among them, and weights, by which the work over one step is summed.
struct Quadrature {
  std::vector<double> nodes{0.0, 0.5, 1.0}, weights{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
};

/// Energy that is missing, and what it is to be compared with [J].
struct Balance {
  double error = 0.0; ///< at the end of the last step
  double exchanged = 0.0;
  double start = 0.0;   ///< kinetic energy of its bodies at the start
  double kinetic = 0.0; ///< the largest of it so far
};

/// Each accepted step in order: `begin`, the samples in it, `accept` or `take_back`.
class Measure {
public:
  /// y and y' at a time inside the step that was accepted last.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;
  using StageState = std::function<double(std::size_t stage, VectorX& y, VectorX& yp)>;

  Measure(const system::Regime& system, double t0, const VectorX& y, const VectorX& yp);

  /// From now on (between two steps) the work is summed by this rule; Simpson's at first.
  void set_quadrature(const Quadrature& rule) { state_.rule = rule; }

  /// Takes the accepted step that ends at `t`: balance and turns are those of its end.
  /// @param idle `at` gives no reactions inside the step, where they do no work
  void begin(double t, const Interpolant& at, bool idle);

  /// The same by the stages of the method that made the step, where nobody looks inside: the work
  /// is one more unknown of the same method.
  /// @param weights  of the stages, the first of which is the start of the step
  /// @param stage    (i, y, y') gives its state, and returns its time [s]
  /// @param at       gives the end of the step
  void begin(double t, std::span<const double> weights, const StageState& stage,
             const Interpolant& at);

  /// Closes the step: work and turns are carried over.
  void accept();

  /// Forgets the step begun instead: all is as at its start.
  void take_back() { state_.now = before_; }

  /// Rows of the system came or went at the end of the last accepted step; y, y' from there on.
  /// What the kinetic energy changed by otherwise is left as an error of the balance.
  /// @param work of all rows through their impulses, where something struck [J]
  void restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work);

  /// All motions at the end of the last step, angles followed over turns.
  const system::Turns& turns() const { return state_.now.turns; }

  /// Of the scene at the end of the last step, and at its start.
  const Balance& whole() const { return state_.now.whole; }
  const Balance& whole_before() const { return before_.whole; }

  /// The same for each mechanism by itself, with all that acts on it from outside; none where there
  /// is but one.
  const std::vector<Balance>& mechanisms() const { return state_.now.mechanisms; }
  const std::vector<Balance>& mechanisms_before() const { return before_.mechanisms; }

  /// Largest |balance error| so far over the largest energy exchanged so far, both taken at the
  /// ends of steps [-].
  double relative_balance_error() const {
    return state_.now.whole.exchanged > 0.0 ? state_.now.largest_error / state_.now.whole.exchanged
                                            : 0.0;
  }

  /// From `time` [s] on means are taken, see `absorbed`; by default from the start.
  void average_from(double time) { mean_from_ = time; }
  double averaged_from() const { return mean_from_; }

  /// What each power take-off has absorbed on average [W], none before that time.
  struct Absorbed {
    std::string name;
    double mean_power = 0.0;
  };
  std::vector<Absorbed> absorbed() const;

  // For samples inside the step begun:
  /// Start and end of that step [s].
  double start() const { return state_.t; }
  double end() const { return state_.end; }
  /// What is observed at a state in it, and from what the work there is counted.
  Observer& observer() { return observer_; }
  const Observer& observer() const { return observer_; }
  /// Work of each component until the time at which the observer is [J].
  std::vector<double> work_at(double t) const;
  /// Kinetic energies gained there minus the work of all forces [J].
  double balance_error(const std::vector<double>& work) const;

  struct Sums { ///< at the end of the step begun
    Balance whole;
    double largest_error = 0.0; ///< of the whole [J]
    std::vector<Balance> mechanisms;
    std::vector<double> mechanism_kinetic; ///< [J]
    system::Turns turns;
    std::vector<double> mean_work; ///< at the time from which means are taken; empty: zero [J]
  };
  struct State {
    double t = 0.0, end = 0.0; ///< start and end of the step [s]
    /// Per component, at t; with several mechanisms then per load and per mechanism its rows.
    std::vector<double> power, work;
    Sums now;
    Quadrature rule;
  };

  /// Between two steps.
  const State& state() const { return state_; }
  void set(State state);

private:
  void add_work(double weight, const std::vector<double>& powers);
  std::vector<double> work_inside(double x) const;
  void take_mean(const Interpolant& at);
  void take_end();
  void take_balance();
  void balance_mechanisms();
  void take_turns();
  std::vector<double> powers() const;

  const system::Regime& s_;
  Observer observer_;
  State state_;
  std::vector<std::vector<double>> powers_;  ///< at the nodes of the step; empty: by its stages
  std::vector<double> end_power_, end_work_; ///< at the end of the step
  double mean_from_ = 0.0;                   ///< [s]
  Sums before_;                              ///< at the start of the step begun
  VectorX y_, yp_;
};

} // namespace hydrodae::measure
