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
  void remember(Archive& a) { a(nodes, weights); }
};

/// Energy that is missing, and what it is to be compared with [J].
struct Balance {
  double error = 0.0; ///< at the end of the last step
  double exchanged = 0.0;
  double start = 0.0;   ///< kinetic energy of its bodies at the start
  double kinetic = 0.0; ///< the largest of it so far
  void remember(Archive& a) { a(error, exchanged, start, kinetic); }
};

/// Each accepted step in order: `begin`, the samples in it, `accept` or `take_back`.
class Measure {
public:
  /// y and y' at a time inside the step that was accepted last.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;
  using StageState = std::function<double(std::size_t stage, VectorX& y, VectorX& yp)>;

  Measure(const system::Regime& system, double t0, const VectorX& y, const VectorX& yp);

  /// From now on (between two steps) the work is summed by this rule; Simpson's at first.
  void set_quadrature(const Quadrature& rule) { rule_ = rule; }

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
  void take_back() { now_ = before_; }

  /// Rows of the system came or went at the end of the last accepted step; y, y' from there on.
  /// What the kinetic energy changed by otherwise is left as an error of the balance.
  /// @param work of all rows through their impulses, where something struck [J]
  void restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work);

  /// All motions at the end of the last step, angles followed over turns.
  const system::Turns& turns() const { return now_.turns; }

  /// Of the scene at the end of the last step, and at its start.
  const Balance& whole() const { return now_.whole; }
  const Balance& whole_before() const { return before_.whole; }

  /// The same for each mechanism by itself, with all that acts on it from outside; none where there
  /// is but one.
  const std::vector<Balance>& mechanisms() const { return now_.mechanisms; }
  const std::vector<Balance>& mechanisms_before() const { return before_.mechanisms; }

  /// Largest |balance error| so far over the largest energy exchanged so far, both taken at the
  /// ends of steps [-].
  double relative_balance_error() const {
    return now_.whole.exchanged > 0.0 ? now_.largest_error / now_.whole.exchanged : 0.0;
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
  double start() const { return t_; }
  double end() const { return end_; }
  /// What is observed at a state in it, and from what the work there is counted.
  Observer& observer() { return observer_; }
  const Observer& observer() const { return observer_; }
  /// Work of each component until the time at which the observer is [J].
  std::vector<double> work_at(double t) const;
  /// Kinetic energies gained there minus the work of all forces [J].
  double balance_error(const std::vector<double>& work) const;

  /// Between two steps.
  void remember(Archive& a);

private:
  struct Sums { ///< at the end of the step begun
    Balance whole;
    double largest_error = 0.0; ///< of the whole [J]
    std::vector<Balance> mechanisms;
    std::vector<double> mechanism_kinetic; ///< [J]
    system::Turns turns;
    std::vector<double> mean_work; ///< at the time from which means are taken; empty: zero [J]
    void remember(Archive& a) {
      a(whole, largest_error, mechanisms, mechanism_kinetic, turns, mean_work);
    }
  };
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
  double t_, end_; ///< start and end of the step [s]
  /// Per component, at t_; with several mechanisms then per load and per mechanism its rows.
  std::vector<double> power_, work_;
  std::vector<std::vector<double>> powers_;  ///< at the nodes of the step; empty: by its stages
  std::vector<double> end_power_, end_work_; ///< at the end of the step
  double mean_from_ = 0.0;                   ///< [s]
  Sums now_, before_;
  Quadrature rule_;
  VectorX y_, yp_;
};

} // namespace hydrodae::measure
