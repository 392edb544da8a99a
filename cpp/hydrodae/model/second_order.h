#pragma once
/// Table [second_order]: the loads of pairs of waves.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hydrodae/core/field.h"

namespace hydrodae::model {

struct SecondOrder {
  static constexpr std::string_view doc =
      "Loads of second order in wave height, by tables of the database for pairs of waves.";
  std::vector<std::string> loads;
  std::string terms = "few";
  double lost_variance = 0.02;

  bool has(std::string_view load) const {
    return std::find(loads.begin(), loads.end(), load) != loads.end();
  }

  template <class O = SecondOrder> static Fields<O> fields() {
    return {
        {"loads",
         &O::loads,
         "-",
         "One of mean (constant drift), newman (slow drift from the drift of single waves: the "
         "load of two is the arithmetic mean of theirs) and difference (slow drift by the table of "
         "two waves, with the mean); and sum (loads at sums of frequencies).",
         true,
         any_value,
         {"mean", "newman", "difference", "sum"}},
        {"terms",
         &O::terms,
         "-",
         "Products of linear signals that stand for the table. few: their error is at most 1e-3 of "
         "the rms of each load. all: 1e-9.",
         false,
         any_value,
         {"few", "all"}},
        {"lost_variance", &O::lost_variance, "-",
         "Largest part of the variance of the waves that may lie outside the frequencies of the "
         "tables; these waves have no load of second order.",
         false, between(0, 1)},
    };
  }
};

} // namespace hydrodae::model
