#pragma once
/// Mean powers of a run as a sample of its sea.

#include "hydrodae/core/channel.h"
#include "hydrodae/model/scene.h"
#include "hydrodae/simulation.h"

namespace hydrodae::session {

/// Work of the power take-offs at the samples after the ramp, for confidence intervals of their
/// means. Mean powers between samples are exact for any spacing; at `most_samples` every second
/// sample is dropped.
class SeaSample {
public:
  static constexpr std::size_t most_samples = 16384;

  /// @param channels  columns of the rows, in their order
  SeaSample(const model::Scene& scene, const std::vector<Channel>& channels);

  /// Takes a row of the recorder; rows from `averaged_from` on count.
  void take(double t, double averaged_from, std::span<const double> row);

  /// Writes the period of the sea, and the intervals of the mean powers so far.
  void write(RunStatistics& statistics) const;

  struct State {
    std::vector<double> work; ///< work by column, sample after sample [J]
    /// Number of rows after the ramp; interval of the stored rows
    std::size_t taken = 0, every = 1;
  };
  const State& state() const { return state_; }
  void set(State state) { state_ = std::move(state); }

private:
  struct Column {
    std::string name; ///< name of the load
    std::size_t place = 0;
  };
  std::vector<Column> columns_; ///< work columns of each load; empty without an irregular sea
  double step_, period_;        ///< [s]
  State state_;
};

} // namespace hydrodae::session
