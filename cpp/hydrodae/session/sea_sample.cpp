#include "hydrodae/session/sea_sample.h"

#include <algorithm>

#include "hydrodae/core/text.h"
#include "hydrodae/math/sampling.h"
#include "hydrodae/model/waves.h"

namespace hydrodae::session {

SeaSample::SeaSample(const model::Scene& scene, const std::vector<Channel>& channels)
    : step_(scene.output.step), period_(model::irregular_period(scene)) {
  constexpr std::string_view head = "energy/work/";
  std::size_t place = 0;
  for (const Channel& channel : channels) {
    if (period_ > 0.0 && channel.path.starts_with(head))
      columns_.push_back({channel.path.substr(head.size()), place});
    place += static_cast<std::size_t>(channel.width);
  }
}

void SeaSample::take(double t, double averaged_from, std::span<const double> row) {
  if (t < averaged_from || columns_.empty() || state_.taken++ % state_.every != 0)
    return;
  const std::size_t width = columns_.size();
  if (state_.work.size() == most_samples * width) {
    for (std::size_t i = 1; i < most_samples / 2; ++i)
      std::copy_n(state_.work.begin() + static_cast<long>(2 * i * width), width,
                  state_.work.begin() + static_cast<long>(i * width));
    state_.work.resize(most_samples / 2 * width);
    state_.every *= 2; // this row is the next one: most_samples is even
  }
  for (const Column& column : columns_)
    state_.work.push_back(row[column.place]);
}

void SeaSample::write(RunStatistics& statistics) const {
  statistics.sea_period = period_;
  if (columns_.empty() || statistics.mean_power.empty())
    return;
  const std::size_t width = columns_.size(), samples = state_.work.size() / width;
  const double least = sampling_periods * period_, step = static_cast<double>(state_.every) * step_;
  if (statistics.end_time - statistics.mean_power_from < least)
    statistics.interval_missing = "too short for an interval of the sea state, which needs " +
                                  rounded_text(least, 3) + " s after the ramp";
  else if (samples <= sampling_fewest)
    statistics.interval_missing = "too few samples for an interval of the sea state: " +
                                  number_text(static_cast<double>(samples)) + " after the ramp";
  if (!statistics.interval_missing.empty())
    return;
  std::vector<double> total(samples - 1);
  for (const auto& [name, mean] : statistics.mean_power) {
    std::vector<double> power(samples - 1); // work done by a force on its bodies
    for (std::size_t k = 0; k < width; ++k)
      if (columns_[k].name == name)
        for (std::size_t i = 0; i + 1 < samples; ++i)
          power[i] = (state_.work[i * width + k] - state_.work[(i + 1) * width + k]) / step;
    statistics.mean_power_interval.push_back(mean_interval(power));
    std::transform(power.begin(), power.end(), total.begin(), total.begin(), std::plus<>());
  }
  statistics.total_power_interval = mean_interval(total);
}

} // namespace hydrodae::session
