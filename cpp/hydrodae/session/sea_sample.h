#pragma once
/// The mean powers of a run as a sample of its sea.

#include "hydrodae/core/channel.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/simulation.h"

namespace hydrodae::session {

/// Keeps the work of the power take-offs at the samples after the ramp, for the intervals of their
/// means: the powers between samples are exact, however far apart these are. Each time that there
/// are `most_samples`, every second is left out.
class SeaSample {
public:
  static constexpr std::size_t most_samples = 16384;

  /// @param channels columns of the rows, in their order
  SeaSample(const model::Scene& scene, const std::vector<Channel>& channels);

  /// A row of the recorder; those from `averaged_from` on count.
  void take(double t, double averaged_from, std::span<const double> row);

  /// Period of the sea, and the intervals of the mean powers that are known already.
  void write(RunStatistics& statistics) const;

  struct State {
    std::vector<double> work;         ///< one value a column, sample after sample [J]
    std::size_t taken = 0, every = 1; ///< rows after the ramp; one of so many is kept
  };
  const State& state() const { return state_; }
  void set(State state) { state_ = std::move(state); }

private:
  struct Column {
    std::string name; ///< of the load
    std::size_t place = 0;
  };
  std::vector<Column> columns_; ///< of the work of each load; none without an irregular sea
  double step_, period_;        ///< [s]
  State state_;
};

} // namespace hydrodae::session
