#pragma once
/// Error of a run, from its difference to a second run of the same scene.

#include <condition_variable>
#include <deque>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "hydrodae/accuracy/places.h"

namespace hydrodae::accuracy {

/// Error of one body or line over a run.
struct MoverError {
  std::string name;
  /// Error in each span: largest at the samples that both runs reached [m]
  std::vector<double> error;
  std::vector<double> part; ///< error as part of the motion [-]
  double motion = 0.0;      ///< motion of its group: largest displacement from the start [m]
  double largest = 0.0;     ///< largest value of `part` [-]
  double when = 0.0;        ///< time of `largest` [s]
  /// Time at which the error passes a twentieth of the motion [s]; infinite: never.
  double reproducible_until = std::numeric_limits<double>::infinity();
  /// Time at which the two runs are a twentieth of the motion apart [s]; infinite: never.
  double parted = std::numeric_limits<double>::infinity();
};

struct Estimate {
  std::string how;          ///< "a second run at rtol = 1e-05"
  std::string missing;      ///< reason why it is missing, or ends at `until`; empty: complete
  double until = 0.0;       ///< time up to which the runs were compared [s]
  std::vector<double> time; ///< first sample of each span [s]
  std::vector<MoverError> movers;
  bool known() const { return time.size() > 1; }
  const MoverError* worst() const; ///< null: nothing moves, or nothing is known
};

/// Comparison of the samples of two runs, each from its own thread, one by one:
///
///   error = |first - second| / divisor
///
/// For errors e and c e of the two runs the difference is (c - 1) e: the divisor is c - 1. After
/// the error passes a twentieth of the motion, the difference itself is the error.
///
/// A span is one sample. At `most_spans`, two spans merge into one with the larger difference: the
/// memory is bounded, and no difference is lost.
class Comparison {
public:
  static constexpr std::size_t most_spans = 16384;
  /// Number of samples that may wait for the slower run
  static constexpr std::size_t most_ahead = 10000;

  /// @param in_turn  true: the second run follows the first, whose samples all wait for it
  Comparison(const system::Regime& first, bool in_turn);

  /// Takes the state of the first run at the end of a step, with its coordinates over turns.
  void moved(const VectorX& y, const std::vector<double>& turns);

  /// Takes the next sample of the first run, at `time` [s].
  /// @param go_on  called while the run waits for the other one; false: it stops waiting
  void first(double time, const VectorX& y, const std::function<bool()>& go_on);

  /// Takes the next sample of the second run. Returns false if no more are needed because the first
  /// run was given up.
  bool second(const VectorX& places);

  /// Ends the samples of a run.
  void end_first();
  void end_second();

  /// Waits for the end of the second run, for at most a tenth of a second. @returns whether it has
  /// ended
  bool wait_for_second();

  /// Sets whether a second run that is ahead continues without waiting for the first.
  void let_pass(bool second);

  struct State {
    std::deque<std::pair<double, VectorX>> first; ///< samples that wait for the other run
    std::deque<VectorX> second;
    bool second_ended = false;
    VectorX start;
    std::vector<double> turns0;            ///< turns at the start
    std::vector<Apart> motion;             ///< motion by group
    std::size_t span = 1, compared = 0;    ///< number of samples in a span, and in total
    double until = 0.0;                    ///< time of the last sample compared [s]
    std::vector<double> time;              ///< first sample of each span [s]
    std::vector<std::vector<Apart>> apart; ///< distance of the runs by mover
  };
  State state() const;
  void set(State state);

  /// Error estimate from all samples that both runs have given.
  Estimate estimate(double divisor) const;

private:
  void compare();
  void double_spans();
  std::vector<Apart> measures() const;

  Movers movers_;
  const bool in_turn_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool first_ended_ = false, second_passes_ = false;
  State state_;
  VectorX now_;
};

} // namespace hydrodae::accuracy
