#pragma once
/// The error of a run, from its difference to a second run of the same scene.

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
  std::vector<double> error; ///< largest at the samples of each span that both runs reached [m]
  std::vector<double> part;  ///< the same as a part of the motion [-]
  double motion = 0.0;       ///< of its group: the largest displacement from the start [m]
  double largest = 0.0;      ///< of `part` [-]
  double when = 0.0;         ///< time of it [s]
  /// Where the error passes a twentieth of the motion [s]; infinite: it does not.
  double reproducible_until = std::numeric_limits<double>::infinity();
  /// Where the two runs are a twentieth of the motion apart [s]; infinite: they are not.
  double parted = std::numeric_limits<double>::infinity();
};

struct Estimate {
  std::string how;          ///< "a second run at rtol = 1e-05"
  std::string missing;      ///< why it is missing, or ends at `until`; empty: it is complete
  double until = 0.0;       ///< time up to which the runs were compared [s]
  std::vector<double> time; ///< first sample of each span [s]
  std::vector<MoverError> movers;
  bool known() const { return time.size() > 1; }
  const MoverError* worst() const; ///< null: nothing moves, or nothing is known
};

/// Takes the samples of two runs, each from a thread of its own, and compares them one by one:
///
///   error = |first - second| / divisor
///
/// With errors e and c e of the two the difference is (c - 1) e, so that the divisor is c - 1. From
/// where the error passes a twentieth of the motion it is the difference itself.
///
/// A span is one sample. Each time that there are `most_spans`, two become one with the larger
/// difference: the memory does not grow with the length of the runs, and no difference is lost.
class Comparison {
public:
  static constexpr std::size_t most_spans = 16384;
  static constexpr std::size_t most_ahead = 10000; ///< samples that wait for the slower run

  /// @param in_turn the second run follows the first, whose samples all wait for it
  Comparison(const system::Regime& first, bool in_turn);

  /// The state of the first run at the end of a step, with its coordinates over turns.
  void moved(const VectorX& y, const std::vector<double>& turns);

  /// The next sample of the first run, at `time` [s].
  /// @param go_on asked while the run waits for the other one; false: it waits no longer
  void first(double time, const VectorX& y, const std::function<bool()>& go_on);

  /// The next sample of the second run. False when nothing is to follow: the first has been given
  /// up.
  bool second(const VectorX& places);

  /// No more samples of that run.
  void end_first();
  void end_second();

  /// Waits for the end of the second run, for a tenth of a second at most. @returns whether it has
  /// ended
  bool wait_for_second();

  /// While it is set, a second run that is ahead does not wait for the first, which waits for it.
  void let_pass(bool second);

  struct State {
    std::deque<std::pair<double, VectorX>> first; ///< samples that wait for the other run
    std::deque<VectorX> second;
    bool second_ended = false;
    VectorX start;
    std::vector<double> turns0;            ///< at the start
    std::vector<Apart> motion;             ///< by group
    std::size_t span = 1, compared = 0;    ///< samples in a span, and in all
    double until = 0.0;                    ///< time of the last sample compared [s]
    std::vector<double> time;              ///< first sample of each span [s]
    std::vector<std::vector<Apart>> apart; ///< by mover
  };
  State state() const;
  void set(State state);

  /// Of all samples that both runs have given.
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
