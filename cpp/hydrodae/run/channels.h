#pragma once
/// What can be read of a run: the columns of its results.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hydrodae/core/channel.h"
#include "hydrodae/events/switching.h"
#include "hydrodae/observe/recorder.h"

namespace hydrodae::run {

/// What the stops of a scene have taken so far: columns of sums.
class ImpactOutput {
public:
  explicit ImpactOutput(const system::System& system);

  std::vector<Channel> channels() const;
  std::size_t width() const { return 2 * stops_.size(); }

  /// Sums so far, in the order of the channels; `at` is of width().
  void fill(const events::Switching* switching, double* at) const;

  struct Stop {
    std::size_t index; ///< among the switches
    std::string name;
    bool angle;
    std::optional<double> contact_time; ///< [s]

    /// Of half a sine that lasts the contact time: pi J / 2 T [N or N m].
    double peak(double impulse) const { return 0.5 * pi * impulse / *contact_time; }
  };
  const std::vector<Stop>& stops() const { return stops_; }

private:
  std::vector<Stop> stops_;
};

/// The recorder's columns, those of the solver and of the impacts; then what controllers hold.
class Channels {
public:
  /// @param held columns of what controllers hold
  Channels(const system::Regime& regime, measure::Measure& measure,
           const std::vector<Channel>& held);

  const std::vector<Channel>& all() const { return all_; }
  std::size_t width() const { return width_; }
  observe::Recorder& recorder() { return recorder_; }
  const observe::Recorder& recorder() const { return recorder_; }
  const ImpactOutput& impacts() const { return impacts_; }

  /// What stands in the columns behind the recorder's.
  struct Counts {
    linalg::Statistics last; ///< its step and order
    const events::Switching* switching = nullptr;
    std::vector<double> held; ///< by controllers
  };
  void fill(const Counts& counts, std::span<double> row) const;

  /// The numbers of a channel in a row: one, three or four; one of a component, "velocity.z".
  /// Throws CaseError, with the nearest name, for an unknown one.
  std::span<const double> find(const std::string& name, std::span<const double> row) const;

private:
  void add(const std::vector<Channel>& more);

  observe::Recorder recorder_;
  ImpactOutput impacts_;
  std::vector<Channel> all_;
  std::size_t width_ = 0;
};

} // namespace hydrodae::run
