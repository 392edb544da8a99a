#pragma once
#include <algorithm>
#include <vector>

#include "hydrodae/control/sampled.h"

namespace hydrodae::control {

/// Table with linear interpolation; constant beyond the ends.
class TableLaw final : public Law {
public:
  /// @param at  two or more ascending values
  TableLaw(std::vector<double> at, std::vector<double> value)
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

struct Table : Sampled {
  static constexpr std::string_view type = "table";
  static constexpr std::string_view doc =
      "u as a function of one channel, straight lines between points.";
  static constexpr Arity arity = {1, 1, 1, "the channel of which it is a function"};
  std::vector<double> at, value;

  std::unique_ptr<Law> law(const Place&) const { return std::make_unique<TableLaw>(at, value); }
  std::optional<Fault> fault() const {
    if (at.size() < 2 || at.size() != value.size())
      return Fault{"at", "'at' and 'value' must have as many numbers, two or more"};
    if (!std::is_sorted(at.begin(), at.end(), std::less_equal<>()))
      return Fault{"at", "'at' must ascend"};
    return {};
  }

  template <class C = Table> static Fields<C> fields() {
    return usual_fields<C>() +
           Fields<C>{
               {"at", &C::at, "unit of the input", "Values of the input, ascending.", true},
               {"value", &C::value, "unit of the output",
                "Outputs there; beyond the ends those at the ends.", true},
           };
  }
};

} // namespace hydrodae::control
