#pragma once
/// From the solution to the columns of the results.

#include <functional>
#include <optional>
#include <span>

#include "hydrodae/core/channel.h"
#include "hydrodae/system/observer.h"

namespace hydrodae::system {

/// Nodes on [0, 1], the ends among them, and weights, by which the work over one step is summed.
struct Quadrature {
  std::vector<double> nodes{0.0, 0.5, 1.0}, weights{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  void remember(Archive& a) { a(nodes, weights); }
};

/// Integrates the work of every force over the accepted steps, follows angles over turns, and fills
/// rows of the results. Each accepted step in order: `begin`, the samples in it, `accept`.
class Recorder {
public:
  /// y and y' at a time inside the step that was accepted last.
  using Interpolant = std::function<void(double t, VectorX& y, VectorX& yp)>;

  Recorder(const Regime& system, double t0, const VectorX& y, const VectorX& yp);

  /// The columns, in the order of `sample`.
  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }

  /// From now on (between two steps) the work is summed by this rule; Simpson's at first.
  void set_quadrature(const Quadrature& rule) { rule_ = rule; }

  /// Takes the accepted step that ends at `t`: balance and turns are those of its end.
  void begin(double t, const Interpolant& at);

  /// Fills one row at time `t` of the step begun (or at the start). Values of all channels one
  /// after the other; length `width()`.
  void sample(double t, const Interpolant& at, std::span<double> row);

  /// Fills the row of the end of the last closed step, where y, y' are given. Changes nothing.
  void look(const VectorX& y, const VectorX& yp, std::span<double> row);

  /// Closes the step: work and turns are carried over.
  void accept();

  /// Forgets the step begun instead: balances, turns and means are those of its start again.
  void take_back();

  /// Rows of the system came or went at the end of the last accepted step; y, y' from there on.
  /// What the kinetic energy changed by otherwise is left as an error of the balance.
  /// @param work of all rows through their impulses, where something struck [J]
  void restart(const VectorX& y, const VectorX& yp, const std::optional<double>& work);

  /// The bodies, and y, at the last sample.
  const std::vector<BodyState<double>>& bodies() const { return observer_.bodies(); }
  const VectorX& state() const { return y_; }

  /// All motions at the end of the last step, angles followed over turns.
  const Turns& turns() const { return turns_; }

  /// Largest |balance error| so far over the largest energy exchanged so far [-], both taken at the
  /// ends of steps and at samples.
  double relative_balance_error() const;

  /// Balance error at the end of the last step, and the largest energy exchanged [J].
  double balance_error() const { return whole_.balance_error; }
  double largest_energy() const { return whole_.largest_energy; }

  /// Balance error at the end of the last step, and what it is to be compared with.
  struct Balance {
    double error = 0.0, exchanged = 0.0; ///< [J]
    double start = 0.0;                  ///< kinetic energy of its bodies at the start [J]
    double kinetic = 0.0;                ///< the largest of it so far [J]
    void remember(Archive& a) { a(error, exchanged, start, kinetic); }
  };
  Balance whole() const { return balance_of(whole_); }

  /// The same for each mechanism by itself, with all that acts on it from outside; none where there
  /// is but one.
  const std::vector<Balance>& mechanisms() const { return mechanisms_; }

  /// Both at the start of the step begun.
  Balance whole_before() const { return balance_of(before_.whole); }
  const std::vector<Balance>& mechanisms_before() const { return before_.mechanisms; }

  /// From `time` [s] on means are taken, see `absorbed`; by default from the start.
  void average_from(double time) { mean_from_ = time; }
  double averaged_from() const { return mean_from_; }

  /// What each power take-off has absorbed on average [W], none before that time.
  struct Absorbed {
    std::string name;
    double mean_power = 0.0;
  };
  std::vector<Absorbed> absorbed() const;
  /// Between two steps.
  void remember(Archive& a);

private:
  /// Balance of the scene, and its largest values so far [J].
  struct Whole {
    double largest_kinetic = 0.0, largest_energy = 0.0, largest_error = 0.0, balance_error = 0.0;
    void remember(Archive& a) { a(largest_kinetic, largest_energy, largest_error, balance_error); }
  };
  struct Before { ///< what `begin` changes, as it was
    Whole whole;
    std::vector<Balance> mechanisms;
    Turns turns;
    std::vector<double> mean_work, kinetic;
  };
  Balance balance_of(const Whole& w) const {
    return {w.balance_error, w.largest_energy, energy0_, w.largest_kinetic};
  }
  void fill(double t, std::span<double> row, const std::vector<double>& work);
  void make_channels();
  void check_paths() const;
  void add_channel(std::string path, int width, std::string unit, std::string frame,
                   std::string description);
  void describe_marker(const joint::Marker& marker);
  std::vector<double> work_at(double x) const;
  void fill_bodies(double*& out);
  void fill_joints(double*& out);
  void fill_markers(double*& out);
  void add_gauges();
  void fill_gauges(double t, double*& out);
  void fill_energy(double*& out, const std::vector<double>& work);
  double balance(const std::vector<double>& work);
  void balance_mechanisms();
  void take_turns();
  std::vector<double> powers() const;

  const Regime& s_;
  Observer observer_;
  std::vector<Channel> channels_;
  std::size_t width_ = 0;
  double t_, end_; ///< start and end of the step [s]
  /// Per component, at t_; with several mechanisms then per load and per mechanism its rows.
  std::vector<double> power_, work_;
  std::vector<std::vector<double>> powers_; ///< at the nodes of the step
  std::vector<double> end_work_;            ///< at the end of the step
  double mean_from_ = 0.0;                  ///< [s]
  std::vector<double> mean_work_;           ///< work at that time; empty: zero
  Turns turns_;                             ///< there
  std::vector<double> end_kinetic_;         ///< there, by mechanism [J]
  std::vector<Balance> mechanisms_;         ///< empty where there is one mechanism only
  double energy0_ = 0.0;                    ///< kinetic energies at the start [J]
  Whole whole_;
  Before before_;
  Quadrature rule_;
  VectorX y_, yp_;
};

} // namespace hydrodae::system
