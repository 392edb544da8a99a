#pragma once
/// The channels of a run as one table: what each is called, and how its value is read.

#include <functional>
#include <type_traits>

#include "hydrodae/core/channel.h"
#include "hydrodae/measure/measure.h"

namespace hydrodae::observe {

/// One instant of a run, as the observer sees it.
struct Instant {
  double t;
  const measure::Observation& seen;
  const std::vector<system::BodyState<double>>& bodies;
  const measure::Measure& measure;
  const VectorX& y;
  const std::vector<double>& work; ///< of each component since the start [J]
};

class ChannelTable {
public:
  /// Adds a channel whose `value(instant)` is a number or a fixed-size vector.
  template <class Value>
  Channel& add(std::string path, std::string unit, std::string frame, std::string text,
               Value value) {
    using Result = std::decay_t<std::invoke_result_t<Value, const Instant&>>;
    if constexpr (std::is_same_v<Result, double>)
      return add_block({std::move(path), 1, std::move(unit), std::move(frame), std::move(text)},
                       [value](const Instant& now, double* out) { *out = value(now); });
    else
      return add_block(
          {std::move(path), static_cast<int>(Result::SizeAtCompileTime), std::move(unit),
           std::move(frame), std::move(text)},
          [value](const Instant& now, double* out) { Eigen::Map<Result>{out} = value(now); });
  }

  /// Adds a channel that writes its `channel.width` numbers by itself.
  Channel& add_block(Channel channel, std::function<void(const Instant&, double*)> write) {
    channels_.push_back(std::move(channel));
    writers_.push_back(std::move(write));
    width_ += static_cast<std::size_t>(channels_.back().width);
    return channels_.back();
  }

  /// Writes the values of all channels one after the other; `out` has `width()` numbers.
  void write(const Instant& now, double* out) const {
    for (std::size_t k = 0; k < channels_.size(); out += channels_[k++].width)
      writers_[k](now, out);
  }

  const std::vector<Channel>& channels() const { return channels_; }
  std::size_t width() const { return width_; }

private:
  std::vector<Channel> channels_;
  std::vector<std::function<void(const Instant&, double*)>> writers_;
  std::size_t width_ = 0;
};

/// The table of a scene.
///
/// Throws ModelError where a body has the name of a channel.
ChannelTable channel_table(const system::Regime& system, const measure::Measure& measure);

} // namespace hydrodae::observe
