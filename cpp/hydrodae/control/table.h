#pragma once
#include <algorithm>
#include <vector>

#include "hydrodae/control/law.h"

namespace hydrodae::control {

/// Straight lines between points; beyond the ends the values there.
class Table final : public Law {
public:
  /// @param at  ascending, two or more
  Table(std::vector<double> at, std::vector<double> value)
      : at_(std::move(at)), value_(std::move(value)) {}

  void sample(double, std::span<const double> in, std::span<double> out) override {
    const double x = std::clamp(in[0], at_.front(), at_.back());
    const auto right = std::upper_bound(at_.begin() + 1, at_.end() - 1, x);
    const auto k = static_cast<std::size_t>(right - at_.begin());
    const double part = (x - at_[k - 1]) / (at_[k] - at_[k - 1]);
    out[0] = value_[k - 1] + part * (value_[k] - value_[k - 1]);
  }

private:
  std::vector<double> at_, value_;
};

} // namespace hydrodae::control
