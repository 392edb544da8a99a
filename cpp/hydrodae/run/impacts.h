#pragma once
/// What stops and one-sided joints take, as columns of the results.

#include <string>
#include <vector>

#include "hydrodae/core/channel.h"
#include "hydrodae/events/switching.h"

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

} // namespace hydrodae::run
