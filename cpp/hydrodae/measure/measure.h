#pragma once
/// Sums over the accepted steps: turns of angles, work of every load, energies of the scene and of
/// each mechanism. The run owns it; guards and the recorder read it.

#include <functional>
#include <optional>
#include <span>

#include "hydrodae/measure/observer.h"

namespace hydrodae::measure {

/// Nodes on [0, 1], including both ends, and weights of the quadrature of work over one step.
struct Quadrature {
  std::vector<double> nodes{0.0, 0.5, 1.0}, weights{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
};

/// Missing energy, and the energy that it is compared with [J].
struct Balance {
  double error = 0.0; ///< error at the end of the last step
  double exchanged = 0.0;
  double start = 0.0;   ///< kinetic energy of the bodies at the start
  double kinetic = 0.0; ///< largest kinetic energy so far
};

/// Measure of accepted steps, in order: `begin`, samples in the step, then `accept` or `take_back`.
class Measure {
public:
  /// Function of y and y' at a time inside the last accepted step.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;
  using StageState = std::function<double(std::size_t stage, VectorX& y, VectorX& yp)>;

  Measure(const system::Regime& system, double t0, const VectorX& y, const VectorX& yp);

  /// Sets the quadrature of work between two steps; Simpson's at first.
  void set_quadrature(const Quadrature& rule) { state_.rule = rule; }

  /// Takes the accepted step that ends at `t`: balance and turns are those at its end.
  /// @param idle  true: `at` gives no reactions inside the step, where they do no work
  void begin(double t, const Interpolant& at, bool idle);

  /// Takes an accepted step with the work summed over the stages of the method, for steps without
  /// samples: the work is one more unknown of the method.
  /// @param weights  weights of the stages; the first one is the start of the step
  /// @param stage    (i, y, y') gives its state, and returns its time [s]
  /// @param at       gives the end of the step
  void begin(double t, std::span<const double> weights, const StageState& stage,
             const Interpolant& at);

  /// Closes the step: work and turns are stored.
  void accept();

  /// Discards the step: everything is as at its start.
  void take_back() { state_.now = before_; }

  /// Takes a change of rows at the end of the last accepted step, with y, y' after it. Other
  /// changes of the kinetic energy become an error of the balance.
  /// @param work  work of all rows through their impulses [J], after an impact
  void restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work);

  /// Motions at the end of the last step; angles count full turns.
  const system::Turns& turns() const { return state_.now.turns; }

  /// Balance of the scene at the end of the last step, and at its start.
  const Balance& whole() const { return state_.now.whole; }
  const Balance& whole_before() const { return before_.whole; }

  /// Balance of each mechanism with all external loads; empty if there is only one.
  const std::vector<Balance>& mechanisms() const { return state_.now.mechanisms; }
  const std::vector<Balance>& mechanisms_before() const { return before_.mechanisms; }

  /// Largest |balance error| so far over the largest exchanged energy so far, both at the ends of
  /// steps [-].
  double relative_balance_error() const {
    return state_.now.whole.exchanged > 0.0 ? state_.now.largest_error / state_.now.whole.exchanged
                                            : 0.0;
  }

  /// Sets the start of the means [s], see `absorbed`; default: the start of the run.
  void average_from(double time) { mean_from_ = time; }
  double averaged_from() const { return mean_from_; }

  /// Mean absorbed power of each power take-off [W]; empty before that time.
  struct Absorbed {
    std::string name;
    double mean_power = 0.0;
  };
  std::vector<Absorbed> absorbed() const;

  // Functions for samples inside the step:
  /// Start and end of the step [s].
  double start() const { return state_.t; }
  double end() const { return state_.end; }
  /// Observer at a state inside the step.
  Observer& observer() { return observer_; }
  const Observer& observer() const { return observer_; }
  /// Work of each component up to time t, at the observer's state [J].
  std::vector<double> work_at(double t) const;
  /// Gained kinetic energies minus the work of all forces, at the observer's state [J].
  double balance_error(const std::vector<double>& work) const;

  struct Sums { ///< sums at the end of the step
    Balance whole;
    double largest_error = 0.0; ///< largest error of the whole [J]
    std::vector<Balance> mechanisms;
    std::vector<double> mechanism_kinetic; ///< [J]
    system::Turns turns;
    std::vector<double> mean_work; ///< work at the start of the means [J]; empty: zero
  };
  struct State {
    double t = 0.0, end = 0.0; ///< start and end of the step [s]
    /// Powers and work at t, by component; with several mechanisms then by load, and of each
    /// mechanism's rows.
    std::vector<double> power, work;
    Sums now;
    Quadrature rule;
  };

  /// State between two steps.
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
  /// Powers at the nodes of the step; empty: summed by its stages
  std::vector<std::vector<double>> powers_;
  std::vector<double> end_power_, end_work_; ///< powers and work at the end of the step
  double mean_from_ = 0.0;                   ///< start of the means [s]
  Sums before_;                              ///< sums at the start of the step
  VectorX y_, yp_;
};

} // namespace hydrodae::measure
