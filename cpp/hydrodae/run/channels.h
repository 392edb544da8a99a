#pragma once
/// Channels of a run: the columns of its results.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/channel.h"
#include "hydrodae/events/switching.h"
#include "hydrodae/observe/recorder.h"

namespace hydrodae::run {

/// Impulses and work of the stops so far, as columns of sums.
class ImpactOutput {
public:
  explicit ImpactOutput(const system::System& system);

  std::vector<Channel> channels() const;
  std::size_t width() const { return 2 * stops_.size(); }

  /// Writes the sums so far, in the order of the channels; `at` has width() entries.
  void fill(const events::Switching* switching, double* at) const;

  struct Stop {
    std::size_t index; ///< index of the stop among the switches
    std::string name;
    bool angle;
    std::optional<double> contact_time; ///< duration of the impact [s]

    /// Peak load of a half sine over the contact time: pi J / 2 T [N or N m].
    double peak(double impulse) const { return 0.5 * pi * impulse / *contact_time; }
  };
  const std::vector<Stop>& stops() const { return stops_; }

private:
  std::vector<Stop> stops_;
};

/// Columns of the recorder, the solver, the impacts, and the controllers' held values.
class Channels {
public:
  /// @param held  columns of the values that controllers hold
  Channels(const system::Regime& regime, measure::Measure& measure,
           const std::vector<Channel>& held);

  const std::vector<Channel>& all() const { return all_; }
  std::size_t width() const { return width_; }
  observe::Recorder& recorder() { return recorder_; }
  const observe::Recorder& recorder() const { return recorder_; }
  const ImpactOutput& impacts() const { return impacts_; }

  /// Values of the columns after those of the recorder.
  struct Counts {
    linalg::Statistics last; ///< statistics with the last step and its order
    const events::Switching* switching = nullptr;
    std::vector<double> held; ///< values held by controllers
  };
  void fill(const Counts& counts, std::span<double> row) const;

  /// Values of a channel in a row: one, three or four; one for a component, "velocity.z". Throws
  /// CaseError with the nearest name for an unknown channel.
  std::span<const double> find(const std::string& name, std::span<const double> row) const;

private:
  void add(const std::vector<Channel>& more);

  observe::Recorder recorder_;
  ImpactOutput impacts_;
  std::vector<Channel> all_;
  std::size_t width_ = 0;
};

} // namespace hydrodae::run
